// The hall of one run on a canvas. Draws when asked to, never by itself.

import {
  Color,
  Group,
  LineSegments,
  Mesh,
  RingGeometry,
  Scene as Stage,
  Vector3,
  WebGLRenderer,
  type MeshBasicMaterial,
  type Object3D,
} from 'three';
import type { Pose } from '../log/header';
import type { Run } from '../run/run';
import { TaskColours } from '../run/names';
import { pickFrom, type Theme } from '../ui/theme';
import { HallCamera } from './camera';
import { arrange, Crowd, type Scene } from './crowd';
import { buildFloor, buildRoutes, buildZones } from './floor';
import { Goods } from './goods';
import { hallLabels } from './hall_labels';
import { Heads } from './heads';
import { Labels } from './labels';
import { layOut, type Layout } from './layout';
import { paint, white } from './paint';
import { Paths, type Way } from './paths';
import { Plant } from './plant';

export type LabelDetail = 'all' | 'agents' | 'none';

export class HallView {
  readonly eye: HallCamera;
  readonly layout: Layout;
  labels: LabelDetail = 'all';
  routes = false;
  selected: string | undefined; // an agent or a machine
  private readonly renderer: WebGLRenderer;
  private readonly flat: HTMLCanvasElement;
  private readonly writing: Labels;
  private readonly stage = new Stage();
  private readonly paths = new Paths();
  private readonly ring: Mesh;
  private readonly colours: TaskColours;
  private theme: Theme;
  private scale = 1;
  private built: { crowd: Crowd; goods: Goods; plant: Plant; zones: Map<string, Mesh>; all: Group } | undefined;
  private routesOf = -1;
  private routeLines: Object3D | undefined;
  private drawn: Scene | undefined;

  /** Throws where the browser has no WebGL. */
  constructor(
    private readonly host: HTMLElement,
    private readonly run: Run,
    theme: Theme,
    changed: () => void,
  ) {
    this.theme = theme;
    this.renderer = new WebGLRenderer({ antialias: true, powerPreference: 'high-performance' });
    this.renderer.debug.checkShaderErrors = false; // asking for them stops the page for a tenth of a second
    this.flat = document.createElement('canvas');
    this.flat.className = 'labels';
    this.renderer.domElement.className = 'stage';
    host.append(this.renderer.domElement, this.flat);
    this.writing = new Labels(this.flat);
    this.renderer.domElement.addEventListener('webglcontextrestored', changed);
    this.layout = layOut(run.header, run.seenAt);
    this.colours = new TaskColours(run.header);
    this.eye = new HallCamera(this.renderer.domElement, this.layout.bounds, tallest(this.layout), changed);
    this.ring = new Mesh(
      white(new RingGeometry(0.8, 0.92, 32).rotateX(-Math.PI / 2)),
      paint({ colour: theme.ink }),
    );
    this.stage.add(this.paths.mesh, this.ring);
    this.build();
    this.resize();
    this.eye.show('overview');
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    (this.ring.material as MeshBasicMaterial).color.set(theme.ink);
    this.build();
    this.routesOf = -1;
  }

