// The machines: a body where each stands, a band around it in the colour of its state, and for those that move
// between positions a gantry whose head follows the material.

import {
  BoxGeometry,
  Color,
  Group,
  Matrix4,
  Mesh,
  Quaternion,
  Vector3,
  type BufferGeometry,
  type InstancedMesh,
} from 'three';
import type { MachineInterval } from '../run/machines';
import type { Run } from '../run/run';
import type { Theme } from '../ui/theme';
import { boxOf } from './geometry';
import { Builder } from './build';
import { BEAM_M, type Heads } from './heads';
import type { Layout } from './layout';
import { isBelt, type MachineSpot } from './machine_places';
import { copies, paint, white } from './paint';

const STILL = new Quaternion();

export class Plant {
  readonly group = new Group();
  private readonly bands: InstancedMesh;
  private readonly heads: InstancedMesh;
  private readonly gantries: MachineSpot[];
  private readonly matrix = new Matrix4();
  private readonly colour = new Color();

  constructor(
    private readonly run: Run,
    private readonly layout: Layout,
    private readonly theme: Theme,
    private readonly headsAt: Heads,
  ) {
    const body = new Builder();
    this.gantries = layout.machines.filter((machine) => machine.overhead);
    for (const machine of layout.machines) {
      if (machine.overhead) addGantry(machine, theme, body);
      else addBody(machine, theme, body);
    }
    if (!body.empty) this.group.add(new Mesh(body.done(), paint()));
    this.bands = this.instanced(white(new BoxGeometry(1, 1, 1)), layout.machines.length);
    const head = new Builder()
      .box([0.7, 0.7, 0.5], [0, 0, BEAM_M - 0.5], '#ffffff')
      .pillar([0.08, 0.08], 1.2, [0, 0, BEAM_M - 1.7], '#ffffff')
      .box([0.5, 0.5, 0.08], [0, 0, BEAM_M - 1.75], '#ffffff');
    this.heads = this.instanced(head.done(), Math.max(1, this.gantries.length));
    this.heads.count = this.gantries.length;
  }

  draw(time: number): void {
    this.layout.machines.forEach((machine, i) => {
      const box = boxOf(machine.area);
      const [cx, cy] = [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2];
      const top = machine.overhead ? BEAM_M + 0.12 : machine.ground + machine.height;
      const thin = machine.overhead;
      const [length, width] = thin ? beamSize(machine) : [box.x1 - box.x0 + 0.08, box.y1 - box.y0 + 0.08];
      const at = new Vector3(cx, top - 0.1, -cy);
      this.bands.setMatrixAt(i, this.matrix.compose(at, STILL, new Vector3(length, 0.16, width)));
      this.bands.setColorAt(i, this.colour.set(this.stateColour(this.run.machines.at(machine.name, time))));
    });
    this.gantries.forEach((machine, i) => {
      const [x, y] = this.headsAt.at(machine, time);
      this.heads.setMatrixAt(i, this.matrix.compose(new Vector3(x, 0, -y), STILL, new Vector3(1, 1, 1)));
      this.heads.setColorAt(i, this.colour.set(this.stateColour(this.run.machines.at(machine.name, time))));
    });
    for (const mesh of [this.bands, this.heads]) {
      mesh.instanceMatrix.needsUpdate = true;
      if (mesh.instanceColor) mesh.instanceColor.needsUpdate = true;
    }
  }

  dispose(): void {
    this.bands.dispose();
    this.heads.dispose();
  }

  private stateColour(interval: MachineInterval | undefined): string {
    return interval ? this.theme[interval.state] : this.theme.machine;
  }

  private instanced(geometry: BufferGeometry, count: number): InstancedMesh {
    const mesh = copies(geometry, paint(), count);
    this.group.add(mesh);
    return mesh;
  }
}

function addBody(machine: MachineSpot, theme: Theme, body: Builder): void {
  const { area, ground, height } = machine;
  body.prism(area, ground, height, theme.machine);
  const box = boxOf(area);
  const [length, width] = [box.x1 - box.x0, box.y1 - box.y0];
  if (!isBelt(length, width)) return;
  // Long and narrow: a belt, with rollers across.
  const along = length > width;
  for (let at = 0.5; at < Math.max(length, width) - 0.2; at += 0.6) {
    const spot: [number, number, number] = along
      ? [box.x0 + at, (box.y0 + box.y1) / 2, ground + height]
      : [(box.x0 + box.x1) / 2, box.y0 + at, ground + height];
    body.box(along ? [0.2, width * 0.86, 0.04] : [length * 0.86, 0.2, 0.04], spot, theme.edge);
  }
}

function addGantry(machine: MachineSpot, theme: Theme, body: Builder): void {
  const box = boxOf(machine.area);
  for (const x of [box.x0, box.x1])
    for (const y of [box.y0, box.y1]) body.box([0.16, 0.16, BEAM_M], [x, y, 0], theme.edge);
  const [length, width] = beamSize(machine);
  body.box([length, width, 0.22], [(box.x0 + box.x1) / 2, (box.y0 + box.y1) / 2, BEAM_M - 0.14], theme.edge);
}

function beamSize(machine: MachineSpot): [number, number] {
  const box = boxOf(machine.area);
  const [length, width] = [box.x1 - box.x0, box.y1 - box.y0];
  return length >= width ? [length, 0.3] : [0.3, width];
}
