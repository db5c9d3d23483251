// The page: which logs are shown, at which time, and what is selected.

import type { DecisionEvent } from '../log/events';
import type { CameraMode } from '../hall/camera';
import type { LabelDetail } from '../hall/view';
import { Clock } from './clock';
import { appState, type AppState } from './state';
import { Bar } from './bar';
import { el } from './dom';
import type { Picked } from './gantt';
import { commandsOf } from './commands';
import { helpDialog, listen } from './keys';
import { Fineness, FrameMeter } from './meter';
import { Messages } from './messages';
import { Pane } from './pane';
import { SidePanel, type Selection } from './panel';
import { fileSource, newLog, read, type LoadedLog, type Source } from './sources';
import { THEMES, type Theme, type ThemeName } from './theme';
import { Transport } from './transport';

export class App {
  readonly clock = new Clock();
  readonly logs: LoadedLog[] = [];
  readonly meter = new FrameMeter();
  private readonly fineness = new Fineness();
  panes: Pane[] = [];
  selection: Selection = { kind: 'none' };
  labels: LabelDetail = 'all';
  routes = false;
  private shown: [number, number] = [0, -1]; // indices of the logs A and B; -1: none
  private theme: Theme;
  wished = false; // a frame is due
  shownAfterMs = NaN; // from opening the page until the first run was drawn
  private lastFrame = 0;
  private readonly bar: Bar;
  private readonly messages = new Messages();
  private readonly halls = el('div', { class: 'halls' });
  private readonly charts = el('div', { class: 'charts' });
  private readonly panel: SidePanel;
  private readonly transport: Transport;
  private readonly help: HTMLDialogElement;

  constructor(private readonly root: HTMLElement) {
    this.theme = THEMES[preferredTheme()];
    document.documentElement.dataset.theme = this.theme.name;
    this.bar = new Bar({
      choose: (side, index) => this.choose(side, index),
      camera: (mode) => this.camera(mode),
      labels: () => this.cycleLabels(),
      routes: () => this.toggleRoutes(),
      theme: () => this.toggleTheme(),
      help: () => this.toggleHelp(),
      open: (files) => this.open(files),
    });
    this.panel = new SidePanel({
      seek: (time) => this.seek(time),
      pick: (side, what) => this.pick(this.panes[side], what, undefined),
      follow: (side, worker) => this.follow(side, worker),
      close: () => this.select({ kind: 'none' }),
    });
    this.transport = new Transport(this.clock, {
      toggle: () => this.toggle(),
      seek: (time) => this.seek(time),
      speed: (speed) => this.setSpeed(speed),
      jump: (what, direction) => this.jump(what, direction),
      follow: () => this.followEnd(),
      zoom: (factor) => this.zoom(factor),
    });
    const commands = commandsOf(this);
    this.help = helpDialog(commands);
    listen(commands);
    this.root.append(this.bar.element, this.messages.element, this.halls, this.panel.element, this.transport.element, this.charts, this.help);
    new ResizeObserver(() => this.resize()).observe(this.halls);
    this.acceptDrops();
  }

  /** Reads logs and shows them; resolves when all that end by themselves have been read. */
  async add(sources: Source[]): Promise<void> {
    const fresh = sources.map((source) => ({ source, log: newLog(source) }));
    const first = this.logs.length;
    for (const { log } of fresh) this.logs.push(log);
    if (first > 0) this.shown = fresh.length > 1 ? [first, first + 1] : [0, first];
    else this.shown = [0, fresh.length > 1 ? 1 : -1];
    this.update();
    await Promise.all(fresh.map(({ source, log }) => read(source, log, () => this.update())));
  }

  open(files: Iterable<File>): void {
    void this.add([...files].map(fileSource));
  }

  /** There is no log to show yet. */
  invite(text: string): void {
    this.messages.invite(text, (files) => this.open(files));
  }

  fail(text: string): void {
    this.messages.fail(text);
  }

  state(): AppState {
    return appState(this);
  }

  get themeName(): ThemeName {
    return this.theme.name;
  }

  get cameraMode(): CameraMode | 'none' {
    return this.panes[0]?.hall?.eye.mode ?? 'none';
  }

  seek(time: number): void {
    this.clock.seek(time);
    this.redraw();
  }

  toggle(): void {
    if (this.clock.playing) this.clock.pause();
    else this.clock.play();
    this.redraw();
  }

  setSpeed(speed: number): void {
    this.clock.speed = speed;
    this.redraw();
  }

