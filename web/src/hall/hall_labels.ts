// Which labels the hall has at one time.

import { Vector3, type Camera } from 'three';
import type { Run } from '../run/run';
import { shown } from '../run/names';
import type { Theme } from '../ui/theme';
import { boxOf, middle } from './geometry';
import type { Scene } from './crowd';
import type { Goods } from './goods';
import type { Label } from './labels';
import type { Layout } from './layout';

export interface LabelTask {
  run: Run;
  layout: Layout;
  scene: Scene;
  goods: Goods;
  theme: Theme;
  time: number;
  camera: Camera;
  width: number;
  height: number;
  selected: string | undefined;
  taskColour: (worker: string) => string | undefined;
  detail: 'all' | 'agents';
}

const MANY = 24; // of more agents only the selected one is named

export function hallLabels(task: LabelTask): Label[] {
  const labels: Label[] = [];
  const point = new Vector3();
  const put = (x: number, y: number, up: number, label: Omit<Label, 'x' | 'y'>): void => {
    point.set(x, up, -y).project(task.camera);
    if (point.z > 1 || Math.abs(point.x) > 1 || Math.abs(point.y) > 1) return;
    labels.push({ ...label, x: ((point.x + 1) / 2) * task.width, y: ((1 - point.y) / 2) * task.height });
  };
  agents(task, put);
  if (task.detail === 'agents') return labels;
  machines(task, put);
  counts(task, put);
  for (const block of task.layout.blocks) {
    if (block.look === 'wall' || block.machine) continue;
    const [x, y] = middle(boxOf(block.polygon));
    put(x, y, block.look === 'open' ? block.height + 0.3 : block.height, {
      text: shown(block.name),
      rank: 60,
      look: 'place',
    });
  }
  for (const station of task.layout.stations.values()) {
    put(station.centre[0], station.centre[1] - 0.9, 0, { text: shown(station.name), rank: 70, look: 'place' });
  }
  return labels;
}

type Put = (x: number, y: number, up: number, label: Omit<Label, 'x' | 'y'>) => void;

function agents({ run, scene, layout, selected, taskColour, theme }: LabelTask, put: Put): void {
  const many = run.header.workers.length > MANY;
  for (const [id, pose] of scene.agents) {
    if (many && id !== selected) continue;
    const up = (run.kindOf(id) === 'human' ? 2.2 : 1.35) * layout.agentScale;
    const strong = id === selected;
    put(pose.x, pose.y, up, {
      text: id,
      rank: strong ? 0 : 10,
      look: 'agent',
      colour: taskColour(id) ?? theme.wait,
      strong,
    });
  }
  for (const [id, { pose }] of scene.carriers) {
    if (many || !run.material.count(id, Infinity)) continue;
    put(pose.x, pose.y, 1.2 * layout.agentScale, { text: id, rank: 80, look: 'place' });
  }
}

function machines({ run, layout, time, theme, selected }: LabelTask, put: Put): void {
  for (const machine of layout.machines) {
    const interval = run.machines.at(machine.name, time);
    const strong = machine.name === selected;
    const rank = strong ? 1 : interval?.state === 'working' ? 20 : interval ? 40 : 50;
    const label: Omit<Label, 'x' | 'y'> = { text: shown(machine.name), rank, look: 'machine', strong };
    if (interval) {
      label.colour = theme[interval.state];
      if (interval.state === 'working') {
        label.share = Math.min(1, (time - interval.begin) / Math.max(1, interval.end - interval.begin));
        label.text = `${shown(machine.name)} ${Math.floor(label.share * 100)} %`;
      }
    }
    put(machine.centre[0], machine.centre[1], machine.overhead ? 3.6 : machine.ground + machine.height + 0.5, label);
  }
}

function counts({ run, layout, goods, time }: LabelTask, put: Put): void {
  for (const place of run.header.places) {
    const spot = layout.material.get(place.name);
    if (!spot || spot.atMachine || !run.materials.has(place.of)) continue;
    const count = run.material.count(place.name, time);
    const of = place.capacity === undefined ? '' : ` / ${place.capacity}`;
    const text = `${shown(place.of)} ${count}${of}`;
    put(spot.centre[0], spot.centre[1], spot.ground + 1.1, {
      text,
      rank: 30,
      look: 'count',
      colour: goods.colourOf(place.of),
    });
  }
}
