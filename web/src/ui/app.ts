// The page: which logs are shown, at which time, and what is selected.

import type { DecisionEvent } from '../log/events';
import { Clock } from './clock';
import { appState, type AppState } from './state';
import { Bar } from './bar';
import type { Picked } from './gantt';
import { commandsOf } from './commands';
import { acceptDrops, preferredTheme, whenThemeChanges } from './environment';
import { helpDialog, listen } from './keys';
import { Fineness, FrameMeter } from './meter';
import { Messages } from './messages';
import type { Pane } from './pane';
import { Panes } from './panes';
import { SidePanel, type Selection } from './panel';
import { Shelf } from './shelf';
import { fileSource, type Source } from './sources';
import { THEMES, type Theme, type ThemeName } from './theme';
import { Transport } from './transport';

export class App {
  readonly clock = new Clock();
  readonly shelf = new Shelf();
  readonly meter = new FrameMeter();
  private readonly fineness = new Fineness();
  readonly shownRuns: Panes;
  selection: Selection = { kind: 'none' };
  private theme: Theme;
  wished = false; // a frame is due
  shownAfterMs = NaN; // from opening the page until the first run was drawn
  private lastFrame = 0;
  private readonly bar: Bar;
  private readonly messages = new Messages();
  private readonly panel: SidePanel;
  private readonly transport: Transport;
  private readonly help: HTMLDialogElement;

  constructor(private readonly root: HTMLElement) {
    this.theme = THEMES[preferredTheme()];
    document.documentElement.dataset.theme = this.theme.name;
    this.shownRuns = new Panes(this.theme, {
      seek: (time) => this.seek(time),
      pick: (pane, what, time) => this.pick(pane, what, time),
      redraw: () => this.redraw(),
    });
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
      redraw: () => this.redraw(),
      jump: (what, direction) => this.jump(what, direction),
      follow: () => this.followEnd(),
      zoom: (factor) => this.zoom(factor),
    });
    const commands = commandsOf(this);
    this.help = helpDialog(commands);
    listen(commands);
    this.root.append(
      this.bar.element,
      this.messages.element,
      this.shownRuns.halls,
      this.panel.element,
      this.transport.element,
      this.shownRuns.charts,
      this.help,
    );
    new ResizeObserver(() => this.resize()).observe(this.shownRuns.halls);
    acceptDrops((files) => this.open(files));
    whenThemeChanges((theme) => this.setTheme(theme));
  }

  /** Reads logs and shows them; resolves when all that end by themselves have been read. */
  add(sources: Source[]): Promise<void> {
    return this.shelf.add(sources, () => this.update());
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

  get panes(): Pane[] {
    return this.shownRuns.all;
  }

  seek(time: number): void {
    this.clock.seek(time);
    this.redraw();
  }

  toggle(): void {
    if (this.clock.following) this.clock.following = false;
    else if (this.clock.playing) this.clock.pause();
    else this.clock.play();
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
    this.seek(this.clock.last);
    if (this.live) this.clock.follow();
    this.redraw();
  }

  zoom(factor: number): void {
    this.shownRuns.zoom(factor, this.clock.time);
    this.redraw();
  }

  camera(mode: 'overview' | 'top' | 'follow'): void {
    if (mode === 'follow') {
      const { selection } = this;
      const worker = 'worker' in selection ? selection.worker : this.panes[0]?.run.header.workers[0]?.id;
      if (worker !== undefined) this.follow('side' in selection ? selection.side : 0, worker);
      return;
    }
    this.shownRuns.lookFrom(mode);
    this.redraw();
  }

  follow(side: number, worker: string): void {
    this.shownRuns.follow(worker, this.clock.time);
    const pane = this.panes[side];
    if (pane && !('worker' in this.selection)) this.selectWorker(pane, side, worker);
    this.redraw();
  }

  cycleLabels(): void {
    this.shownRuns.cycleLabels();
    this.redraw();
  }

  toggleRoutes(): void {
    this.shownRuns.toggleRoutes();
    this.redraw();
  }

  toggleTheme(): void {
    this.setTheme(this.theme.name === 'light' ? 'dark' : 'light');
  }

  private setTheme(name: ThemeName): void {
    this.theme = THEMES[name];
    document.documentElement.dataset.theme = this.theme.name;
    this.shownRuns.setTheme(this.theme);
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
    this.shownRuns.select(selection);
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

  /** A run that is shown still goes on. */
  private get live(): boolean {
    return this.shownRuns.runs.some((run) => this.shelf.isLive(run));
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
    this.shelf.chosen[side] = index;
    this.update();
  }

  /** Something was read or chosen. */
  private update(): void {
    const ready = this.shelf.ready();
    if (!this.shownRuns.has(ready)) this.rebuild(ready);
    this.clock.grow(Math.max(0, ...this.panes.map((pane) => pane.run.last)));
    this.shownRuns.grow(this.clock.last);
    this.bar.draw(this.shelf.logs, this.shelf.chosen);
    this.messages.draw(this.shelf.logs);
    if (this.shelf.hopeless) this.invite('Choose other files, or drop them anywhere on this page.');
    this.refresh();
  }

  private rebuild(runs: Pane['run'][]): void {
    this.selection = { kind: 'none' };
    this.shownRuns.show(runs);
    this.root.classList.toggle('two', runs.length > 1);
    this.root.classList.toggle('empty', runs.length === 0);
    this.shownRuns.mount();
    this.clock.tickSeconds = Math.max(0.001, runs[0]?.header.tickSeconds ?? 1);
    this.clock.grow(Math.max(0, ...runs.map((run) => run.last)));
    if (this.live) this.clock.follow();
    this.clock.time = Math.min(this.clock.time, this.clock.last);
  }

  /** Everything may look different. */
  private refresh(): void {
    this.panel.stale();
    this.redraw();
  }

  private resize(): void {
    this.shownRuns.resize();
    this.redraw();
  }

  private frame(now: number): void {
    this.wished = false;
    const begun = performance.now();
    const { clock } = this;
    const passed = this.lastFrame > 0 ? now - this.lastFrame : 0;
    if (clock.moving && passed > 0) {
      clock.advance(Math.min(250, passed));
      this.fineness.took(passed);
    }
    const { moving } = clock;
    this.lastFrame = moving ? now : 0;
    const scale = moving ? this.fineness.scale : 1;
    this.shownRuns.draw(clock.time, scale);
    if (!moving && !this.live) clock.following = false; // the run has ended, and all of it was shown
    this.transport.draw(this.live);
    this.panel.draw(this.shownRuns.runs, this.selection, clock.time, this.theme);
    if (this.panes.length > 0 && Number.isNaN(this.shownAfterMs)) this.shownAfterMs = performance.now();
    this.meter.count(now, performance.now() - begun, moving);
    if (moving) this.redraw();
  }
}
