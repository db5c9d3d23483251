// Where the items of a place lie: on the obstacle or floor at its station, or at the machine that has them.

import type { Header, Point } from '../log/header';
import { boxOf, contains, distance, type Box } from './geometry';
import { groundAt, type Block, type StationSpot } from './layout';
import { inFrontOf, isBelt, settle, settledPlace, type MachineSpot } from './machine_places';

export interface MaterialSpot {
  place: string;
  centre: Point;
  ground: number;
  columns: number; // items lie in a grid of so many columns, then in layers
  atMachine: string | undefined;
}

interface MaterialTask {
  header: Header;
  stations: ReadonlyMap<string, StationSpot>;
  bounds: Box;
  blocks: readonly Block[];
  machines: readonly MachineSpot[];
  seenAt: ReadonlyMap<string, string>;
}

export const ITEM_M = 0.42;
const GAP_M = 1.3; // between the places at one station

export function placeMaterial(task: MaterialTask): Map<string, MaterialSpot> {
  const spots = new Map<string, MaterialSpot>();
  const atStations = new Map<string, string[]>();
  const others: string[] = [];
  for (const place of task.header.places) {
    if (place.berth) continue; // its items are in the carrier that stands there
    const station = place.at ?? task.seenAt.get(place.name);
    if (station !== undefined && task.stations.has(station)) {
      atStations.set(station, [...(atStations.get(station) ?? []), place.name]);
    } else others.push(place.name);
  }
  const used: Point[] = [];
  for (const [station, places] of atStations) {
    for (const [index, place] of places.entries()) {
      const centre = apart(task, stationSpot(task, station, index, places.length), used);
      used.push(centre);
      spots.set(place, { place, centre, ground: ground(task, centre), columns: 3, atMachine: undefined });
    }
  }
  placeAtMachines(task, others, spots);
  return spots;
}

/** In a row at the station, across the direction from the worker to the material. */
function stationSpot(task: MaterialTask, name: string, index: number, count: number): Point {
  const station = task.stations.get(name)!;
  const spot = inFrontOf(task, station);
  const pose = station.poses[0]!;
  const [dx, dy] = [spot[0] - pose[0], spot[1] - pose[1]];
  const vertical = Math.abs(dx) > Math.abs(dy);
  const shift = (index - (count - 1) / 2) * GAP_M;
  const moved: Point = vertical ? [spot[0], spot[1] + shift] : [spot[0] + shift, spot[1]];
  const block = task.blocks.find((candidate) => contains(candidate.polygon, spot));
  return clamped(moved, block ? boxOf(block.polygon) : task.bounds);
}

function clamped([x, y]: Point, box: Box): Point {
  const room = 0.5;
  return [
    Math.min(Math.max(x, box.x0 + room), Math.max(box.x0 + room, box.x1 - room)),
    Math.min(Math.max(y, box.y0 + room), Math.max(box.y0 + room, box.y1 - room)),
  ];
}

/** Away from material, and from machines of which it would hide the state. */
function apart(task: MaterialTask, wish: Point, used: Point[]): Point {
  const free = (spot: Point): boolean =>
    used.every((other) => distance(other, spot) >= 1.1) &&
    task.machines.every((machine) => machine.block || machine.overhead || distance(machine.centre, spot) >= 1.1);
  for (let step = 0; step < 60; ++step) {
    const out = 0.3 * Math.sqrt(step);
    const spot: Point = [wish[0] + out * Math.cos(step * 2.4), wish[1] + out * Math.sin(step * 2.4)];
    if (free(spot)) return spot;
  }
  return wish;
}

function ground(task: MaterialTask, centre: Point): number {
  const block = task.blocks.find((candidate) => candidate.machine && contains(candidate.polygon, centre));
  return block ? block.height : groundAt(task.blocks, centre);
}

/** Items without a station are at the machine that is working on them or will be. */
function placeAtMachines(task: MaterialTask, places: string[], spots: Map<string, MaterialSpot>): void {
  const anchors = new Map<string, Point>();
  for (const machine of task.machines) anchors.set(`m ${machine.name}`, machine.centre);
  for (const [place, spot] of spots) anchors.set(`p ${place}`, spot.centre);
  const settled = settle(task.header, anchors);
  const fixed = task.machines.filter((machine) => !machine.overhead);
  for (const place of places) {
    const machine =
      gantryOf(task, place) ?? machineOf(task, fixed, place) ?? nearest(fixed, settledPlace(settled, place));
    if (!machine) continue;
    spots.set(place, {
      place,
      centre: onBelt(task, fixed, place, machine) ?? machine.centre,
      ground: machine.ground + machine.height,
      columns: 2,
      atMachine: machine.name,
    });
  }
}

/** What runs on a belt comes in at one end and leaves at the other, which is nearer to where it is taken. */
function onBelt(task: MaterialTask, fixed: MachineSpot[], place: string, machine: MachineSpot): Point | undefined {
  const box = boxOf(machine.area);
  const [length, width] = [box.x1 - box.x0, box.y1 - box.y0];
  if (machine.overhead || machine.block || !isBelt(length, width)) return undefined;
  const [x, y] = machine.centre;
  const reach = Math.max(length, width) / 2 - ITEM_M;
  const ends: [Point, Point] =
    length > width
      ? [
          [x - reach, y],
          [x + reach, y],
        ]
      : [
          [x, y - reach],
          [x, y + reach],
        ];
  const outside = fixed.filter((other) => other !== machine);
  const operations = [...task.header.operations.values()];
  const next = (from: string): MachineSpot | undefined =>
    outside.find((other) =>
      operations.some((o) => o.consumes.has(from) && [...o.uses, ...o.claims].includes(other.name)),
    );
  const made = operations.filter((o) => o.consumes.has(place)).flatMap((o) => [...o.produces.keys()]);
  const taker = next(place);
  const later = taker ?? made.map(next).find((found) => found !== undefined);
  if (!later) return undefined;
  const [near, far] = distance(ends[0], later.centre) < distance(ends[1], later.centre) ? ends : [ends[1], ends[0]];
  return taker ? near : far;
}

/** The gantry that holds it, else the machine it was made in, else that of the operations that take it. */
function machineOf(task: MaterialTask, fixed: MachineSpot[], place: string): MachineSpot | undefined {
  for (const flow of ['produces', 'consumes'] as const) {
    for (const operation of task.header.operations.values()) {
      if (!operation[flow].has(place)) continue;
      const names = [...operation.uses, ...operation.claims, ...operation.frees];
      const found = fixed.find((machine) => names.includes(machine.name));
      if (found) return found;
    }
  }
  return undefined;
}

/** An operation that claims a gantry leaves in its gripper what it makes. */
function gantryOf(task: MaterialTask, place: string): MachineSpot | undefined {
  for (const operation of task.header.operations.values()) {
    if (!operation.produces.has(place)) continue;
    const found = task.machines.find((machine) => machine.overhead && operation.claims.includes(machine.name));
    if (found) return found;
  }
  return undefined;
}

function nearest(machines: MachineSpot[], point: Point | undefined): MachineSpot | undefined {
  if (!point) return undefined;
  let found: MachineSpot | undefined;
  for (const machine of machines) {
    if (!found || distance(machine.centre, point) < distance(found.centre, point)) found = machine;
  }
  return found;
}
