// Where machines stand: at their area or station; others in the middle between what they work on, near it.

import type { Header, OperationInfo, Point } from '../log/header';
import { boxOf, contains, distance, middle, nearestOnEdge, type Box } from './geometry';
import { groundAt, PLINTH_M, type Block, type StationSpot } from './layout';

export interface MachineSpot {
  name: string;
  centre: Point;
  area: Point[]; // on the floor, counter-clockwise
  ground: number; // metres above the floor
  height: number;
  known: boolean; // the log says where it stands
  block: boolean; // an obstacle of the hall is this machine
  overhead: boolean; // it moves between positions: drawn as a gantry that spans them
}

export interface MachineTask {
  header: Header;
  stations: ReadonlyMap<string, StationSpot>;
  blocks: readonly Block[];
  bounds: Box;
  seenAt: ReadonlyMap<string, string>;
}

const SIZE_M = 1.1;
const REACH_M = 2; // how far in front of a station its machine or material may stand, and half of it behind
const HEIGHT_M = 1.1;
const OVERHEAD = /gantry|crane|hoist/i; // and every machine that has positions

export function placeMachines(task: MachineTask): MachineSpot[] {
  const { header, blocks } = task;
  const spots = new Map<string, MachineSpot>();
  for (const name of header.machines) {
    const block = blocks.find((candidate) => candidate.machine === name);
    const area = block?.polygon ?? header.machineAreas.get(name);
    if (area) spots.set(name, withArea(task, name, area, block));
  }
  const anchors = placeAnchors(task);
  for (const [name, spot] of spots) anchors.set(machineKey(name), spot.centre);
  const towards = settle(header, anchors);
  const waiting = header.machines.filter((name) => !spots.has(name));
  const row = rowAlongTheSide(task, waiting.length);
  for (const [index, name] of waiting.entries()) {
    const station = stationOf(task, name);
    const known = station ? inFrontOf(task, station) : undefined;
    const wish = known ?? towards.get(machineKey(name)) ?? row[index]!;
    const centre = freeSpotNear(task, wish, [...spots.values()]);
    spots.set(name, standard(task, name, centre, known !== undefined));
  }
  return header.machines.map((name) => spots.get(name)!);
}

function withArea(task: MachineTask, name: string, area: Point[], block: Block | undefined): MachineSpot {
  const box = boxOf(area);
  const centre = middle(box);
  const overhead = !block && ((task.header.machinePositions.get(name)?.length ?? 0) > 0 || OVERHEAD.test(name));
  const ground = block || overhead ? 0 : groundAt(task.blocks, centre);
  const height = block?.height ?? heightOf(box.x1 - box.x0, box.y1 - box.y0, ground);
  return { name, centre, area, ground, height, known: true, block: block !== undefined, overhead };
}

/** Low where it is long (a belt) or stands on something; never so high that it hides what is behind it. */
function heightOf(length: number, width: number, ground: number): number {
  const long = isBelt(length, width);
  if (ground > PLINTH_M) return long ? 0.15 : 0.45;
  return long ? 0.5 : length * width > 2 ? 0.8 : HEIGHT_M;
}

export function isBelt(length: number, width: number): boolean {
  return Math.max(length, width) >= 4 * Math.min(length, width);
}

function standard(task: MachineTask, name: string, [x, y]: Point, known: boolean): MachineSpot {
  const half = SIZE_M / 2;
  const area: Point[] = [
    [x - half, y - half],
    [x + half, y - half],
    [x + half, y + half],
    [x - half, y + half],
  ];
  return {
    name,
    centre: [x, y],
    area,
    ground: groundAt(task.blocks, [x, y]),
    height: HEIGHT_M,
    known,
    block: false,
    overhead: false,
  };
}

function stationOf(task: MachineTask, machine: string): StationSpot | undefined {
  const name = task.header.machineStations.get(machine) ?? task.seenAt.get(machine);
  return name === undefined ? undefined : task.stations.get(name);
}

/** On the obstacle that a station belongs to, else a step away from it. */
export function inFrontOf(task: Pick<MachineTask, 'header' | 'blocks'>, station: StationSpot): Point {
  const poses = [...(task.header.stations.get(station.name)?.values() ?? [])];
  let best: { spot: Point; far: number } | undefined;
  for (const block of task.blocks) {
    if (block.look === 'wall') continue;
    for (const { x, y, yaw } of poses) {
      const edge = nearestOnEdge(block.polygon, [x, y]);
      const gap = distance(edge, [x, y]);
      const ahead = gap > 0 ? ((edge[0] - x) * Math.cos(yaw) + (edge[1] - y) * Math.sin(yaw)) / gap : 1;
      if (gap > (ahead > -0.5 ? REACH_M : REACH_M / 2)) continue;
      const far = gap * (1 - 0.35 * ahead); // what a worker looks at counts as nearer
      if (!best || far < best.far) best = { spot: inside(block, edge, 0.8), far };
    }
  }
  if (best) return best.spot;
  const pose = poses[0];
  return pose ? [pose.x + 1.3 * Math.cos(pose.yaw), pose.y + 1.3 * Math.sin(pose.yaw)] : station.centre;
}

