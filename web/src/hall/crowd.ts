// People, robots and carriers: one instanced mesh per kind, so that a hundred of them are a few draw calls.

import {
  Color,
  Group,
  InstancedMesh,
  Matrix4,
  Quaternion,
  RingGeometry,
  Vector3,
  type BufferGeometry,
  type MeshBasicMaterial,
} from 'three';
import type { Header, Pose } from '../log/header';
import type { Run } from '../run/run';
import { kindIndex, pickFrom, type Theme } from '../ui/theme';
import { discGeometry } from './build';
import { carrierFigure, personFigure, robotFigure } from './figures';
import { copies, paint, white } from './paint';
import { spread, type Standing } from './spread';

const UP = new Vector3(0, 1, 0);
const MANY = 40; // of more workers the figures are plain
const LIFT_M = 0.12; // how far a robot lifts a carrier

/** Where everybody is drawn at one time. */
export interface Scene {
  agents: Map<string, Pose>;
  carriers: Map<string, { pose: Pose; held: boolean }>;
}

export function arrange(run: Run, time: number, scale: number): Scene {
  const standing: Standing[] = run.header.workers.map(({ id, kind }) => {
    const spot = run.motions.get(id)!.at(time);
    return { id, pose: spot.pose, moving: spot.moving, since: spot.since, ...roomOf(run.header, kind, scale) };
  });
  const agents = spread(standing, time);
  const carriers: Scene['carriers'] = new Map();
  const put: Standing[] = [];
  for (const { id } of run.header.carriers) {
    const { pose, worker } = run.carrierPose(id, time);
    if (worker) carriers.set(id, { pose: agents.get(worker) ?? pose, held: true });
    else put.push({ id, pose, moving: false, since: 0, width: 1.1 * scale, length: 1.5 * scale });
  }
  for (const [id, pose] of spread(put, time)) carriers.set(id, { pose, held: false });
  return { agents, carriers };
}

function roomOf(header: Header, kind: string, scale: number): { width: number; length: number } {
  const size = header.kinds.get(kind) ?? (kind === 'human' ? { length: 0.6, width: 0.6 } : { length: 1.2, width: 0.8 });
  return { width: size.width * scale + 0.25, length: size.length * scale + 0.25 };
}

export class Crowd {
  readonly group = new Group();
  private readonly plain: boolean;
  private readonly figures = new Map<string, { mesh: InstancedMesh; ids: string[] }>(); // by kind
  private readonly shadows: InstancedMesh;
  private readonly rings: InstancedMesh;
  private readonly matrix = new Matrix4();
  private readonly at = new Vector3();
  private readonly turn = new Quaternion();
  private readonly size = new Vector3();
  private readonly colour = new Color();

  constructor(
    private readonly header: Header,
    theme: Theme,
    private readonly scale: number,
  ) {
    this.plain = header.workers.length > MANY;
    const kinds = [...new Set(header.workers.map((worker) => worker.kind))];
    for (const kind of kinds) {
      const ids = header.workers.filter((worker) => worker.kind === kind).map((worker) => worker.id);
      this.addKind(kind, ids, this.figure(kind, pickFrom(theme.kinds, kindIndex(kind, kinds))));
    }
    for (const kind of new Set(header.carriers.map((carrier) => carrier.kind))) {
      const ids = header.carriers.filter((carrier) => carrier.kind === kind).map((carrier) => carrier.id);
      this.addKind(kind, ids, carrierFigure(1.15, 0.8, theme.carrier, this.plain));
    }
    const all = header.workers.length + header.carriers.length;
    this.shadows = this.instanced(discGeometry(0.75, this.plain ? 8 : 16), paint({ seeThrough: true }), all);
    this.shadows.renderOrder = -1;
    const ring = new RingGeometry(0.56, 0.74, this.plain ? 14 : 28).rotateX(-Math.PI / 2);
    this.rings = this.instanced(white(ring), paint({ opacity: 0.85 }), header.workers.length);
    this.rings.renderOrder = 0;
  }

  /** `ring` is the colour of the task of a worker; none: no ring. */
  draw(scene: Scene, ring: (worker: string) => string | undefined): void {
    for (const { mesh, ids } of this.figures.values()) {
      ids.forEach((id, i) => {
        const agent = scene.agents.get(id);
        if (agent) this.put(mesh, i, agent, 0, this.scale);
        else {
          const { pose, held } = scene.carriers.get(id)!;
          this.put(mesh, i, pose, held ? LIFT_M * this.scale : 0, this.scale);
        }
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
    let i = 0;
    for (const pose of scene.agents.values()) this.put(this.shadows, i++, pose, 0.035, this.scale);
    for (const { pose } of scene.carriers.values()) this.put(this.shadows, i++, pose, 0.036, this.scale);
    this.shadows.instanceMatrix.needsUpdate = true;
    this.drawRings(scene, ring);
  }

  dispose(): void {
    for (const child of this.group.children) if (child instanceof InstancedMesh) child.dispose();
  }

  private drawRings(scene: Scene, ring: (worker: string) => string | undefined): void {
    this.header.workers.forEach(({ id }, i) => {
      const colour = ring(id);
      this.put(this.rings, i, scene.agents.get(id)!, 0.05, colour ? this.scale : 0);
      this.rings.setColorAt(i, this.colour.set(colour ?? '#000000'));
    });
    this.rings.instanceMatrix.needsUpdate = true;
    if (this.rings.instanceColor) this.rings.instanceColor.needsUpdate = true;
  }

  private figure(kind: string, colour: string): BufferGeometry {
    if (kind === 'human') return personFigure(colour, this.plain);
    const size = this.header.kinds.get(kind);
    return robotFigure(size?.length ?? 1.2, size?.width ?? 0.8, colour, this.plain);
  }

  private addKind(kind: string, ids: string[], figure: BufferGeometry): void {
    const mesh = this.instanced(figure, paint(), ids.length);
    this.figures.set(kind, { mesh, ids });
  }

  private instanced(geometry: BufferGeometry, material: MeshBasicMaterial, count: number): InstancedMesh {
    const mesh = copies(geometry, material, count);
    this.group.add(mesh);
    return mesh;
  }

  private put(mesh: InstancedMesh, index: number, pose: Pose, height: number, scale: number): void {
    this.at.set(pose.x, height, -pose.y);
    this.turn.setFromAxisAngle(UP, pose.yaw);
    this.size.setScalar(scale);
    mesh.setMatrixAt(index, this.matrix.compose(this.at, this.turn, this.size));
  }
}
