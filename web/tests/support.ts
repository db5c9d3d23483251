// The recorded logs of tests/data, and what `linewright simulate --json` said about them.

import { readFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { LogReader } from '../src/log/reader';
import { Run } from '../src/run/run';

export const LOGS = ['routed', 'routed_fifo', 'kitting_cell', 'long_hall', 'closed'] as const;
export type LogName = (typeof LOGS)[number];

export function dataFile(name: string): string {
  return fileURLToPath(new URL(`data/${name}`, import.meta.url));
}

export function logText(name: LogName): string {
  return readFileSync(dataFile(`${name}.jsonl`), 'utf8');
}

export function runOf(text: string, name = 'test'): Run {
  const reader = new LogReader();
  const events = [...reader.push(text), ...reader.finish()];
  if (!reader.header) throw new Error(reader.problems.map((problem) => problem.text).join(' '));
  const run = new Run(name, reader.header);
  for (const event of events) run.add(event);
  return run;
}

export function loadRun(name: LogName): Run {
  return runOf(logText(name), `${name}.jsonl`);
}

interface Result {
  makespan: number;
  decisions: number;
  workers: Record<string, { work: number; travel: number; wait: number; idle: number }>;
  machines: Record<string, number>;
}

export const RESULTS = JSON.parse(readFileSync(dataFile('results.json'), 'utf8')) as Record<LogName, Result>;
