// Two runs of one line: what each agent did with the time, and where the two part.

import type { DecisionEvent } from '../log/events';
import type { Tick } from '../log/header';
import { shares, type Shares } from './diary';
import type { Run } from './run';

export interface AgentDifference {
  worker: string;
  a: Shares | undefined; // none: it is only in the other run
  b: Shares | undefined;
}

export interface MachineDifference {
  machine: string;
  a: Tick; // busy
  b: Tick;
}

export interface Comparison {
  lengths: [Tick, Tick];
  finished: [boolean, boolean];
  agents: AgentDifference[];
  machines: MachineDifference[]; // most different first
  firstDifference: { a: DecisionEvent | undefined; b: DecisionEvent | undefined } | undefined;
  sameLine: boolean;
  sameScenario: boolean;
  notes: string[]; // the difference in words
}

export const SHARE_KINDS = ['work', 'walk', 'wait', 'idle'] as const;

export function compare(a: Run, b: Run): Comparison {
  const workers = new Set([...a.header.workers, ...b.header.workers].map((worker) => worker.id));
  const agents = [...workers].map((worker) => ({ worker, a: sharesOf(a, worker), b: sharesOf(b, worker) }));
  const names = new Set([...a.header.machines, ...b.header.machines]);
  const machines = [...names]
    .map((machine) => ({ machine, a: busy(a, machine), b: busy(b, machine) }))
    .sort((one, other) => Math.abs(other.b - other.a) - Math.abs(one.b - one.a));
  const comparison: Comparison = {
    lengths: [a.last, b.last],
    finished: [a.end?.status === 'finished', b.end?.status === 'finished'],
    agents,
    machines,
    firstDifference: firstDifference(a, b),
    sameLine: a.header.line === b.header.line,
    sameScenario: a.header.hash === b.header.hash,
    notes: [],
  };
  comparison.notes = inWords(comparison);
  return comparison;
}

/** The first decision that differs in time, task or crew; none where one run's decisions begin with all of the other's. */
export function firstDifference(a: Run, b: Run): Comparison['firstDifference'] {
  const count = Math.max(a.decisions.length, b.decisions.length);
  for (let i = 0; i < count; ++i) {
    const [one, other] = [a.decisions[i], b.decisions[i]];
    if (one && other && sameDecision(one, other)) continue;
    return { a: one, b: other };
  }
  return undefined;
}

function sameDecision(a: DecisionEvent, b: DecisionEvent): boolean {
  return a.t === b.t && a.task === b.task && JSON.stringify(a.crew) === JSON.stringify(b.crew);
}

function sharesOf(run: Run, worker: string): Shares | undefined {
  return run.diaries.has(worker) ? shares(run.activities(worker), run.last) : undefined;
}

function busy(run: Run, machine: string): Tick {
  const all = run.machines.intervals.get(machine) ?? [];
  return all.reduce((sum, { begin, end }) => sum + Math.min(end, run.last) - begin, 0);
}

const WORDS = { work: 'working', walk: 'on the way', wait: 'waiting within tasks', idle: 'without a task' };

function inWords(comparison: Comparison): string[] {
  const [a, b] = comparison.lengths;
  const notes = [outcome(comparison)];
  const sums = SHARE_KINDS.map((kind) => ({ kind, ticks: difference(comparison.agents, kind) }));
  const common = comparison.agents.filter((agent) => agent.a && agent.b).length;
  const most = [...sums].sort((one, other) => Math.abs(other.ticks) - Math.abs(one.ticks));
  if (common > 0 && a !== b) {
    const parts = most.filter(({ ticks }) => ticks !== 0).map(({ kind, ticks }) => `${signed(ticks)} ${WORDS[kind]}`);
    notes.push(`All agents of both runs together, B against A, in ticks: ${parts.join(', ')}.`);
    const agent = mostChanged(comparison.agents);
    if (agent) notes.push(agent);
  }
  if (!comparison.sameLine) notes.push('The two logs are of different lines.');
  else if (!comparison.sameScenario) notes.push('The two logs are of different versions of the scenario.');
  if (comparison.agents.length !== common) notes.push('The crews differ: the others are in one of the runs only.');
  return notes;
}

function outcome({ lengths: [a, b], finished }: Comparison): string {
  if (!finished[0] && !finished[1]) return `Neither run finishes: A ends at tick ${a}, B at ${b}.`;
  if (!finished[0]) return `A does not finish (it ends at tick ${a}); B takes ${b} ticks.`;
  if (!finished[1]) return `B does not finish (it ends at tick ${b}); A takes ${a} ticks.`;
  if (a === b) return `Both take ${a} ticks.`;
  const share = ((Math.abs(b - a) / a) * 100).toFixed(1);
  return `B takes ${Math.abs(b - a)} ticks ${b > a ? 'longer' : 'less'} than A (${b} against ${a}; ${share} %).`;
}

function difference(agents: AgentDifference[], kind: (typeof SHARE_KINDS)[number]): Tick {
  return agents.reduce((sum, { a, b }) => sum + (a && b ? b[kind] - a[kind] : 0), 0);
}

function mostChanged(agents: AgentDifference[]): string | undefined {
  let found: { worker: string; kind: (typeof SHARE_KINDS)[number]; ticks: Tick } | undefined;
  for (const { worker, a, b } of agents) {
    if (!a || !b) continue;
    for (const kind of ['work', 'walk', 'wait'] as const) {
      const ticks = b[kind] - a[kind];
      if (!found || Math.abs(ticks) > Math.abs(found.ticks)) found = { worker, kind, ticks };
    }
  }
  if (!found || found.ticks === 0) return undefined;
  return `Within tasks ${found.worker} differs most: ${signed(found.ticks)} ticks ${WORDS[found.kind]}.`;
}

/** With a real minus sign, and a plus where it is more. */
export function signed(value: number): string {
  return value > 0 ? `+${value}` : value < 0 ? `−${-value}` : '0';
}
