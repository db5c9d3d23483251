import { describe, expect, it } from 'vitest';
import { loadRun, logText, LOGS, RESULTS, runOf, type LogName } from '../../tests/support';
import type { DecisionEvent, TransferEvent, WayEvent } from '../log/events';
import { shares } from './diary';
import type { Run } from './run';

describe.each(LOGS)('the recorded run %s', (name: LogName) => {
  const run = loadRun(name);
  const result = RESULTS[name];

  it('ends as the simulator says', () => {
    expect(run.end?.makespan).toBe(result.makespan);
    expect(run.decisions).toHaveLength(result.decisions);
    expect(run.finished(run.last)).toBe(run.header.order!.quantity);
  });

  it('splits every worker’s time as the simulator does', () => {
    for (const { id } of run.header.workers) {
      const sum = shares(run.activities(id), run.last);
      const said = result.workers[id]!;
      const ticks = { work: said.work, walk: said.travel, wait: said.wait, idle: said.idle };
      for (const [kind, share] of Object.entries(ticks)) {
        expect(sum[kind as keyof typeof sum], `${id} ${kind}`).toBeCloseTo(share * run.last, 3);
      }
    }
  });

  it('keeps every machine busy as long as the simulator does', () => {
    for (const machine of run.header.machines) {
      const busy = run.machines.intervals
        .get(machine)!
        .reduce((sum, interval) => sum + Math.min(interval.end, run.last) - interval.begin, 0);
      expect(busy, machine).toBeCloseTo(result.machines[machine]! * run.last, 3);
    }
  });

  it('has activities in order of time, without overlaps', () => {
    for (const { id } of run.header.workers) {
      let filled = 0;
      for (const activity of run.activities(id)) {
        expect(activity.begin, `${id}`).toBeGreaterThanOrEqual(filled);
        filled = activity.end;
      }
      expect(filled).toBeLessThanOrEqual(run.last);
    }
  });

  it('keeps every count between nothing and the capacity', () => {
    const capacities = new Map<string, number | undefined>();
    for (const place of run.header.places) capacities.set(place.name, place.capacity);
    for (const carrier of run.header.carriers) capacities.set(carrier.id, carrier.capacity);
    for (const [where, series] of run.material.counts) {
      expect(Math.min(series.initial, ...series.values), where).toBeGreaterThanOrEqual(0);
      expect(series.max, where).toBeLessThanOrEqual(capacities.get(where) ?? Infinity);
    }
  });

  it('has every worker where the log says when a way begins and ends, and never lets one jump', () => {
    for (const event of events(name).filter((e): e is WayEvent => e.event === 'go' || e.event === 'reroute')) {
      const motion = run.motions.get(event.worker)!;
      const start = event.pose ?? asList(run.pose(event.from!, run.kindOf(event.worker)));
      const at = motion.at(event.t).pose;
      expect(Math.hypot(at.x - start[0]!, at.y - start[1]!), JSON.stringify(event)).toBeLessThan(1e-3);
    }
    for (const { id, kind } of run.header.workers) {
      const speed = (run.header.kinds.get(kind)?.length ?? 2) * 3;
      let before = run.motions.get(id)!.at(0).pose;
      for (let t = 0.25; t <= run.last; t += 0.25) {
        const now = run.motions.get(id)!.at(t).pose;
        expect(Math.hypot(now.x - before.x, now.y - before.y), `${id} at ${t}`).toBeLessThan(speed);
        before = now;
      }
    }
  });
});

describe('counts', () => {
  it.each(['routed', 'kitting_cell'] as const)('of %s are those that the reasons of its decisions name', (name) => {
    const run = loadRun(name);
    const checked = run.decisions.reduce((sum, decision) => sum + compareWithReasons(run, name, decision), 0);
    expect(checked).toBeGreaterThan(5);
  });

  it('of carriers are of the material that was put in last', () => {
    const run = loadRun('routed');
    const moved = events('routed').filter(
      (e): e is TransferEvent => e.event === 'transfer' && 'to' in e && String(e.to).startsWith('cage'),
    );
    const materials = new Set<string>();
    for (const { t, to, from } of moved) {
      const material = run.header.places.find((place) => place.name === from)!.of;
      expect(run.material.loadOf(to, t + 1)).toBe(material);
      materials.add(material);
    }
    expect([...materials].sort()).toEqual(['bend', 'flange']);
    const full = run.material.counts.get('outfeed_berth')!.ticks[1]!;
    const cage = run.header.carriers.find(({ id }) => run.material.loadOf(id, full) === 'duct');
    expect(cage).toBeDefined();
  });

  it('follow a carrier that stands in a berth', () => {
    const run = loadRun('routed');
    const series = run.material.counts.get('outfeed_berth')!;
    expect(series.max).toBeGreaterThan(0);
    expect(run.material.count('outfeed_berth', run.last)).toBe(0);
  });
});

/** "flange_table is 4, may be at most 0": the count before the decision. Returns how many were compared. */
function compareWithReasons(run: Run, name: LogName, decision: DecisionEvent): number {
  let compared = 0;
  for (const reason of Object.values(decision.why?.not_selectable ?? {})) {
    const said = /^([\w.]+) is (\d+),/.exec(reason);
    if (!said || !run.material.counts.has(said[1]!)) continue;
    // The counts as the run stood before the decision: the log up to its line.
    const before = runOf(logText(name).slice(0, logText(name).indexOf(`"event":"decision","n":${decision.n},`)));
    expect(before.material.count(said[1]!, decision.t), reason).toBe(Number(said[2]));
    compared += 1;
  }
  return compared;
}

function events(name: LogName): { event: string }[] {
  return logText(name)
    .trim()
    .split('\n')
    .slice(1)
    .map((line) => JSON.parse(line) as { event: string });
}

function asList(pose: { x: number; y: number; yaw: number }): number[] {
  return [pose.x, pose.y, pose.yaw];
}
