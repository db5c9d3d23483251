// Logs that are damaged at random: whatever is in them, the page must not break.

import { describe, expect, it } from 'vitest';
import { logText, LOGS } from '../../tests/support';
import { arrange } from '../hall/crowd';
import { Heads } from '../hall/heads';
import { layOut } from '../hall/layout';
import { Piles } from '../hall/piles';
import { LogReader } from '../log/reader';
import { ganttRows } from '../ui/gantt_rows';
import { compare } from './compare';
import { describeDecision, describeMachine, describeTask } from './describe';
import { Run } from './run';

type Random = () => number;

function generator(seed: number): Random {
  let state = seed;
  return () => {
    state = (state * 1664525 + 1013904223) % 4294967296;
    return state / 4294967296;
  };
}

const VALUES: unknown[] = [
  null,
  -1,
  0,
  1e300,
  7.5,
  '',
  'human.0',
  '__proto__',
  'constructor',
  [],
  {},
  true,
  [[]],
  [null],
];

function damaged(text: string, random: Random): string {
  const lines = text.split('\n');
  const pick = (count: number): number => Math.floor(random() * count);
  for (let i = 0; i < 12; ++i) {
    const at = random() < 0.2 ? 0 : pick(lines.length);
    const what = random();
    if (what < 0.2 && at > 0) lines.splice(at, 1);
    else if (what < 0.35 && at > 0) lines.splice(pick(lines.length - 1) + 1, 0, lines[at]!);
    else if (what < 0.45 && at > 0) lines[at] = lines[at]!.slice(0, pick(lines[at]!.length));
    else lines[at] = changed(lines[at]!, random);
  }
  return lines.join('\n');
}

/** The line with a value somewhere in it replaced. */
function changed(line: string, random: Random): string {
  if (line === '' || random() < 0.05) return line.replace(/\d+/, '99');
  let value: unknown;
  try {
    value = JSON.parse(line);
  } catch {
    return line;
  }
  let inside = value as Record<string, unknown>;
  for (let depth = 0; depth < 6; ++depth) {
    const keys = Object.keys(inside);
    if (keys.length === 0) break;
    const key = keys[Math.floor(random() * keys.length)]!;
    const next = inside[key];
    if (typeof next !== 'object' || next === null || random() < 0.3) {
      inside[key] = VALUES[Math.floor(random() * VALUES.length)];
      break;
    }
    inside = next as Record<string, unknown>;
  }
  return JSON.stringify(value);
}

/** Asks everything of a run that the page asks. */
function use(run: Run): void {
  const layout = layOut(run.header, run.seenAt);
  const piles = new Piles(run, layout, new Heads(run, layout));
  for (const time of [0, run.last / 3, run.last]) {
    piles.at(time, arrange(run, time, layout.agentScale));
    for (const motion of run.motions.values()) motion.ahead(time);
  }
  ganttRows(run);
  for (const decision of run.decisions) describeDecision(run, decision);
  for (const [worker, diary] of run.diaries) for (const { n } of diary.bindings) describeTask(run, worker, n);
  for (const [machine, all] of run.machines.intervals)
    for (const interval of all) describeMachine(run, machine, interval);
  compare(run, run);
}

describe('a damaged log', () => {
  it.each(LOGS)('made from %s breaks nothing', (name) => {
    const text = logText(name);
    let shown = 0;
    for (let seed = 1; seed <= 60; ++seed) {
      const reader = new LogReader();
      const log = damaged(text, generator(seed));
      try {
        const events = [...reader.push(log), ...reader.finish()];
        if (!reader.header) continue;
        const run = new Run(name, reader.header);
        for (const event of events) run.add(event);
        use(run);
        shown += 1;
      } catch (error) {
        throw new Error(`seed ${seed}: ${error instanceof Error ? error.stack : 'unknown'}`);
      }
    }
    expect(shown).toBeGreaterThan(20);
  });
});
