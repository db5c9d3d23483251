// The side panel when nothing is selected: the run in short, what everybody is doing, and what the colours mean.

import { stepText } from '../run/describe';
import { base, milestoneMarks, shown } from '../run/names';
import { firstWhere } from '../run/series';
import type { Run } from '../run/run';
import { el, swatch } from './dom';
import { facts, taskColour } from './details';
import { ending } from './pane';
import type { Theme } from './theme';

const MOST_AGENTS = 40;

export function runFacts(run: Run): HTMLElement {
  const { header } = run;
  const crew = new Map<string, number>();
  for (const { kind } of header.workers) crew.set(kind, (crew.get(kind) ?? 0) + 1);
  const rows: [string, string][] = [['line', shown(header.line)]];
  if (header.order) rows.push(['order', `${header.order.quantity} × ${shown(header.order.product)}`]);
  rows.push(['crew', [...crew].map(([kind, count]) => `${count} ${shown(kind)}${count === 1 ? '' : 's'}`).join(', ')]);
  rows.push(['outcome', run.end ? ending(run) : `so far ${run.last} ticks`]);
  rows.push(['decisions', String(run.decisions.length)]);
  return facts(rows);
}

/** What everybody is doing at a time. */
export function agentsNow(run: Run, time: number, theme: Theme, pick: (worker: string) => void): HTMLElement {
  // Of a run that goes on, what happens at its last tick is not known yet.
  const at = run.end ? time : Math.min(time, run.last - 0.001);
  const rows = run.header.workers.slice(0, MOST_AGENTS).map(({ id }) => {
    const all = run.activities(id);
    const now = all[firstWhere(all.length, (i) => all[i]!.end > at)];
    const active = now && now.begin <= at ? now : undefined;
    const task = active && active.n > 0 ? run.tasks.get(active.n)?.decision.task : undefined;
    const text = active ? stepText(run, id, active) : 'is free';
    return el(
      'li',
      { data: { agent: id }, onclick: () => pick(id) },
      swatch(task === undefined ? theme.wait : taskColour(run, task, theme)),
      el(
        'div',
        {},
        el('b', {}, id),
        task !== undefined && ` · ${shown(task)}`,
        el('br'),
        el('span', { class: 'muted' }, text),
      ),
    );
  });
  const more = run.header.workers.length - MOST_AGENTS;
  return el('ul', { class: 'agents' }, ...rows, more > 0 && el('li', { class: 'muted' }, `and ${more} more`));
}

/** What the colours and marks mean. */
export function legend(run: Run, theme: Theme): HTMLElement {
  const groups = [...new Set(run.header.tasks.map((task) => base(task.name)))];
  const tasks = groups.map((group) =>
    el('span', { class: 'key' }, swatch(taskColour(run, group, theme)), shown(group)),
  );
  const states = (['working', 'held', 'recovering'] as const).map((state) =>
    el('span', { class: 'key' }, swatch(theme[state]), state),
  );
  const marks = new Map<string, string>();
  for (const [name, letter] of milestoneMarks(run.milestones.map((m) => m.name))) {
    if (!marks.has(letter)) marks.set(letter, shown(name.startsWith('task_end.') ? name : base(name)));
  }
  const letters = [...marks].map(([letter, name]) =>
    el('span', { class: 'key' }, el('b', {}, `(${letter})`), ` ${name}`),
  );
  return el(
    'div',
    { class: 'legend' },
    el('h4', {}, 'Tasks'),
    el('p', { class: 'keys' }, ...tasks),
    el(
      'p',
      { class: 'hint' },
      'In a bar: full colour is work, the narrow band is a way, pale is waiting. Lines at the lower edge tell variants of a task apart.',
    ),
    el('h4', {}, 'Machines'),
    el('p', { class: 'keys' }, ...states),
    letters.length > 0 && el('h4', {}, 'Milestones'),
    letters.length > 0 && el('p', { class: 'keys' }, ...letters),
  );
}