  resize(): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio) * this.scale);
    this.renderer.setSize(width, height, false);
    this.eye.resize(width, height);
  }

  draw(time: number, scale: number): void {
    const { built } = this;
    if (!built) return;
    this.setScale(scale);
    const scene = arrange(this.run, time, this.layout.agentScale);
    this.drawn = scene;
    const colour = (worker: string): string | undefined => this.taskColour(worker, time);
    built.crowd.draw(scene, colour);
    built.goods.draw(time, scene);
    built.plant.draw(time);
    for (const [name, mesh] of built.zones) mesh.visible = this.run.zones.get(name)?.at(time) === 1;
    this.paths.draw(this.ways(time, colour));
    this.drawRoutes();
    this.mark(scene);
    const followed = this.eye.followed === undefined ? undefined : scene.agents.get(this.eye.followed);
    if (followed) this.eye.track(followed);
    this.renderer.render(this.stage, this.eye.camera);
    this.write(scene, time, colour);
  }

  /** The agent or machine at a point of the screen. */
  pick(clientX: number, clientY: number): string | undefined {
    const frame = this.host.getBoundingClientRect();
    const point = new Vector3();
    let found: string | undefined;
    let best = 26; // pixels
    const consider = (name: string, x: number, y: number, up: number, bonus: number): void => {
      point.set(x, up, -y).project(this.eye.camera);
      if (point.z > 1) return;
      const far =
        Math.hypot(
          ((point.x + 1) / 2) * frame.width - (clientX - frame.left),
          ((1 - point.y) / 2) * frame.height - (clientY - frame.top),
        ) - bonus;
      if (far < best) [best, found] = [far, name];
    };
    for (const [id, pose] of this.drawn?.agents ?? []) {
      for (const up of [0.3, 1.6]) consider(id, pose.x, pose.y, up * this.layout.agentScale, 4);
    }
    for (const machine of this.layout.machines) {
      consider(
        machine.name,
        machine.centre[0],
        machine.centre[1],
        machine.overhead ? 3.4 : machine.ground + machine.height,
        0,
      );
    }
    return found;
  }

  /** Where an agent is drawn on the screen, for tests and for following. */
  agentPose(id: string): Pose | undefined {
    return this.drawn?.agents.get(id);
  }

  dispose(): void {
    this.tearDown();
    this.eye.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss(); // a browser has only so many
    this.renderer.domElement.remove();
    this.flat.remove();
  }

  private taskColour(worker: string, time: number): string | undefined {
    const task = taskAt(this.run, worker, time);
    return task === undefined ? undefined : pickFrom(this.theme.tasks, this.colours.of(task).colour);
  }

  private setScale(scale: number): void {
    if (scale === this.scale) return;
    this.scale = scale;
    this.renderer.setPixelRatio(Math.min(2, window.devicePixelRatio) * scale);
  }

  private build(): void {
    this.tearDown();
    const { run, layout, theme } = this;
    const crowd = new Crowd(run.header, theme, layout.agentScale);
    const heads = new Heads(run, layout);
    const goods = new Goods(run, layout, theme, heads);
    const plant = new Plant(run, layout, theme, heads);
    const zones = buildZones(run.header, theme);
    const all = new Group();
    all.add(buildFloor(layout, run.header, theme), crowd.group, goods.group, plant.group, ...zones.values());
    this.stage.add(all);
    this.stage.background = new Color(theme.background);
    this.built = { crowd, goods, plant, zones, all };
  }

  private tearDown(): void {
    const { built } = this;
    if (!built) return;
    this.stage.remove(built.all);
    built.all.traverse((part) => {
      if (!(part instanceof Mesh || part instanceof LineSegments)) return;
      part.geometry.dispose();
      for (const material of [part.material].flat()) material.dispose();
    });
    built.crowd.dispose();
    built.goods.dispose();
    built.plant.dispose();
    this.built = undefined;
  }

  private ways(time: number, colour: (worker: string) => string | undefined): Way[] {
    const ways: Way[] = [];
    for (const [id, motion] of this.run.motions) {
      const points = motion.ahead(time);
      if (points.length === 0) continue;
      const strong = id === this.selected;
      ways.push({
        points,
        colour: colour(id) ?? this.theme.station,
        width: (strong ? 0.34 : 0.16) * this.layout.agentScale,
      });
    }
    return ways;
  }

  private drawRoutes(): void {
    if (this.routes && this.routesOf !== this.run.version) {
      if (this.routeLines) this.stage.remove(this.routeLines);
      this.routeLines = buildRoutes(this.run, this.theme);
      this.routesOf = this.run.version;
      this.stage.add(this.routeLines);
    }
    if (this.routeLines) this.routeLines.visible = this.routes;
  }

  private mark(scene: Scene): void {
    const pose = this.selected === undefined ? undefined : scene.agents.get(this.selected);
    this.ring.visible = pose !== undefined;
    if (!pose) return;
    this.ring.position.set(pose.x, 0.07, -pose.y);
    this.ring.scale.setScalar(this.layout.agentScale);
  }

  private write(scene: Scene, time: number, taskColour: (worker: string) => string | undefined): void {
    const { clientWidth: width, clientHeight: height } = this.host;
    const { run, layout, theme, selected } = this;
    const detail = this.labels;
    const labels =
      detail === 'none'
        ? []
        : hallLabels({
            run,
            layout,
            scene,
            goods: this.built!.goods,
            theme,
            time,
            camera: this.eye.camera,
            width,
            height,
            selected,
            taskColour,
            detail,
          });
    this.writing.draw(labels, width, height, Math.min(2, window.devicePixelRatio), theme);
  }
}

function tallest(layout: Layout): number {
  return Math.max(1, ...layout.blocks.map((block) => (block.look === 'wall' ? 1 : block.height)));
}

/** The task that a worker has at a time. */
export function taskAt(run: Run, worker: string, time: number): string | undefined {
  const bindings = run.diaries.get(worker)?.bindings ?? [];
  for (let i = bindings.length - 1; i >= 0; --i) {
    const { since, until, n } = bindings[i]!;
    if (since <= time) return time < until ? run.tasks.get(n)?.decision.task : undefined;
  }
  return undefined;
}
