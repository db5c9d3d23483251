// Everything that does not move: floor, walls, obstacles, the stations' marks and the routes.

import {
  BufferAttribute,
  BufferGeometry,
  EdgesGeometry,
  Float32BufferAttribute,
  Group,
  LineSegments,
  Mesh,
  RingGeometry,
} from 'three';
import type { Header, Point } from '../log/header';
import type { Run } from '../run/run';
import { kindIndex, pickFrom, type Theme } from '../ui/theme';
import { Builder, contactShadow, flatGeometry, prismGeometry } from './build';
import { PLINTH_M, type Block, type Layout } from './layout';
import { paint, white } from './paint';

const WALL_M = 1.1; // walls are drawn low, so that one looks over them
const RIM_M = 0.25; // the rim around a hall without walls

export function buildFloor(layout: Layout, header: Header, theme: Theme): Group {
  const group = new Group();
  const { x0, x1, y0, y1 } = layout.bounds;
  const floor: Point[] = [
    [x0, y0],
    [x1, y0],
    [x1, y1],
    [x0, y1],
  ];
  const ground = new Mesh(white(flatGeometry(floor)), paint({ colour: theme.floor, flat: true }));
  ground.renderOrder = -4;
  group.add(ground, grid(layout, theme));
  const solid = new Builder();
  const glass = new Builder();
  const edges = new EdgeLines();
  for (const block of layout.blocks) addBlock(block, theme, solid, glass, edges);
  if (!layout.ownWalls) rim(layout, theme, solid);
  if (!solid.empty) group.add(new Mesh(solid.done(), paint()));
  if (!glass.empty) {
    const mesh = new Mesh(glass.done(), paint({ opacity: 0.2 }));
    mesh.renderOrder = 5;
    group.add(mesh);
  }
  group.add(edges.lines(theme.edge));
  const reach = Math.min(0.9, Math.max(x1 - x0, y1 - y0) / 50);
  for (const block of layout.blocks)
    group.add(shadowOf(block.polygon, reach * (block.look === 'wall' ? 0.6 : 1), theme));
  group.add(stationMarks(header, theme));
  return group;
}

function addBlock(block: Block, theme: Theme, solid: Builder, glass: Builder, edges: EdgeLines): void {
  if (block.look === 'wall') return void solid.prism(block.polygon, 0, Math.min(WALL_M, block.height), theme.wall);
  if (block.look === 'open') {
    solid.prism(block.polygon, 0, PLINTH_M, theme.block);
    glass.prism(block.polygon, PLINTH_M, block.height - PLINTH_M, theme.glass);
    edges.add(prismGeometry(block.polygon, block.height));
    return;
  }
  if (!block.machine) solid.prism(block.polygon, 0, block.height, theme.block); // a machine draws itself
  edges.add(prismGeometry(block.polygon, block.height));
}

function rim({ bounds: { x0, x1, y0, y1 } }: Layout, theme: Theme, solid: Builder): void {
  const thick = 0.15;
  const [cx, cy] = [(x0 + x1) / 2, (y0 + y1) / 2];
  for (const y of [y0, y1]) solid.box([x1 - x0 + thick, thick, RIM_M], [cx, y, 0], theme.wall);
  for (const x of [x0, x1]) solid.box([thick, y1 - y0 + thick, RIM_M], [x, cy, 0], theme.wall);
}

function grid({ bounds: { x0, x1, y0, y1 } }: Layout, theme: Theme): LineSegments {
  const step = Math.max(x1 - x0, y1 - y0) > 80 ? 10 : Math.max(x1 - x0, y1 - y0) > 25 ? 5 : 1;
  const points: number[] = [];
  for (let x = Math.ceil(x0 / step) * step; x <= x1; x += step) points.push(x, 0, -y0, x, 0, -y1);
  for (let y = Math.ceil(y0 / step) * step; y <= y1; y += step) points.push(x0, 0, -y, x1, 0, -y);
  const lines = segments(points, theme.grid, 1);
  lines.renderOrder = -3;
  return lines;
}

function shadowOf(polygon: readonly Point[], reach: number, theme: Theme): Mesh {
  const strength = theme.name === 'dark' ? 0.5 : 0.22;
  const mesh = new Mesh(contactShadow(polygon, reach, strength), paint({ seeThrough: true }));
  mesh.position.y = 0.01;
  mesh.renderOrder = -2;
  return mesh;
}

/** A ring where somebody stands, with a short line where they look. */
function stationMarks(header: Header, theme: Theme): Group {
  const group = new Group();
  const kinds = [...new Set(header.workers.map((worker) => worker.kind))];
  const rings = new Builder();
  for (const poses of header.stations.values()) {
    for (const [kind, { x, y, yaw }] of poses) {
      const colour = pickFrom(theme.kinds, kindIndex(kind, kinds));
      const ring = new RingGeometry(0.38, 0.5, 20).rotateX(-Math.PI / 2).translate(x, 0.02, -y);
      rings.add(ring, colour);
      const pointer = new RingGeometry(0.5, 0.75, 6, 1, -0.25, 0.5)
        .rotateX(-Math.PI / 2)
        .rotateY(yaw)
        .translate(x, 0.02, -y);
      rings.add(pointer, colour);
    }
  }
  if (rings.empty) return group;
  const mesh = new Mesh(rings.done(), paint({ opacity: 0.55 }));
  mesh.renderOrder = -1;
  group.add(mesh);
  return group;
}

/** The ways that were gone, each once: thin lines on the floor. */
export function buildRoutes(run: Run, theme: Theme): LineSegments {
  const seen = new Set<string>();
  const points: number[] = [];
  const height = 0.03;
  for (const motion of run.motions.values()) {
    for (const { from, to, path } of motion.ways()) {
      const key = [from.x, from.y, to.x, to.y, path?.length ?? 0].map((value) => value.toFixed(2)).join();
      if (seen.has(key)) continue;
      seen.add(key);
      let [px, py] = [from.x, from.y];
      for (const [x, y] of [...(path ?? []).map((p): Point => [p[0], p[1]]), [to.x, to.y] as Point]) {
        points.push(px, height, -py, x, height, -y);
        [px, py] = [x, y];
      }
    }
  }
  const lines = segments(points, theme.route, 0.8);
  lines.renderOrder = -1;
  return lines;
}

/** The zones of the floor, each a mesh that shows when it is closed. */
export function buildZones(header: Header, theme: Theme): Map<string, Mesh> {
  const zones = new Map<string, Mesh>();
  for (const { name, polygon } of header.zones) {
    const mesh = new Mesh(white(flatGeometry(polygon)), paint({ colour: theme.closed, opacity: 0.28 }));
    mesh.position.y = 0.025;
    zones.set(name, mesh);
  }
  return zones;
}

function segments(points: number[], colour: string, opacity: number): LineSegments {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(points, 3));
  return new LineSegments(white(geometry), paint({ colour, opacity, flat: true }));
}

/** Collects edges of shapes into one set of lines. */
class EdgeLines {
  private readonly points: number[] = [];

  add(shape: BufferGeometry): void {
    const position = new EdgesGeometry(shape, 20).getAttribute('position') as BufferAttribute;
    this.points.push(...position.array);
  }

  lines(colour: string): LineSegments {
    return segments(this.points, colour, 0.55);
  }
}
