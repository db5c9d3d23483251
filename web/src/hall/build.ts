// Puts plain shapes together into one geometry with a colour per corner, so that a whole hall is a few draw calls.
// The light is painted into the colours: without a graphics card light that is computed per pixel is what costs most.
// Map coordinates (x, y, up) become three.js' (x, up, -y).

import {
  BoxGeometry,
  BufferAttribute,
  BufferGeometry,
  Color,
  CylinderGeometry,
  Matrix4,
  Shape,
  ShapeGeometry,
  ExtrudeGeometry,
  SphereGeometry,
  Vector3,
} from 'three';
import type { Point } from '../log/header';

export class Builder {
  private readonly positions: number[] = [];
  private readonly colours: number[] = [];
  private readonly vector = new Vector3();
  private readonly colour = new Color();

  get empty(): boolean {
    return this.positions.length === 0;
  }

  add(shape: BufferGeometry, colour: string, move?: Matrix4): this {
    const geometry = shape.index ? shape.toNonIndexed() : shape;
    if (move) geometry.applyMatrix4(move);
    const position = geometry.getAttribute('position');
    const normal = geometry.getAttribute('normal');
    this.colour.set(colour);
    for (let i = 0; i < position.count; ++i) {
      this.vector.fromBufferAttribute(position, i);
      this.positions.push(this.vector.x, this.vector.y, this.vector.z);
      this.vector.fromBufferAttribute(normal, i);
      const light = brightness(this.vector);
      this.colours.push(this.colour.r * light, this.colour.g * light, this.colour.b * light, 1);
    }
    return this;
  }

  /** A box with its middle at (x, y), standing at height `from`. */
  box(size: [number, number, number], at: [number, number, number], colour: string): this {
    const [length, width, height] = size;
    const move = new Matrix4().makeTranslation(at[0], at[2] + height / 2, -at[1]);
    return this.add(new BoxGeometry(length, height, width), colour, move);
  }

  /** A standing cylinder or cone. */
  pillar(
    radii: [bottom: number, top: number],
    height: number,
    at: [number, number, number],
    colour: string,
    sides = 10,
  ): this {
    const move = new Matrix4().makeTranslation(at[0], at[2] + height / 2, -at[1]);
    return this.add(new CylinderGeometry(radii[1], radii[0], height, sides), colour, move);
  }

  ball(radius: number, at: [number, number, number], colour: string): this {
    return this.add(new SphereGeometry(radius, 9, 6), colour, new Matrix4().makeTranslation(at[0], at[2], -at[1]));
  }

  prism(polygon: readonly Point[], from: number, height: number, colour: string): this {
    return this.add(prismGeometry(polygon, height), colour, new Matrix4().makeTranslation(0, from, 0));
  }

  done(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(new Float32Array(this.positions), 3));
    geometry.setAttribute('color', new BufferAttribute(new Float32Array(this.colours), 4));
    return geometry;
  }
}

/** A sun from the upper left in front, a bright sky, and a floor that gives some of it back. */
function brightness(normal: Vector3): number {
  const sun = Math.max(0, normal.dot(SUN));
  return 0.14 + 0.4 * (0.3 + 0.7 * (0.5 + 0.5 * normal.y)) + 0.55 * sun;
}

const SUN = new Vector3(-0.5, 1, 0.7).normalize();
const UPRIGHT = new Matrix4().makeRotationX(-Math.PI / 2);

export function prismGeometry(polygon: readonly Point[], height: number): BufferGeometry {
  return new ExtrudeGeometry(shapeOf(polygon), { depth: height, bevelEnabled: false }).applyMatrix4(UPRIGHT);
}

export function flatGeometry(polygon: readonly Point[]): BufferGeometry {
  return new ShapeGeometry(shapeOf(polygon)).applyMatrix4(UPRIGHT);
}

function shapeOf(polygon: readonly Point[]): Shape {
  const shape = new Shape();
  polygon.forEach(([x, y], i) => (i === 0 ? shape.moveTo(x, y) : shape.lineTo(x, y)));
  shape.closePath();
  return shape;
}

/** A ring around the polygon (counter-clockwise) that fades from dark to nothing: where it touches the floor. */
export function contactShadow(polygon: readonly Point[], reach: number, strength: number): BufferGeometry {
  const positions: number[] = [];
  const colours: number[] = [];
  const outer = outset(polygon, reach);
  const corner = ([x, y]: Point, alpha: number): void => {
    positions.push(x, 0, -y);
    colours.push(0, 0, 0, alpha);
  };
  for (let i = 0; i < polygon.length; ++i) {
    const j = (i + 1) % polygon.length;
    for (const [point, alpha] of [
      [polygon[i]!, strength],
      [outer[i]!, 0],
      [outer[j]!, 0],
      [polygon[i]!, strength],
      [outer[j]!, 0],
      [polygon[j]!, strength],
    ] as [Point, number][])
      corner(point, alpha);
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 4));
  return geometry;
}

/** The polygon (counter-clockwise) moved outwards; corners keep their number. */
function outset(polygon: readonly Point[], by: number): Point[] {
  return polygon.map((point, i) => {
    const before = polygon[(i + polygon.length - 1) % polygon.length]!;
    const after = polygon[(i + 1) % polygon.length]!;
    const [n1, n2] = [outward(before, point), outward(point, after)];
    const scale = by / Math.max(0.3, 1 + n1[0] * n2[0] + n1[1] * n2[1]);
    return [point[0] + (n1[0] + n2[0]) * scale, point[1] + (n1[1] + n2[1]) * scale];
  });
}

function outward(a: Point, b: Point): Point {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]) || 1;
  return [(b[1] - a[1]) / length, -(b[0] - a[0]) / length];
}

export function discGeometry(radius: number, sides: number): BufferGeometry {
  const geometry = new BufferGeometry();
  const positions: number[] = [];
  const colours: number[] = [];
  for (let i = 0; i < sides; ++i) {
    const [a, b] = [(i / sides) * 2 * Math.PI, ((i + 1) / sides) * 2 * Math.PI];
    positions.push(
      0,
      0,
      0,
      radius * Math.cos(a),
      0,
      -radius * Math.sin(a),
      radius * Math.cos(b),
      0,
      -radius * Math.sin(b),
    );
    colours.push(0, 0, 0, 0.42, 0, 0, 0, 0, 0, 0, 0, 0);
  }
  geometry.setAttribute('position', new BufferAttribute(new Float32Array(positions), 3));
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(colours), 4));
  return geometry;
}
