// The items: boxes in the colour of their material, where they lie and in the carriers that hold them.

import { Color, Group, Matrix4, Quaternion, Vector3, type InstancedMesh } from 'three';
import type { Run } from '../run/run';
import { pickFrom, type Theme } from '../ui/theme';
import type { Scene } from './crowd';
import { itemFigure } from './figures';
import type { Heads } from './heads';
import type { Layout } from './layout';
import { ITEM_M } from './material_places';
import { copies, paint } from './paint';
import { Piles, type Pile } from './piles';

const MOST_SHOWN = 36; // of one place; the label says how many there are
const UP = new Vector3(0, 1, 0);

export class Goods {
  readonly group = new Group();
  private readonly piles: Piles;
  private mesh: InstancedMesh | undefined;
  private readonly colours = new Map<string, string>(); // by material
  private next = 0;
  private readonly matrix = new Matrix4();
  private readonly turn = new Quaternion();
  private readonly at = new Vector3();
  private readonly size = new Vector3();
  private readonly colour = new Color();

  constructor(run: Run, layout: Layout, theme: Theme, heads: Heads) {
    this.piles = new Piles(run, layout, heads);
    [...run.materials].forEach((material, i) => this.colours.set(material, pickFrom(theme.materials, i)));
  }

  draw(time: number, scene: Scene): void {
    const piles = this.piles.at(time, scene);
    this.reserve(piles.reduce((sum, pile) => sum + Math.min(pile.count, MOST_SHOWN), 0));
    this.next = 0;
    for (const pile of piles) this.pile(pile);
    if (!this.mesh) return;
    this.mesh.count = this.next;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }

  colourOf(material: string): string {
    return this.colours.get(material) ?? '#888888';
  }

  dispose(): void {
    this.mesh?.dispose();
  }

  private pile(pile: Pile): void {
    const { at, columns, scale } = pile;
    const step = ITEM_M * scale;
    const count = Math.min(pile.count, MOST_SHOWN);
    const rows = Math.min(columns, Math.ceil(count / columns));
    const wide = Math.min(columns, count);
    this.colour.set(this.colourOf(pile.of));
    this.turn.setFromAxisAngle(UP, at.yaw);
    this.size.setScalar(scale);
    for (let i = 0; i < count; ++i) {
      const along = ((i % columns) - (wide - 1) / 2) * step;
      const across = ((Math.floor(i / columns) % columns) - (rows - 1) / 2) * step;
      const layer = Math.floor(i / (columns * columns));
      const x = at.x + Math.cos(at.yaw) * along - Math.sin(at.yaw) * across;
      const y = at.y + Math.sin(at.yaw) * along + Math.cos(at.yaw) * across;
      this.at.set(x, pile.ground + layer * step * 0.8, -y);
      this.mesh!.setMatrixAt(this.next, this.matrix.compose(this.at, this.turn, this.size));
      this.mesh!.setColorAt(this.next, this.colour);
      this.next += 1;
    }
  }

  private reserve(count: number): void {
    if (this.mesh && this.mesh.instanceMatrix.count >= count) return;
    if (this.mesh) {
      this.group.remove(this.mesh);
      this.mesh.dispose();
    }
    this.mesh = copies(itemFigure(), paint(), Math.max(64, count * 2));
    this.group.add(this.mesh);
  }
}
