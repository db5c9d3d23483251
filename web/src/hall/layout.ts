// Where everything of a line stands in the picture: what the log says, and sensible places for what it does not.

import type { Header, Obstacle, Point } from '../log/header';
import { boxOf, contains, middle, type Box } from './geometry';
import { placeMachines, type MachineSpot } from './machine_places';
import { placeMaterial, type MaterialSpot } from './material_places';

export interface Block extends Obstacle {
  look: 'wall' | 'solid' | 'open'; // open: high, drawn as glass so that what is inside and behind stays visible
  machine?: string; // the machine that this obstacle is
}

export interface StationSpot {
  name: string;
  centre: Point;
  poses: Point[];
}

export interface Layout {
  bounds: Box;
  ownWalls: boolean; // the scenario draws walls itself
  blocks: Block[];
  stations: Map<string, StationSpot>;
  machines: MachineSpot[];
  material: Map<string, MaterialSpot>;
  agentScale: number; // people and robots are drawn larger than life in big halls
}

/** Higher obstacles are drawn as glass. */
const OPEN_FROM_M = 1.7;
/** Margin around the stations when the log has no hall. */
const MARGIN_M = 3;

export function layOut(header: Header, seenAt: ReadonlyMap<string, string> = new Map()): Layout {
  const stations = stationSpots(header);
  const bounds = hallBounds(header, stations);
  const blocks = header.obstacles.map((obstacle) => block(obstacle, bounds, header.machines));
  const machines = placeMachines({ header, stations, blocks, bounds, seenAt });
  const material = placeMaterial({ header, stations, bounds, blocks, machines, seenAt });
  const span = Math.max(bounds.x1 - bounds.x0, bounds.y1 - bounds.y0);
  return {
    bounds,
    ownWalls: blocks.some((candidate) => candidate.look === 'wall'),
    blocks,
    stations,
    machines,
    material,
    agentScale: Math.min(2.2, Math.max(1, span / 40)),
  };
}

function stationSpots(header: Header): Map<string, StationSpot> {
  const spots = new Map<string, StationSpot>();
  for (const [name, kinds] of header.stations) {
    const poses = [...kinds.values()].map(({ x, y }): Point => [x, y]);
    if (poses.length > 0) spots.set(name, { name, centre: middle(boxOf(poses)), poses });
  }
  return spots;
}

function hallBounds(header: Header, stations: Map<string, StationSpot>): Box {
  if (header.bounds) {
    const [x0, x1, y0, y1] = header.bounds;
    return { x0, x1, y0, y1 };
  }
  const points = [...stations.values()].flatMap((station) => station.poses);
  for (const obstacle of header.obstacles) points.push(...obstacle.polygon);
  if (points.length === 0) return { x0: -5, x1: 5, y0: -5, y1: 5 };
  const box = boxOf(points);
  return { x0: box.x0 - MARGIN_M, x1: box.x1 + MARGIN_M, y0: box.y0 - MARGIN_M, y1: box.y1 + MARGIN_M };
}

function block(obstacle: Obstacle, bounds: Box, machines: string[]): Block {
  const box = boxOf(obstacle.polygon);
  const [long, short] = [box.x1 - box.x0, box.y1 - box.y0].sort((a, b) => b - a) as [number, number];
  const touches =
    box.x0 <= bounds.x0 + 0.01 ||
    box.x1 >= bounds.x1 - 0.01 ||
    box.y0 <= bounds.y0 + 0.01 ||
    box.y1 >= bounds.y1 - 0.01;
  if (touches && short <= 1 && long > 8 * short) return { ...obstacle, look: 'wall' };
  const plain = (name: string): string => name.toLowerCase().replaceAll(/[^a-z0-9]/g, '');
  const machine = machines.find((name) => plain(name) === plain(obstacle.name));
  if (machine) return { ...obstacle, look: 'solid', machine };
  const pillar = long * short < 3;
  return { ...obstacle, look: obstacle.height >= OPEN_FROM_M && !pillar ? 'open' : 'solid' };
}

/** The top of what stands at a point: floor, a plinth inside of glass, or a block. */
export function groundAt(blocks: readonly Block[], point: Point): number {
  let height = 0;
  for (const candidate of blocks) {
    if (candidate.look === 'wall' || candidate.machine || !contains(candidate.polygon, point)) continue;
    height = Math.max(height, candidate.look === 'open' ? PLINTH_M : candidate.height);
  }
  return height;
}

export const PLINTH_M = 0.12;
