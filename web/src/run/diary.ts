// What a worker did: its tasks, and within them walking, working and waiting. The same rules as those of
// `linewright gantt`.

import type { LogEvent } from '../log/events';
import type { Tick } from '../log/header';

export type ActivityKind = 'walk' | 'work' | 'wait' | 'rest';

export interface Activity {
  begin: Tick;
  end: Tick;
  kind: ActivityKind;
  n: number; // the decision whose task it belongs to; 0: none (on its way to rest)
  event?: LogEvent; // what the log says about it; none: waiting
}

/** A worker's time in one task. */
export interface Binding {
  n: number;
  since: Tick;
  until: Tick; // Infinity while it lasts
  late: boolean; // joined later
}

export class Diary {
  readonly bindings: Binding[] = [];
  private readonly notes: Activity[] = []; // walk, work and rest as announced; wait where blocked

  bind(n: number, t: Tick, late: boolean): void {
    this.leave(t);
    this.bindings.push({ n, since: t, until: Infinity, late });
    const last = this.notes[this.notes.length - 1];
    if (!last || last.kind !== 'rest' || last.end <= t) return;
    // The way to rest goes on until the task sends it elsewhere.
    this.notes.push({ ...last, kind: 'walk', begin: Math.max(t, last.begin), n });
    last.end = Math.max(last.begin, t);
  }

  leave(t: Tick): void {
    const binding = this.current;
    if (!binding) return;
    binding.until = t;
    this.cut(t, true);
  }

  get current(): Binding | undefined {
    const last = this.bindings[this.bindings.length - 1];
    return last && last.until === Infinity ? last : undefined;
  }

  /** Notes what the log announces; ways replace the way the worker was on. */
  note(begin: Tick, end: Tick, kind: 'walk' | 'work' | 'wait', event: LogEvent): void {
    if (kind !== 'work') this.cut(event.t, false);
    const n = this.current?.n ?? 0;
    this.notes.push({ begin, end, kind: n === 0 && kind === 'walk' ? 'rest' : kind, n, event });
  }

  /** Everything up to `now`, in order of time; what lies between two activities of a task is waiting. */
  activities(now: Tick): Activity[] {
    const all: Activity[] = [];
    let next = 0;
    for (const binding of this.bindings) {
      next = this.take(all, next, binding.since, 0, now);
      let filled = binding.since;
      const end = Math.min(binding.until, now);
      for (; next < this.notes.length && this.notes[next]!.n === binding.n; ++next) {
        const note = this.notes[next]!;
        const begin = Math.max(filled, Math.min(note.begin, end));
        push(all, { begin: filled, end: begin, kind: 'wait', n: binding.n });
        filled = Math.max(begin, Math.min(note.end, end));
        push(all, { ...note, begin, end: filled });
      }
      push(all, { begin: filled, end, kind: 'wait', n: binding.n });
    }
    this.take(all, next, Infinity, 0, now);
    return all;
  }

  private take(all: Activity[], next: number, until: Tick, n: number, now: Tick): number {
    for (; next < this.notes.length && this.notes[next]!.n === n; ++next) {
      const note = this.notes[next]!;
      push(all, { ...note, end: Math.min(note.end, until, now) });
    }
    return next;
  }

  private cut(t: Tick, everything: boolean): void {
    const last = this.notes[this.notes.length - 1];
    if (last && last.end > t && (everything || last.kind !== 'work')) last.end = Math.max(last.begin, t);
  }
}

function push(all: Activity[], activity: Activity): void {
  if (activity.end > activity.begin) all.push(activity);
}

export interface Shares {
  work: Tick;
  walk: Tick;
  wait: Tick;
  idle: Tick; // in no task
}

/** How the ticks 0 … now were spent; their sum is `now`. */
export function shares(activities: readonly Activity[], now: Tick): Shares {
  const sum: Shares = { work: 0, walk: 0, wait: 0, idle: now };
  for (const { kind, begin, end, n } of activities) {
    if (kind === 'rest' || n === 0) continue;
    sum[kind] += end - begin;
    sum.idle -= end - begin;
  }
  return sum;
}
