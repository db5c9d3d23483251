// The ways ahead of those who move: ribbons on the floor in the colour of their task.

import { BufferAttribute, BufferGeometry, Color, DynamicDrawUsage, Mesh, type MeshBasicMaterial } from 'three';
import type { Pose } from '../log/header';
import { paint } from './paint';

export interface Way {
  points: Pose[];
  colour: string;
  width: number;
}

export class Paths {
  readonly mesh: Mesh<BufferGeometry, MeshBasicMaterial>;
  private room = 0; // corners that fit
  private readonly colour = new Color();

  constructor() {
    this.mesh = new Mesh(new BufferGeometry(), paint({ opacity: 0.8 }));
    this.mesh.frustumCulled = false;
  }

  draw(ways: readonly Way[]): void {
    const corners = ways.reduce((sum, way) => sum + Math.max(0, way.points.length - 1) * 6, 0);
    this.reserve(corners);
    const position = this.mesh.geometry.getAttribute('position') as BufferAttribute;
    const colour = this.mesh.geometry.getAttribute('color') as BufferAttribute;
    let next = 0;
    for (const way of ways) {
      this.colour.set(way.colour);
      for (let i = 0; i + 1 < way.points.length; ++i) {
        for (const [x, y] of quad(way.points[i]!, way.points[i + 1]!, way.width)) {
          position.setXYZ(next, x, 0.06, -y);
          colour.setXYZW(next, this.colour.r, this.colour.g, this.colour.b, 1);
          next += 1;
        }
      }
    }
    position.needsUpdate = colour.needsUpdate = true;
    this.mesh.geometry.setDrawRange(0, next);
    this.mesh.visible = next > 0;
  }

  private reserve(corners: number): void {
    if (corners <= this.room && this.room > 0) return;
    this.room = Math.max(600, corners * 2);
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    for (const [name, size] of [
      ['position', 3],
      ['color', 4],
    ] as const) {
      const attribute = new BufferAttribute(new Float32Array(this.room * size), size);
      this.mesh.geometry.setAttribute(name, attribute.setUsage(DynamicDrawUsage));
    }
  }
}

function quad(a: Pose, b: Pose, width: number): [number, number][] {
  const length = Math.hypot(b.x - a.x, b.y - a.y) || 1;
  const [nx, ny] = [((b.y - a.y) / length) * (width / 2), (-(b.x - a.x) / length) * (width / 2)];
  const corners: [number, number][] = [
    [a.x + nx, a.y + ny],
    [a.x - nx, a.y - ny],
    [b.x - nx, b.y - ny],
    [b.x + nx, b.y + ny],
  ];
  return [corners[0]!, corners[2]!, corners[1]!, corners[0]!, corners[3]!, corners[2]!]; // seen from above
}
