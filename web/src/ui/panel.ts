// The side panel.

import type { Run } from '../run/run';
import { shown } from '../run/names';
import { comparison } from './compare_panel';
import { decisionDetails, heading, machineDetails, taskDetails, type DetailEvents } from './details';
import { button, el } from './dom';
import type { Picked } from './gantt';
import { agentsNow, legend, runFacts } from './now';
import type { Theme } from './theme';

export type Selection =
  | { kind: 'none' }
  | { kind: 'worker'; side: number; worker: string }
  | { kind: 'task'; side: number; worker: string; n: number }
  | { kind: 'decision'; side: number; n: number }
  | { kind: 'machine'; side: number; machine: string; at: number };

export interface PanelEvents {
  seek: (time: number) => void;
  pick: (side: number, what: Picked) => void;
  follow: (side: number, worker: string) => void;
  close: () => void;
}

export class SidePanel {
  readonly element = el('aside', { class: 'panel', label: 'details' });
  private drawn = '';
  private staleness = 0;
  private nowBox: HTMLElement | undefined;

  constructor(private readonly events: PanelEvents) {}

  /** What is shown must be made again. */
  stale(): void {
    this.staleness += 1;
  }

  draw(runs: Run[], selection: Selection, time: number, theme: Theme): void {
    const key = `${this.staleness} ${JSON.stringify(selection)} ${runs.length}`;
    const tick = Math.floor(time);
    if (key !== this.drawn) {
      const scrolled = this.element.scrollTop;
      const same = this.drawn.slice(this.drawn.indexOf(' ')) === key.slice(key.indexOf(' '));
      this.drawn = key;
      this.nowBox = undefined;
      this.element.replaceChildren(...this.content(runs, selection, theme));
      this.element.scrollTop = same ? scrolled : 0;
      this.element.dataset.tick = '';
    }
    if (this.nowBox && this.element.dataset.tick !== String(tick)) {
      this.element.dataset.tick = String(tick);
      const boxes = runs.map((run, side) =>
        agentsNow(run, Math.min(tick, run.last), theme, (worker) => this.events.pick(side, { kind: 'worker', worker })),
      );
      this.nowBox.replaceChildren(...(boxes.length === 1 ? boxes : []));
    }
  }

  private content(runs: Run[], selection: Selection, theme: Theme): HTMLElement[] {
    if (runs.length === 0) return [];
    if (selection.kind === 'none') return this.overview(runs, theme);
    const run = runs[selection.side];
    if (!run) return [];
    const back = button('✕', 'Close (escape)', this.events.close, 'close');
    return [back, this.details(run, selection, theme)];
  }

  private overview(runs: Run[], theme: Theme): HTMLElement[] {
    const [a, b] = runs;
    if (a && b) {
      const events = {
        seek: this.events.seek,
        showDecision: (side: 0 | 1, decision: Run['decisions'][number]) =>
          this.events.pick(side, { kind: 'decision', decision }),
      };
      return [comparison(a, b, theme, events), legend(a, theme)];
    }
    this.nowBox = el('div');
    return [runFacts(a!), el('h4', {}, 'Now'), this.nowBox, legend(a!, theme)];
  }

  private details(run: Run, selection: Exclude<Selection, { kind: 'none' }>, theme: Theme): HTMLElement {
    const { side } = selection;
    const events: DetailEvents = {
      seek: this.events.seek,
      follow: (worker) => this.events.follow(side, worker),
      showDecision: (decision) => this.events.pick(side, { kind: 'decision', decision }),
      showTask: (worker, n) => this.events.pick(side, { kind: 'task', worker, n }),
    };
    if (selection.kind === 'task') return taskDetails(run, selection.worker, selection.n, theme, events);
    if (selection.kind === 'decision') {
      const decision = run.tasks.get(selection.n)?.decision;
      return decision ? decisionDetails(run, decision, theme, events) : el('p');
    }
    if (selection.kind === 'machine') {
      return machineDetails(run, selection.machine, run.machines.at(selection.machine, selection.at), theme, events);
    }
    return workerDetails(run, selection.worker, theme, events);
  }
}

function workerDetails(run: Run, worker: string, theme: Theme, events: DetailEvents): HTMLElement {
  const bindings = run.diaries.get(worker)?.bindings ?? [];
  const tasks = bindings.map(({ n, since, until }) =>
    el(
      'li',
      { class: 'step' },
      button(
        `${since}–${Number.isFinite(until) ? until : '…'}`,
        `Go to tick ${since}`,
        () => events.seek(since),
        'tick',
      ),
      button(shown(run.tasks.get(n)?.decision.task ?? ''), 'Show this task', () => events.showTask(worker, n), 'link'),
    ),
  );
  return el(
    'div',
    { class: 'details', data: { kind: 'worker' } },
    heading(theme.wait, worker, shown(run.kindOf(worker))),
    el(
      'div',
      { class: 'buttons' },
      button('Follow', `Follow ${worker} through the hall`, () => events.follow(worker)),
    ),
    el('h4', {}, 'Its tasks'),
    el('ol', { class: 'steps' }, ...tasks),
  );
}
