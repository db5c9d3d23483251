// What the side panel says about what was clicked: a task, a decision, a machine.

import type { DecisionEvent } from '../log/events';
import { crewOf, describeDecision, describeMachine, describeTask, type TaskAccount } from '../run/describe';
import type { MachineInterval } from '../run/machines';
import { shown, TaskColours } from '../run/names';
import type { Run } from '../run/run';
import { button, el, swatch } from './dom';
import { pickFrom, type Theme } from './theme';

export interface DetailEvents {
  seek: (time: number) => void;
  follow: (worker: string) => void;
  showDecision: (decision: DecisionEvent) => void;
  showTask: (worker: string, n: number) => void;
}

const KINDS = { work: 'work', walk: 'way', wait: 'wait', rest: 'rest' };

export function taskDetails(run: Run, worker: string, n: number, theme: Theme, events: DetailEvents): HTMLElement {
  const account = describeTask(run, worker, n);
  if (!account) return el('p', {}, 'Nothing is known about this task.');
  const decision = run.tasks.get(n)!.decision;
  const { sums, metres } = account;
  const until = account.until === undefined ? 'still running' : String(account.until);
  return el(
    'div',
    { class: 'details', data: { kind: 'task' } },
    heading(taskColour(run, decision.task, theme), account.title, `${worker} · ticks ${account.since}–${until}`),
    buttons(
      button('Follow', `Follow ${worker} through the hall`, () => events.follow(worker)),
      button('Why?', 'Show the decision for this task', () => events.showDecision(decision)),
    ),
    facts([
      ['crew', crewText(account.crew)],
      ['time', `${sums.work} working, ${sums.walk} on the way, ${sums.wait} waiting`],
      ['way', `${metres.toFixed(1)} m`],
    ]),
    el('h4', {}, 'Step by step'),
    steps(account, events),
  );
}

function steps(account: TaskAccount, events: DetailEvents): HTMLElement {
  const rows = account.steps.map(({ begin, end, kind, text }) =>
    el(
      'li',
      { class: `step ${kind}` },
      button(`${begin}–${end}`, `Go to tick ${begin}`, () => events.seek(begin), 'tick'),
      el('span', { class: 'kind' }, KINDS[kind]),
      el('span', {}, text),
    ),
  );
  return el('ol', { class: 'steps' }, ...rows);
}

export function decisionDetails(run: Run, decision: DecisionEvent, theme: Theme, events: DetailEvents): HTMLElement {
  const account = describeDecision(run, decision);
  const parts: (HTMLElement | undefined)[] = [
    heading(taskColour(run, decision.task, theme), account.title, `decision ${decision.n} · tick ${decision.t}`),
    facts([['crew', crewText(account.crew)]]),
    buttons(
      button('Go there', `Go to tick ${decision.t}`, () => events.seek(decision.t)),
      ...crewOf(run, decision.n)
        .flatMap(({ members }) => members)
        .filter((id) => run.motions.has(id))
        .map((id) => button(id, `What ${id} did in this task`, () => events.showTask(id, decision.n))),
    ),
  ];
  if (!account.explained) {
    parts.push(
      el(
        'p',
        { class: 'hint' },
        'This log gives no reasons. Write it with linewright simulate … --explain to see what else could have been chosen, and why not.',
      ),
    );
  }
  if (account.alternatives.length > 0) {
    parts.push(el('h4', {}, 'What could be chosen'));
    const rows = account.alternatives.map((a) =>
      el(
        'tr',
        { class: a.chosen ? 'chosen' : '' },
        el('td', {}, a.chosen ? '▶' : ''),
        el('td', {}, a.task),
        el('td', {}, `${a.text}${a.best ? ' (earliest)' : ''}`),
      ),
    );
    parts.push(el('table', { class: 'plain' }, el('tbody', {}, ...rows)));
    parts.push(
      el('p', { class: 'hint' }, 'The ticks say when the run would end if the rule “first” went on from there.'),
    );
    if (account.plannedEnd !== undefined)
      parts.push(el('p', {}, `The planner had a plan for all that follows: the run ends at ${account.plannedEnd}.`));
  }
  for (const { role, neededAt, rows } of account.candidates) {
    parts.push(el('h4', {}, `Who could be ${shown(role)}: ${neededAt}`));
    const lines = rows.map((row) =>
      el(
        'tr',
        { class: row.chosen ? 'chosen' : '' },
        el('td', {}, row.chosen ? '▶' : ''),
        el('td', {}, row.worker),
        el('td', {}, row.text),
      ),
    );
    parts.push(el('table', { class: 'plain' }, el('tbody', {}, ...lines)));
  }
  if (account.impossible.length > 0) {
    parts.push(el('h4', {}, 'What could not, and why'));
    const rows = account.impossible.map(({ task, reason }) =>
      el('tr', {}, el('td', {}), el('td', {}, task), el('td', {}, reason)),
    );
    parts.push(el('table', { class: 'plain' }, el('tbody', {}, ...rows)));
  }
  return el('div', { class: 'details', data: { kind: 'decision' } }, ...parts);
}

export function machineDetails(
  run: Run,
  machine: string,
  interval: MachineInterval | undefined,
  theme: Theme,
  events: DetailEvents,
): HTMLElement {
  const lines = interval ? describeMachine(run, machine, interval) : [`${shown(machine)} is free.`];
  const sums = { working: 0, held: 0, recovering: 0 };
  for (const { state, begin, end } of run.machines.intervals.get(machine) ?? [])
    sums[state] += Math.min(end, run.last) - begin;
  const share = (ticks: number): string => `${ticks} ticks (${Math.round((ticks / Math.max(1, run.last)) * 100)} %)`;
  return el(
    'div',
    { class: 'details', data: { kind: 'machine' } },
    heading(interval ? theme[interval.state] : theme.machine, shown(machine), 'machine'),
    ...lines.map((line) => el('p', {}, line)),
    interval
      ? buttons(button('Go there', `Go to tick ${interval.begin}`, () => events.seek(interval.begin)))
      : undefined,
    el('h4', {}, 'In the whole run'),
    facts([
      ['working', share(sums.working)],
      ['held', share(sums.held)],
      ['recovering', share(sums.recovering)],
    ]),
  );
}

export function heading(colour: string, title: string, under: string): HTMLElement {
  return el('header', { class: 'detail-head' }, swatch(colour), el('div', {}, el('h3', {}, title), el('p', {}, under)));
}

export function facts(rows: [string, string][]): HTMLElement {
  const list = el('dl', { class: 'facts' });
  for (const [name, value] of rows) list.append(el('dt', {}, name), el('dd', {}, value));
  return list;
}

function buttons(...all: HTMLElement[]): HTMLElement {
  return el('div', { class: 'buttons' }, ...all);
}

function crewText(crew: TaskAccount['crew']): string {
  return crew.map(({ role, members }) => `${members.join(', ')} (${shown(role)})`).join('; ');
}

export function taskColour(run: Run, task: string, theme: Theme): string {
  return pickFrom(theme.tasks, new TaskColours(run.header).of(task).colour);
}
