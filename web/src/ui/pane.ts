// One run on the page: its hall and its Gantt chart.

import { HallView } from '../hall/view';
import type { Run } from '../run/run';
import { el } from './dom';
import { Gantt, type GanttEvents, type Picked } from './gantt';
import type { Theme } from './theme';

export interface PaneEvents extends Pick<GanttEvents, 'seek'> {
  pick: (pane: Pane, what: Picked, time: number | undefined) => void;
  zoomed: (pane: Pane) => void;
  redraw: () => void;
}

export class Pane {
  readonly hallBox = el('section', { class: 'hall' });
  readonly gantt: Gantt;
  hall: HallView | undefined; // none: the browser has no WebGL
  private readonly title = el('div', { class: 'hall-title' });
  private press: { x: number; y: number } | undefined;
  private ganttDirty = true;

  constructor(
    readonly run: Run,
    readonly letter: '' | 'A' | 'B',
    theme: Theme,
    private readonly events: PaneEvents,
  ) {
    this.gantt = new Gantt(run, theme, {
      seek: events.seek,
      pick: (what, time) => events.pick(this, what, time),
      zoomed: () => events.zoomed(this),
    });
    const stage = el('div', { class: 'hall-stage' });
    this.hallBox.append(stage, this.title);
    this.hallBox.addEventListener('pointerdown', (event) => (this.press = { x: event.clientX, y: event.clientY }));
    this.hallBox.addEventListener('pointerup', (event) => this.lift(event));
  }

  /** Once the boxes are on the page and have a size. */
  mount(theme: Theme): void {
    const stage = this.hallBox.querySelector<HTMLElement>('.hall-stage')!;
    try {
      this.hall = new HallView(stage, this.run, theme, () => this.events.redraw());
    } catch {
      const text =
        'This browser cannot draw in 3D (it has no WebGL). The Gantt chart and all explanations work without it.';
      stage.append(el('p', { class: 'no-hall' }, text));
    }
  }

  setTheme(theme: Theme): void {
    this.hall?.setTheme(theme);
    this.gantt.setTheme(theme);
    this.ganttDirty = true;
  }

  /** `n` is a decision whose task is marked in the Gantt chart; 0: none. */
  select(name: string | undefined, n: number): void {
    if (this.hall) this.hall.selected = name;
    this.gantt.selectedName = name;
    this.gantt.selectedTask = n;
    this.ganttDirty = true;
  }

  changed(): void {
    this.ganttDirty = true;
  }

  resize(): void {
    this.hall?.resize();
    this.ganttDirty = true;
  }

  /** `scale`: how finely the hall is drawn, 1 for every pixel. */
  draw(time: number, scale: number): void {
    const at = Math.min(time, this.run.last);
    this.hall?.draw(at, scale);
    if (this.ganttDirty) this.gantt.draw();
    this.ganttDirty = false;
    this.gantt.movePlayhead(time);
    this.drawTitle(at);
  }

  dispose(): void {
    this.hall?.dispose();
    this.hallBox.remove();
    this.gantt.element.remove();
  }

  private drawTitle(time: number): void {
    const { run, letter } = this;
    const { order } = run.header;
    const done = order ? ` · ${run.finished(time)} of ${order.quantity} finished` : '';
    const ended = run.end && time >= run.last ? ` · ${ending(run)}` : '';
    const text = `${letter ? `${letter}: ` : ''}${run.name} · tick ${Math.floor(time)}${done}${ended}`;
    if (this.title.textContent !== text) this.title.textContent = text;
  }

  private lift(event: PointerEvent): void {
    const { press } = this;
    this.press = undefined;
    if (!press || Math.hypot(event.clientX - press.x, event.clientY - press.y) > 5) return;
    const name = this.hall?.pick(event.clientX, event.clientY);
    if (name === undefined) return;
    const what: Picked = this.run.motions.has(name)
      ? { kind: 'worker', worker: name }
      : { kind: 'machine', machine: name, interval: undefined };
    this.events.pick(this, what, undefined);
  }
}

export function ending(run: Run): string {
  if (!run.end) return 'cut off';
  const words: Record<string, string> = {
    finished: 'finished',
    deadlock: 'deadlock: nothing can go on',
    horizon: 'out of time',
  };
  return `${words[run.end.status] ?? run.end.status} at ${run.end.t}`;
}
