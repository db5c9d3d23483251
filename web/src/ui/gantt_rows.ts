// The rows of the Gantt chart of a run, from top to bottom.

import { kindIndex } from './theme';
import { shown } from '../run/names';
import type { Run } from '../run/run';

export interface Row {
  kind: 'heading' | 'worker' | 'machine' | 'progress' | 'level';
  name: string; // worker, machine or place
  text: string;
  y: number;
  height: number;
  most: number; // of levels: the full height
  material?: string;
}

const HEIGHTS = { heading: 17, worker: 20, machine: 13, progress: 26, level: 20 };

export function ganttRows(run: Run): { rows: Row[]; height: number } {
  const { header } = run;
  const rows: Row[] = [];
  let y = 0;
  const add = (kind: Row['kind'], name: string, text: string, most = 0, material?: string): void => {
    rows.push({ kind, name, text, y, height: HEIGHTS[kind], most, material });
    y += HEIGHTS[kind];
  };
  const kinds = [...new Set(header.workers.map((worker) => worker.kind))];
  kinds.sort((a, b) => kindIndex(a, kinds) - kindIndex(b, kinds));
  for (const kind of kinds) {
    add('heading', kind, headingOf(kind));
    for (const worker of header.workers) if (worker.kind === kind) add('worker', worker.id, worker.id);
  }
  const busy = header.machines.filter((machine) => (run.machines.intervals.get(machine)?.length ?? 0) > 0);
  if (busy.length > 0) add('heading', 'machines', 'Machines');
  for (const machine of busy) add('machine', machine, shown(machine));
  add('heading', 'progress', 'Progress and buffers');
  if (header.order) add('progress', header.order.finishedIn, 'finished', header.order.quantity);
  for (const place of header.places) {
    const series = run.material.counts.get(place.name);
    // Buffers are what fills and empties: with room for more than one item, or where people put things.
    const buffer = place.capacity === undefined ? place.at !== undefined : place.capacity > 1;
    if (!series || !run.materials.has(place.of) || !(buffer || place.berth) || series.max === 0) continue;
    if (place.name === header.order?.finishedIn) continue;
    add('level', place.name, shown(place.name), Math.max(place.capacity ?? 0, series.max), place.of);
  }
  return { rows, height: y + 6 };
}

function headingOf(kind: string): string {
  if (kind === 'human') return 'People';
  const name = shown(kind);
  return `${name.charAt(0).toUpperCase()}${name.slice(1)}s`;
}
