// What people, robots, carriers and items look like, in metres, heading along +x, standing on the floor.
// `colour` is that of the kind. Where there are many, plain ones have a fifth of the corners.

import type { BufferGeometry } from 'three';
import { Builder } from './build';
import { ITEM_M } from './material_places';

export function personFigure(colour: string, plain: boolean): BufferGeometry {
  if (plain) {
    return new Builder()
      .pillar([0.2, 0.28], 1.38, [0, 0, 0], colour, 6)
      .pillar([0.18, 0.14], 0.34, [0, 0, 1.38], '#f2d03b', 6)
      .box([0.2, 0.2, 0.05], [0.16, 0, 1.5], '#f2d03b')
      .done();
  }
  return new Builder()
    .pillar([0.17, 0.2], 0.72, [0, 0, 0], '#39444f') // legs
    .pillar([0.22, 0.29], 0.68, [0, 0, 0.7], colour) // torso
    .box([0.16, 0.16, 0.42], [0.06, 0.31, 0.85], colour) // arms
    .box([0.16, 0.16, 0.42], [0.06, -0.31, 0.85], colour)
    .ball(0.16, [0, 0, 1.53], '#e3b48f')
    .ball(0.175, [-0.01, 0, 1.6], '#f2d03b') // helmet
    .box([0.14, 0.26, 0.03], [0.16, 0, 1.6], '#f2d03b') // its peak: where the person looks
    .done();
}

export function robotFigure(length: number, width: number, colour: string, plain: boolean): BufferGeometry {
  if (plain) {
    return new Builder()
      .box([length * 0.94, width * 0.84, 0.28], [0, 0, 0.02], colour)
      .box([0.07 * length, width * 0.62, 0.12], [0.47 * length, 0, 0.13], '#f4f7f9')
      .done();
  }
  const wheel = '#20262c';
  const builder = new Builder();
  for (const x of [-0.3, 0.3]) {
    for (const y of [-0.44, 0.44]) builder.box([0.24 * length, 0.08, 0.16], [x * length, y * width, 0], wheel);
  }
  return builder
    .box([length * 0.94, width * 0.84, 0.2], [0, 0, 0.09], colour)
    .box([length * 0.7, width * 0.6, 0.05], [-0.06 * length, 0, 0.29], '#2c343c') // lifting plate
    .box([0.07 * length, width * 0.62, 0.12], [0.47 * length, 0, 0.13], '#f4f7f9') // lamp in front
    .pillar([0.09, 0.09], 0.12, [0.36 * length, 0, 0.29], '#2c343c')
    .done();
}

/** A frame on four posts, under which a robot fits. */
export function carrierFigure(length: number, width: number, colour: string, plain: boolean): BufferGeometry {
  const builder = new Builder();
  const [x, y] = [length / 2, width / 2];
  for (const sx of [-1, 1]) for (const sy of [-1, 1]) builder.box([0.06, 0.06, 1.0], [sx * x, sy * y, 0], colour);
  builder.box([length, width, 0.06], [0, 0, 0.42], colour);
  for (const side of plain ? [] : [-1, 1]) {
    builder.box([length, 0.05, 0.05], [0, side * y, 0.95], colour);
    builder.box([0.05, width, 0.05], [side * x, 0, 0.95], colour);
  }
  return builder.done();
}

export const CARRIER_DECK_M = 0.48;

export function itemFigure(): BufferGeometry {
  const size = ITEM_M * 0.88;
  return new Builder().box([size, size, size * 0.8], [0, 0, 0], '#ffffff').done(); // times its material's colour
}
