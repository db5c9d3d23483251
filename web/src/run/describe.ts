// What the page says about a bar or a decision, as plain text.

import type { DecisionEvent } from '../log/events';
import type { Tick } from '../log/header';
import type { Activity } from './diary';
import type { MachineInterval } from './machines';
import { shown } from './names';
import type { Run } from './run';
import { waitReasons } from './waiting';

export interface Step {
  begin: Tick;
  end: Tick;
  kind: Activity['kind'];
  text: string;
}
export interface TaskAccount {
  title: string;
  n: number;
  since: Tick;
  until: Tick | undefined; // none: it still runs
  crew: { role: string; members: string[] }[];
  worker: string;
  metres: number; // gone by the worker within the task
  sums: { work: Tick; walk: Tick; wait: Tick };
  steps: Step[];
}

/** What `worker` did in the task of decision `n`. */
export function describeTask(run: Run, worker: string, n: number): TaskAccount | undefined {
  const task = run.tasks.get(n);
  const binding = run.diaries.get(worker)?.bindings.find((b) => b.n === n);
  if (!task || !binding) return undefined;
  const steps = run.activities(worker).filter((activity) => activity.n === n);
  const sums = { work: 0, walk: 0, wait: 0 };
  let metres = 0;
  for (const { kind, begin, end, event } of steps) {
    if (kind !== 'rest') sums[kind] += end - begin;
    if (kind === 'walk' && (event?.event === 'go' || event?.event === 'reroute')) {
      metres += event.metres * ((end - begin) / Math.max(1, event.arrives - event.departs));
    }
  }
  return {
    title: shown(task.decision.task),
    n,
    since: binding.since,
    until: binding.until === Infinity ? undefined : binding.until,
    crew: crewOf(run, n),
    worker,
    metres,
    sums,
    steps: inSteps(run, worker, steps),
  };
}

/** Items that are moved one after the other are one step. */
function inSteps(run: Run, worker: string, activities: Activity[]): Step[] {
  const steps: (Step & { items: number })[] = [];
  let from = '';
  for (const activity of activities) {
    const { begin, end, kind, event } = activity;
    const moved = event?.event === 'transfer' ? `${event.from} ${event.to}` : '';
    const last = steps[steps.length - 1];
    if (last && moved !== '' && moved === from && last.end === begin) {
      last.end = end;
      last.items += 1;
      last.text = stepText(run, worker, activity, last.items);
    } else steps.push({ begin, end, kind, items: 1, text: stepText(run, worker, activity) });
    from = moved;
  }
  return steps;
}

/** The crew by role, late joiners included. */
export function crewOf(run: Run, n: number): TaskAccount['crew'] {
  const task = run.tasks.get(n);
  if (!task) return [];
  const named = new Set<string>();
  const crew = Object.entries(task.decision.crew).map(([role, ids]) => {
    const members = Array.isArray(ids) ? ids.map(String) : [];
    for (const id of members) named.add(id);
    return { role, members };
  });
  const late = [...task.members].filter((id) => !named.has(id));
  if (late.length > 0) crew.push({ role: 'joined later', members: late });
  return crew.filter(({ members }) => members.length > 0);
}

export function stepText(run: Run, worker: string, step: Activity, items = 1): string {
  const { event } = step;
  if (step.kind === 'wait') return `waits ${waitReasons(run, worker, step).join(' and ')}`;
  if (event?.event === 'go' || event?.event === 'reroute') {
    const verb = run.kindOf(worker) === 'human' ? 'walks' : 'drives';
    const from = event.event === 'go' ? ` from ${shown(event.from!)}` : ' from where it was';
    const rest = step.kind === 'rest' ? ' to rest' : '';
    return `${verb}${rest}${from} to ${shown(event.to)}, ${event.metres.toFixed(1)} m`;
  }
  if (event?.event === 'transfer') {
    const of = materialOf(run, event.from, event.to);
    return `moves ${items} × ${of} from ${shown(event.from)} to ${shown(event.to)}`;
  }
  if (event?.event === 'operation_start') return `operates ${shown(event.operation)}`;
  return step.kind;
}

function materialOf(run: Run, ...ends: string[]): string {
  for (const end of ends) {
    const place = run.header.places.find((candidate) => candidate.name === end);
    if (place) return shown(place.of);
  }
  return 'item';
}

export function describeMachine(run: Run, machine: string, interval: MachineInterval): string[] {
  const { state, operation, begin, end, n } = interval;
  const span = `${begin}–${Number.isFinite(end) ? end : '…'}`;
  const what = {
    working: `works on ${shown(operation)}`,
    held: `is held after ${shown(operation)}, until a later operation lets it go`,
    recovering: `recovers after ${shown(operation)}`,
  }[state];
  const lines = [`${shown(machine)} ${what}, ticks ${span}.`];
  const about = run.header.operations.get(operation);
  if (about && state === 'working') {
    const flow = (map: Map<string, number>): string =>
      [...map].map(([place, count]) => `${count > 1 ? `${count} × ` : ''}${shown(place)}`).join(', ') || 'nothing';
    lines.push(`Takes from: ${flow(about.consumes)}. Makes: ${flow(about.produces)}.`);
  }
  if (n > 0) lines.push(`Operated in task ${shown(run.tasks.get(n)?.decision.task ?? '')} (decision ${n}).`);
  return lines;
}

export interface DecisionAccount {
  title: string;
  crew: TaskAccount['crew'];
  explained: boolean;
  plannedEnd: Tick | undefined;
  alternatives: { task: string; text: string; chosen: boolean; best: boolean }[];
  impossible: { task: string; reason: string }[];
  candidates: { role: string; neededAt: string; rows: { worker: string; text: string; chosen: boolean }[] }[];
}

export function describeDecision(run: Run, decision: DecisionEvent): DecisionAccount {
  const why = decision.why ?? {};
  const alternatives = Array.isArray(why.alternatives) ? why.alternatives : [];
  const ends = alternatives.flatMap((a) => (typeof a.ends === 'number' ? [a.ends] : []));
  const best = Math.min(...ends);
  const chosen = new Set(crewOf(run, decision.n).flatMap(({ members }) => members));
  return {
    title: shown(decision.task),
    crew: crewOf(run, decision.n),
    explained: decision.why !== undefined,
    plannedEnd: why.planned_end,
    alternatives: alternatives.map((a) => ({
      task: shown(String(a.task)),
      text: a.ruled_out ? 'ruled out: the order could not be finished' : endText(a.ends),
      chosen: a.task === decision.task,
      best: a.ends === best,
    })),
    impossible: Object.entries(why.not_selectable ?? {}).map(([task, reason]) => ({
      task: shown(task),
      reason: shown(String(reason)),
    })),
    candidates: Object.entries(why.candidates ?? {}).map(([role, { free, needed_at }]) => ({
      role,
      neededAt: needed_at ? `needed at ${shown(needed_at)}` : 'where they are',
      rows: (Array.isArray(free) ? free : []).map(({ worker, ticks, metres }) => ({
        worker: String(worker),
        text: ticks === null ? 'no way now' : `${ticks} ticks${metres == null ? '' : `, ${metres.toFixed(1)} m`}`,
        chosen: chosen.has(worker),
      })),
    })),
  };
}

function endText(ends: Tick | null | undefined): string {
  if (ends === undefined) return '';
  return ends === null ? 'would not finish' : `would end at ${ends}`;
}
