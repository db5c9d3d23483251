// For whom, or for what, a worker waits within a task.

import type { Tick } from '../log/header';
import type { Activity } from './diary';
import { shown } from './names';
import type { Run } from './run';

/** Why `worker` waits from `begin` to `end` in the task of decision `n`: one line each. */
export function waitReasons(run: Run, worker: string, { n, begin, end, event }: Activity): string[] {
  if (event?.event === 'blocked') return [`for a way to ${shown(event.to)}: a zone is closed`];
  const task = run.tasks.get(n);
  if (!task) return [];
  const reasons: string[] = [];
  for (const other of task.members) {
    if (other === worker) continue;
    const busy = lastBusy(run, other, n, begin, end);
    if (busy) reasons.push(`for ${other}, ${doing(busy)} until ${busy.end}`);
  }
  if (reasons.length === 0) reasons.push(...lateJoiner(run, n, begin, end));
  if (reasons.length === 0) reasons.push(...material(run, worker, n, begin, end));
  if (reasons.length === 0) reasons.push(end - begin <= 2 ? 'a moment between two steps' : 'for the next step');
  return reasons;
}

function lastBusy(run: Run, worker: string, n: number, begin: Tick, end: Tick): Activity | undefined {
  const during = run.activities(worker).filter((a) => a.n === n && a.kind !== 'wait' && a.begin < end && a.end > begin);
  const last = during[during.length - 1];
  // Who is awaited is done when the waiting ends, or a tick before the next step.
  return last && (last.end <= end + 1 || end >= run.last) ? last : undefined;
}

function doing(activity: Activity): string {
  const { event } = activity;
  if (event?.event === 'go' || event?.event === 'reroute') return `on the way to ${shown(event.to)}`;
  if (event?.event === 'transfer') return `moving an item from ${shown(event.from)} to ${shown(event.to)}`;
  if (event?.event === 'operation_start') return `operating ${shown(event.operation)}`;
  return 'busy';
}

function lateJoiner(run: Run, n: number, begin: Tick, end: Tick): string[] {
  const found: string[] = [];
  for (const [worker, diary] of run.diaries) {
    const binding = diary.bindings.find((b) => b.n === n && b.late && b.since > begin && b.since <= end + 1);
    if (binding) found.push(`for ${worker}, who joins at ${binding.since}`);
  }
  return found;
}

/** The step after the wait says what was missing: an item, room, or an operation's tokens and machines. */
function material(run: Run, worker: string, n: number, begin: Tick, end: Tick): string[] {
  const next = run.activities(worker).find((a) => a.n === n && a.begin >= end && a.kind === 'work')?.event;
  if (!next || next.t - end > 1) return [];
  if (next.event === 'transfer' && run.material.count(next.from, begin) === 0) {
    return [`for an item in ${shown(next.from)}`];
  }
  if (next.event !== 'operation_start' || end - begin <= 1) return [];
  return [`until ${shown(next.operation)} can start`];
}
