// The one or two runs that are shown, and how they are looked at.

import type { CameraMode } from '../hall/camera';
import type { LabelDetail } from '../hall/view';
import type { Run } from '../run/run';
import { el } from './dom';
import { Pane, type PaneEvents } from './pane';
import type { Selection } from './panel';
import type { Theme } from './theme';

export class Panes {
  readonly halls = el('div', { class: 'halls' });
  readonly charts = el('div', { class: 'charts' });
  all: Pane[] = [];
  labels: LabelDetail = 'all';
  routes = false;
  private length = 0; // ticks of the longest run
  private drawnAt = 0;

  constructor(
    private theme: Theme,
    private readonly events: Omit<PaneEvents, 'zoomed'>,
  ) {}

  get runs(): Run[] {
    return this.all.map((pane) => pane.run);
  }

  get camera(): CameraMode | 'none' {
    return this.all[0]?.hall?.eye.mode ?? 'none';
  }

  /** Whether these runs, in this order, are what is shown already. */
  has(runs: readonly Run[]): boolean {
    return runs.length === this.all.length && runs.every((run, i) => this.all[i]!.run === run);
  }

  show(runs: readonly Run[]): void {
    for (const pane of this.all) pane.dispose();
    const events = { ...this.events, zoomed: (pane: Pane) => this.alignTo(pane) };
    const letters = runs.length > 1 ? (['A', 'B'] as const) : ([''] as const);
    this.all = runs.map((run, i) => new Pane(run, letters[i]!, this.theme, events));
    this.halls.append(...this.all.map((pane) => pane.hallBox));
    this.charts.append(...this.all.map((pane) => pane.gantt.element));
  }

  /** Once the halls are on the page and have a size. */
  mount(): void {
    for (const pane of this.all) {
      pane.mount(this.theme);
      this.look(pane);
    }
  }

  /** The runs have grown to so many ticks. */
  grow(length: number): void {
    this.length = length;
    for (const pane of this.all) {
      pane.gantt.setLength(length);
      pane.changed();
    }
  }

  setTheme(theme: Theme): void {
    this.theme = theme;
    for (const pane of this.all) pane.setTheme(theme);
  }

  cycleLabels(): void {
    this.labels = this.labels === 'all' ? 'agents' : this.labels === 'agents' ? 'none' : 'all';
    this.all.forEach((pane) => this.look(pane));
  }

  toggleRoutes(): void {
    this.routes = !this.routes;
    this.all.forEach((pane) => this.look(pane));
  }

  zoom(factor: number, around: number): void {
    this.all[0]?.gantt.zoom(factor, around);
  }

  lookFrom(mode: 'overview' | 'top'): void {
    for (const pane of this.all) pane.hall?.eye.show(mode);
  }

  follow(worker: string, time: number): void {
    for (const pane of this.all) {
      const motion = pane.run.motions.get(worker);
      if (motion) pane.hall?.eye.follow(worker, motion.at(time).pose);
    }
  }

  select(selection: Selection): void {
    this.all.forEach((pane, side) => {
      if (!('side' in selection) || selection.side !== side) return pane.select(undefined, 0);
      let name: string | undefined;
      if ('worker' in selection) name = selection.worker;
      if ('machine' in selection) name = selection.machine;
      pane.select(name, 'n' in selection ? selection.n : 0);
    });
  }

  resize(): void {
    for (const pane of this.all) pane.resize();
  }

  draw(time: number, scale: number): void {
    if (time !== this.drawnAt) this.keepInView(time);
    this.drawnAt = time;
    for (const pane of this.all) pane.draw(time, scale);
  }

  /** A chart that is zoomed in turns the page when time leaves it. */
  private keepInView(time: number): void {
    const gantt = this.all[0]?.gantt;
    if (!gantt) return;
    const [from, to] = gantt.shown;
    if (time >= from && time <= to) return;
    const start = Math.max(0, Math.min(this.length - (to - from), time - (to - from) * 0.1));
    gantt.show([start, start + to - from]);
    this.alignTo(this.all[0]!);
  }

  private look(pane: Pane): void {
    if (!pane.hall) return;
    pane.hall.labels = this.labels;
    pane.hall.routes = this.routes;
  }

  /** All charts show the same part of time. */
  private alignTo(source: Pane): void {
    const [from, to] = source.gantt.shown;
    const whole = from <= 0 && to >= this.length;
    for (const pane of this.all) {
      pane.gantt.show(whole ? undefined : [from, to]);
      pane.changed();
    }
    this.events.redraw();
  }
}
