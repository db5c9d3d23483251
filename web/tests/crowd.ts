// A log of many people and robots who walk about a hall without end: what a benchmark shows.

import { logText } from './support';

interface Worker {
  id: string;
  kind: string;
  start: string;
}

/** `each` people and as many robots with cages; the same numbers give the same log. */
export function crowdLog(each: number, ticks: number): string {
  const header = JSON.parse(logText('routed').split('\n', 1)[0]!) as {
    workers: Worker[];
    carriers: (Worker & { capacity: number })[];
    stations: Record<string, Record<string, number[]>>;
    tasks: { name: string }[];
  };
  const random = generator(7);
  const pick = <T>(list: T[]): T => list[Math.floor(random() * list.length)]!;
  const at = (kind: string): string[] => Object.keys(header.stations).filter((name) => kind in header.stations[name]!);
  header.workers = ['human', 'robot'].flatMap((kind) =>
    Array.from({ length: each }, (_, i) => ({ id: `${kind}.${i}`, kind, start: pick(at(kind)) })),
  );
  header.carriers = Array.from({ length: each }, (_, i) => ({
    id: `cage.${i}`,
    kind: 'cage',
    capacity: 4,
    start: header.workers[each + i]!.start,
  }));
  const events: { t: number }[] = [];
  header.workers.forEach((worker, i) => {
    const task = header.tasks[i % header.tasks.length]!.name;
    events.push({ t: 1, event: 'decision', n: i + 1, task, crew: { [worker.kind]: [worker.id] } } as { t: number });
    if (worker.kind === 'robot')
      events.push({ t: 1, event: 'pick_up', n: i + 1, worker: worker.id, carrier: `cage.${i - each}` } as {
        t: number;
      });
    let from = worker.start;
    for (let t = 1; t < ticks; ) {
      const to = pick(at(worker.kind).filter((name) => name !== from));
      const [a, b] = [header.stations[from]![worker.kind]!, header.stations[to]![worker.kind]!];
      const metres = Math.hypot(a[0]! - b[0]!, a[1]! - b[1]!);
      const arrives = t + Math.max(1, Math.round(metres / 1.5));
      const path = Array.from({ length: 21 }, (_, k) => [
        a[0]! + ((b[0]! - a[0]!) * k) / 20,
        a[1]! + ((b[1]! - a[1]!) * k) / 20 + Math.sin((k * Math.PI) / 20),
        0,
        k / 20,
      ]);
      events.push({ t, event: 'go', n: i + 1, worker: worker.id, from, to, departs: t, arrives, metres, path } as {
        t: number;
      });
      [from, t] = [to, arrives + 1];
    }
  });
  events.sort((a, b) => a.t - b.t);
  const lines = [header, ...events, { t: ticks + 60, event: 'end', status: 'horizon', makespan: null, progress: 0 }];
  return `${lines.map((line) => JSON.stringify(line)).join('\n')}\n`;
}

/** A linear congruential generator: evenly spread enough for walks. */
function generator(seed: number): () => number {
  let state = seed;
  return () => {
    state = (state * 1664525 + 1013904223) % 4294967296;
    return state / 4294967296;
  };
}
