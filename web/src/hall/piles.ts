// Which items are drawn where at one time: in places, in carriers, and in the hands of operations.

import type { Point, Pose } from '../log/header';
import type { Run } from '../run/run';
import { CARRIER_DECK_M } from './figures';
import type { Scene } from './crowd';
import { GRIPPER_M, type Heads } from './heads';
import type { Layout } from './layout';
import { ITEM_M } from './material_places';

export interface Pile {
  at: Pose;
  ground: number; // metres
  columns: number;
  of: string; // material
  count: number;
  scale: number;
}

interface Spot {
  at: Point;
  ground: number;
}

export class Piles {
  private readonly overhead = new Map<string, Layout['machines'][number]>();

  constructor(
    private readonly run: Run,
    private readonly layout: Layout,
    private readonly heads: Heads,
  ) {
    for (const machine of layout.machines) if (machine.overhead) this.overhead.set(machine.name, machine);
  }

  at(time: number, scene: Scene): Pile[] {
    return [...this.inPlaces(time), ...this.inCarriers(time, scene), ...this.inOperations(time)];
  }

  private *inPlaces(time: number): Generator<Pile> {
    const beside = new Map<string, number>(); // by machine: how many of its places have items
    for (const { name, of } of this.run.header.places) {
      const place = this.layout.material.get(name);
      const count = this.run.material.count(name, time);
      if (!place || count <= 0 || !this.run.materials.has(of)) continue;
      const key = place.atMachine ? `${place.centre.join()} ${place.atMachine}` : name;
      const before = beside.get(key) ?? 0;
      beside.set(key, before + 1);
      const spot = this.spotOf(name, time)!;
      const at = { x: spot.at[0] + before * ITEM_M, y: spot.at[1], yaw: 0 };
      yield { at, ground: spot.ground, columns: place.columns, of, count, scale: 1 };
    }
  }

  private *inCarriers(time: number, scene: Scene): Generator<Pile> {
    const scale = this.layout.agentScale;
    for (const { id } of this.run.header.carriers) {
      const count = this.run.material.count(id, time);
      const { pose, held } = scene.carriers.get(id)!;
      const ground = (CARRIER_DECK_M + (held ? 0.12 : 0)) * scale;
      if (count > 0) yield { at: pose, ground, columns: 2, of: this.run.material.loadOf(id, time) ?? '', count, scale };
    }
  }

  /** What an operation has taken and not yet given back: on its way from the one place to the other. */
  private *inOperations(time: number): Generator<Pile> {
    const of = (place: string): string => this.run.header.places.find(({ name }) => name === place)?.of ?? '';
    for (const { operation, begin, end } of this.run.operationsAt(time)) {
      const { consumes, produces } = this.run.header.operations.get(operation)!;
      const goal = [...produces.keys()].find(
        (place) => this.layout.material.has(place) && this.run.materials.has(of(place)),
      );
      const share = (time - begin) / (end - begin);
      for (const [place, count] of consumes) {
        const from = this.spotOf(place, time);
        if (!from || !this.run.materials.has(of(place))) continue;
        const to = (goal === undefined ? undefined : this.spotOf(goal, time)) ?? from;
        const between = (a: number, b: number): number => a + share * (b - a);
        const at = { x: between(from.at[0], to.at[0]), y: between(from.at[1], to.at[1]), yaw: 0 };
        yield { at, ground: between(from.ground, to.ground), columns: 2, of: of(place), count, scale: 1 };
      }
    }
  }

  private spotOf(place: string, time: number): Spot | undefined {
    const spot = this.layout.material.get(place);
    if (!spot) return undefined;
    const gantry = spot.atMachine === undefined ? undefined : this.overhead.get(spot.atMachine);
    if (!gantry) return { at: spot.centre, ground: spot.ground };
    return { at: this.heads.at(gantry, time), ground: GRIPPER_M - 0.2 };
  }
}