  jump(what: 'decision' | 'event', direction: 1 | -1): void {
    const { clock } = this;
    const candidates = this.panes.map(({ run }) => {
      const ticks = what === 'event' ? run.eventTicks : run.decisions.map((decision) => decision.t);
      return clock.neighbour(ticks, direction);
    });
    const moved = candidates.filter((t) => t !== clock.time);
    if (moved.length === 0) return;
    clock.pause();
    this.seek(direction > 0 ? Math.min(...moved) : Math.max(...moved));
    if (what === 'decision') this.selectDecisionNow();
  }

  followEnd(): void {
    const live = this.panes.some((pane) => this.logOf(pane)?.live);
    this.seek(this.clock.last);
    this.clock.following = live;
    this.redraw();
  }

  zoom(factor: number): void {
    this.panes[0]?.gantt.zoom(factor, this.clock.time);
    this.redraw();
  }

  camera(mode: 'overview' | 'top' | 'follow'): void {
    if (mode === 'follow') {
      const { selection } = this;
      const worker = 'worker' in selection ? selection.worker : this.panes[0]?.run.header.workers[0]?.id;
      if (worker !== undefined) this.follow('side' in selection ? selection.side : 0, worker);
      return;
    }
    for (const pane of this.panes) pane.hall?.eye.show(mode);
    this.redraw();
  }

  follow(side: number, worker: string): void {
    for (const pane of this.panes) {
      const motion = pane.run.motions.get(worker);
      if (motion) pane.hall?.eye.follow(worker, motion.at(this.clock.time).pose);
    }
    const pane = this.panes[side];
    if (pane && !('worker' in this.selection)) this.selectWorker(pane, side, worker);
    this.redraw();
  }

  cycleLabels(): void {
    this.labels = this.labels === 'all' ? 'agents' : this.labels === 'agents' ? 'none' : 'all';
    for (const pane of this.panes) pane.setLabels(this.labels);
    this.redraw();
  }

  toggleRoutes(): void {
    this.routes = !this.routes;
    for (const pane of this.panes) if (pane.hall) pane.hall.routes = this.routes;
    this.redraw();
  }

  toggleTheme(): void {
    this.theme = THEMES[this.theme.name === 'light' ? 'dark' : 'light'];
    document.documentElement.dataset.theme = this.theme.name;
    for (const pane of this.panes) pane.setTheme(this.theme);
    this.refresh();
  }

  toggleHelp(): void {
    if (this.help.open) this.help.close();
    else this.help.showModal();
  }

  escape(): void {
    if (this.help.open) this.help.close();
    else this.select({ kind: 'none' });
  }

  select(selection: Selection): void {
    this.selection = selection;
    const side = 'side' in selection ? selection.side : -1;
    this.panes.forEach((pane, index) => {
      const name = index !== side ? undefined : 'worker' in selection ? selection.worker : 'machine' in selection ? selection.machine : undefined;
      pane.select(name, index === side && 'n' in selection ? selection.n : 0);
    });
    this.refresh();
  }

  pick(pane: Pane | undefined, what: Picked, time: number | undefined): void {
    if (!pane) return;
    const side = this.panes.indexOf(pane);
    if (time !== undefined && what.kind !== 'worker' && what.kind !== 'decision') this.seek(time);
    if (what.kind === 'task') this.select({ kind: 'task', side, worker: what.worker, n: what.n });
    else if (what.kind === 'decision') this.showDecision(side, what.decision);
    else if (what.kind === 'worker') this.selectWorker(pane, side, what.worker);
    else if (what.kind === 'machine') {
      this.select({ kind: 'machine', side, machine: what.machine, at: Math.min(this.clock.time, pane.run.last) });
    }
  }

  showDecision(side: number, decision: DecisionEvent): void {
    this.clock.pause();
    this.seek(decision.t);
    this.select({ kind: 'decision', side, n: decision.n });
  }

  /** Draws as soon as the browser draws next. */
  redraw(): void {
    if (this.wished) return;
    this.wished = true;
    requestAnimationFrame((now) => this.frame(now));
  }

  logOf(pane: Pane): LoadedLog | undefined {
    return this.logs.find((log) => log.run === pane.run);
  }

  /** A worker in the hall: the task it has now, else the worker itself. */
  private selectWorker(pane: Pane, side: number, worker: string): void {
    const { time } = this.clock;
    const now = pane.run.diaries.get(worker)?.bindings.find(({ since, until }) => since <= time && time < until);
    this.select(now ? { kind: 'task', side, worker, n: now.n } : { kind: 'worker', side, worker });
  }

