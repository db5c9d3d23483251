// Where the heads of gantries are: they fetch from where an operation takes its items and bring to where it puts them.

import type { Point, Tick } from '../log/header';
import type { Run } from '../run/run';
import { firstWhere } from '../run/series';
import { boxOf } from './geometry';
import type { Layout } from './layout';
import type { MachineSpot } from './machine_places';

export const BEAM_M = 3.3;
export const GRIPPER_M = 1.35; // where the head holds an item

interface Trip {
  begin: Tick;
  end: Tick;
  from: Point;
  to: Point;
}

export class Heads {
  private readonly trips = new Map<string, Trip[]>();
  private version = -1;

  constructor(
    private readonly run: Run,
    private readonly layout: Layout,
  ) {}

  at(machine: MachineSpot, time: number): Point {
    if (this.version !== this.run.version) this.follow();
    const trips = this.trips.get(machine.name) ?? [];
    const trip = trips[firstWhere(trips.length, (i) => trips[i]!.begin > time) - 1];
    if (!trip) return machine.centre;
    const share = trip.end > trip.begin ? Math.min(1, (time - trip.begin) / (trip.end - trip.begin)) : 1;
    return [trip.from[0] + share * (trip.to[0] - trip.from[0]), trip.from[1] + share * (trip.to[1] - trip.from[1])];
  }

  private follow(): void {
    this.version = this.run.version;
    for (const machine of this.layout.machines) {
      if (!machine.overhead) continue;
      const trips: Trip[] = [];
      let from = machine.centre;
      for (const { begin, end, state, operation } of this.run.machines.intervals.get(machine.name) ?? []) {
        if (state !== 'working') continue;
        const to = this.target(machine, operation) ?? from;
        trips.push({ begin, end, from, to });
        from = to;
      }
      this.trips.set(machine.name, trips);
    }
  }

  private target(machine: MachineSpot, name: string): Point | undefined {
    const operation = this.run.header.operations.get(name);
    if (!operation) return undefined;
    for (const place of [...operation.consumes.keys(), ...operation.produces.keys()]) {
      const spot = this.layout.material.get(place);
      if (spot && spot.atMachine !== machine.name) return onBeam(machine, spot.centre);
    }
    return undefined;
  }
}

function onBeam(machine: MachineSpot, [x, y]: Point): Point {
  const box = boxOf(machine.area);
  return box.x1 - box.x0 >= box.y1 - box.y0
    ? [Math.min(box.x1, Math.max(box.x0, x)), (box.y0 + box.y1) / 2]
    : [(box.x0 + box.x1) / 2, Math.min(box.y1, Math.max(box.y0, y))];
}