/** A point of the block, at most `depth` from the edge point. */
function inside(block: Block, edge: Point, depth: number): Point {
  const box = boxOf(block.polygon);
  const clamp = (value: number, low: number, high: number): number => {
    const room = Math.min(depth, (high - low) / 2);
    return Math.min(high - room, Math.max(low + room, value));
  };
  const spot: Point = [clamp(edge[0], box.x0, box.x1), clamp(edge[1], box.y0, box.y1)];
  return contains(block.polygon, spot) ? spot : edge;
}

const machineKey = (name: string): string => `m ${name}`;
const placeKey = (name: string): string => `p ${name}`;

function placeAnchors(task: MachineTask): Map<string, Point> {
  const anchors = new Map<string, Point>();
  for (const place of task.header.places) {
    const station = task.stations.get(place.at ?? task.seenAt.get(place.name) ?? '');
    if (station) anchors.set(placeKey(place.name), inFrontOf(task, station));
  }
  for (const machine of task.header.machines) {
    const station = stationOf(task, machine);
    if (station) anchors.set(machineKey(machine), inFrontOf(task, station));
  }
  return anchors;
}

/** Draws everything to the middle of what it has to do with, through the operations; the anchors stay. */
export function settle(header: Header, anchors: ReadonlyMap<string, Point>): Map<string, Point> {
  const groups = [...header.operations.values()].map(involved);
  const at = new Map(anchors);
  for (let round = 0; round < 60; ++round) {
    const sums = new Map<string, { x: number; y: number; count: number }>();
    for (const group of groups) {
      const known = group.flatMap((key) => at.get(key) ?? []);
      if (known.length === 0) continue;
      const points = group.flatMap((key): Point[] => (at.has(key) ? [at.get(key)!] : []));
      const x = points.reduce((sum, point) => sum + point[0], 0) / points.length;
      const y = points.reduce((sum, point) => sum + point[1], 0) / points.length;
      for (const key of group) {
        const sum = sums.get(key) ?? { x: 0, y: 0, count: 0 };
        sums.set(key, { x: sum.x + x, y: sum.y + y, count: sum.count + 1 });
      }
    }
    for (const [key, { x, y, count }] of sums) if (!anchors.has(key)) at.set(key, [x / count, y / count]);
  }
  return at;
}

function involved(operation: OperationInfo): string[] {
  const machines = [...operation.uses, ...operation.claims, ...operation.frees].map(machineKey);
  const places = [...operation.consumes.keys(), ...operation.produces.keys()].map(placeKey);
  return [...new Set([...machines, ...places])];
}

export function settledPlace(settled: ReadonlyMap<string, Point>, place: string): Point | undefined {
  return settled.get(placeKey(place));
}

/** A tidy row along the side of the floor that is farthest from the stations. */
function rowAlongTheSide({ bounds, stations }: MachineTask, count: number): Point[] {
  const low = [...stations.values()].reduce((sum, { centre }) => sum + centre[1] - bounds.y0, 0);
  const high = [...stations.values()].reduce((sum, { centre }) => sum + bounds.y1 - centre[1], 0);
  const y = low > high ? bounds.y0 + 1.5 : bounds.y1 - 1.5;
  const step = Math.min(3, (bounds.x1 - bounds.x0 - 2) / Math.max(1, count));
  const first = (bounds.x0 + bounds.x1) / 2 - (step * (count - 1)) / 2;
  return Array.from({ length: count }, (_, index): Point => [first + index * step, y]);
}

/** The nearest spot on a spiral where no machine, no station and no edge of a block is in the way. */
function freeSpotNear(task: MachineTask, wish: Point, taken: MachineSpot[]): Point {
  for (let step = 0; step < 400; ++step) {
    const turn = step * 2.4; // the golden angle: the spiral has no gaps
    const out = 0.35 * Math.sqrt(step);
    const spot: Point = [wish[0] + out * Math.cos(turn), wish[1] + out * Math.sin(turn)];
    if (isFree(task, spot, taken)) return spot;
  }
  return wish;
}

function isFree({ bounds, stations, blocks }: MachineTask, spot: Point, taken: MachineSpot[]): boolean {
  const [x, y] = spot;
  if (x < bounds.x0 + 1 || x > bounds.x1 - 1 || y < bounds.y0 + 1 || y > bounds.y1 - 1) return false;
  for (const machine of taken) {
    if (machine.overhead) continue;
    if (contains(machine.area, spot) || distance(nearestOnEdge(machine.area, spot), spot) < SIZE_M * 0.75) return false;
  }
  for (const station of stations.values()) {
    if (station.poses.some((pose) => distance(pose, spot) < SIZE_M)) return false;
  }
  // Not across the edge of a block, and not in a wall.
  return blocks.every((block) => {
    const within = contains(block.polygon, spot);
    if (within && (block.look === 'wall' || block.machine)) return false;
    return distance(nearestOnEdge(block.polygon, spot), spot) >= (within ? 0.4 : 0.7);
  });
}
