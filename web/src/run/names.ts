// Names of the log as they are shown, and colours' places in the palette.

import type { Header } from '../log/header';

/** "weld_bend.inner" to "weld bend · inner". */
export function shown(name: string): string {
  return name.replaceAll('_', ' ').replaceAll(/\.(?=[^\d])/g, ' · ');
}

/** The part before the first point: variants of one task or milestone share it. */
export function base(name: string): string {
  const point = name.indexOf('.');
  return point > 0 ? name.slice(0, point) : name;
}

/** Which colour a task has: variants of one task share it and differ in `variant`. */
export class TaskColours {
  private readonly groups: string[] = [];
  private readonly variants = new Map<string, number>();

  constructor(header: Header) {
    for (const { name } of header.tasks) {
      const group = base(name);
      if (!this.groups.includes(group)) this.groups.push(group);
      const before = header.tasks.filter((task) => base(task.name) === group).findIndex((task) => task.name === name);
      this.variants.set(name, Math.max(0, before));
    }
  }

  of(task: string): { colour: number; variant: number } {
    return { colour: Math.max(0, this.groups.indexOf(base(task))), variant: this.variants.get(task) ?? 0 };
  }
}

/**
 * The marks (a), (b), … of the milestones: one letter per kind of milestone ("flange_welded.inner" and ".outer" are one
 * kind), in order of their first occurrence; after (z) comes (aa).
 */
export function milestoneMarks(names: Iterable<string>): Map<string, string> {
  const marks = new Map<string, string>();
  const kinds: string[] = [];
  for (const name of names) {
    const kind = name.startsWith('task_end.') ? name : base(name);
    if (!kinds.includes(kind)) kinds.push(kind);
    marks.set(name, letters(kinds.indexOf(kind)));
  }
  return marks;
}

function letters(index: number): string {
  const last = String.fromCharCode(97 + (index % 26));
  return index < 26 ? last : letters(Math.floor(index / 26) - 1) + last;
}