  private selectDecisionNow(): void {
    for (const [side, { run }] of this.panes.entries()) {
      const decision = run.decisions.find(({ t }) => t === this.clock.time);
      if (decision) return this.select({ kind: 'decision', side, n: decision.n });
    }
  }

  private choose(side: 0 | 1, index: number): void {
    this.shown[side] = index;
    this.update();
  }

  /** Something was read or chosen. */
  private update(): void {
    const wanted = [...new Set(this.shown)].flatMap((index) => this.logs[index]?.run ?? []);
    const ready = wanted.filter((run) => {
      const log = this.logs.find((candidate) => candidate.run === run)!;
      return log.live || !log.reading;
    });
    if (ready.length !== this.panes.length || ready.some((run, i) => this.panes[i]?.run !== run)) this.rebuild(ready);
    this.clock.grow(Math.max(0, ...this.panes.map((pane) => pane.run.last)));
    for (const pane of this.panes) {
      pane.gantt.setLength(this.clock.last);
      pane.changed();
    }
    this.bar.draw(this.logs, this.shown);
    this.messages.draw(this.logs);
    if (!this.logs.some((log) => log.run || log.reading)) this.invite('Choose other files, or drop them anywhere on this page.');
    this.refresh();
  }

  private rebuild(runs: Pane['run'][]): void {
    for (const pane of this.panes) pane.dispose();
    this.selection = { kind: 'none' };
    const two = runs.length > 1;
    this.root.classList.toggle('two', two);
    this.panes = runs.map((run, i) => {
      return new Pane(run, two ? (i === 0 ? 'A' : 'B') : '', this.theme, {
        seek: (time) => this.seek(time),
        pick: (pane, what, time) => this.pick(pane, what, time),
        zoomed: (pane) => this.zoomed(pane),
        redraw: () => this.redraw(),
      });
    });
    this.halls.append(...this.panes.map((pane) => pane.hallBox));
    this.charts.append(...this.panes.map((pane) => pane.gantt.element));
    this.root.classList.toggle('empty', runs.length === 0);
    for (const pane of this.panes) {
      pane.mount(this.theme);
      pane.setLabels(this.labels);
      if (pane.hall) pane.hall.routes = this.routes;
    }
    this.clock.tickSeconds = Math.max(0.001, runs[0]?.header.tickSeconds ?? 1);
    this.clock.grow(Math.max(0, ...runs.map((run) => run.last)));
    if (this.panes.some((pane) => this.logOf(pane)?.live)) this.clock.following = true;
    this.clock.time = Math.min(this.clock.time, this.clock.last);
  }

  private zoomed(source: Pane): void {
    const window = source.gantt.shown;
    const all = window[0] <= 0 && window[1] >= this.clock.last;
    for (const pane of this.panes) {
      pane.gantt.show(all ? undefined : window);
      pane.changed();
    }
    this.redraw();
  }

  /** Everything may look different. */
  private refresh(): void {
    this.panel.stale();
    this.redraw();
  }

  private resize(): void {
    for (const pane of this.panes) pane.resize();
    this.redraw();
  }

  private frame(now: number): void {
    this.wished = false;
    const { clock } = this;
    const passed = this.lastFrame > 0 ? now - this.lastFrame : 0;
    if (clock.playing && passed > 0) {
      clock.advance(Math.min(250, passed));
      this.fineness.took(passed);
    }
    const scale = clock.playing ? this.fineness.scale : 1;
    this.lastFrame = clock.playing ? now : 0;
    for (const pane of this.panes) pane.draw(clock.time, scale);
    this.transport.draw(this.panes.some((pane) => this.logOf(pane)?.live));
    this.panel.draw(this.panes.map((pane) => pane.run), this.selection, clock.time, this.theme);
    if (this.panes.length > 0 && Number.isNaN(this.shownAfterMs)) this.shownAfterMs = performance.now();
    this.meter.count(now, clock.playing);
    if (clock.playing) this.redraw();
  }

  private acceptDrops(): void {
    document.addEventListener('dragover', (event) => event.preventDefault());
    document.addEventListener('drop', (event) => {
      event.preventDefault();
      if (event.dataTransfer?.files.length) this.open(event.dataTransfer.files);
    });
  }
}

function preferredTheme(): ThemeName {
  return window.matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
}
