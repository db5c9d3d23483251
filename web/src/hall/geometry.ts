// Plane geometry for laying out the hall.

import type { Point } from '../log/header';

export interface Box {
  x0: number;
  x1: number;
  y0: number;
  y1: number;
}

export function boxOf(points: Iterable<Point>): Box {
  const box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
  for (const [x, y] of points) {
    box.x0 = Math.min(box.x0, x);
    box.x1 = Math.max(box.x1, x);
    box.y0 = Math.min(box.y0, y);
    box.y1 = Math.max(box.y1, y);
  }
  return box;
}

export const middle = (box: Box): Point => [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2];

export function contains(polygon: readonly Point[], [x, y]: Point): boolean {
  let inside = false;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const [xi, yi] = polygon[i]!;
    const [xj, yj] = polygon[j]!;
    if (yi > y !== yj > y && x < ((xj - xi) * (y - yi)) / (yj - yi) + xi) inside = !inside;
  }
  return inside;
}

/** The point of the polygon's edge that is nearest to `point`. */
export function nearestOnEdge(polygon: readonly Point[], point: Point): Point {
  let found: Point = polygon[0]!;
  let best = Infinity;
  for (let i = 0, j = polygon.length - 1; i < polygon.length; j = i++) {
    const candidate = nearestOnSegment(polygon[j]!, polygon[i]!, point);
    const far = Math.hypot(candidate[0] - point[0], candidate[1] - point[1]);
    if (far < best) {
      best = far;
      found = candidate;
    }
  }
  return found;
}

function nearestOnSegment(a: Point, b: Point, p: Point): Point {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const length = dx * dx + dy * dy;
  const part = length > 0 ? Math.min(1, Math.max(0, ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length)) : 0;
  return [a[0] + part * dx, a[1] + part * dy];
}

export function distance(a: Point, b: Point): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1]);
}
