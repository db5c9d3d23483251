// The side panel of two runs: how they differ, agent by agent, and the first decision in which they do.

import type { DecisionEvent } from '../log/events';
import { compare, SHARE_KINDS, signed, type AgentDifference } from '../run/compare';
import { shown } from '../run/names';
import type { Run } from '../run/run';
import { button, el, swatch } from './dom';
import { taskColour } from './details';
import type { Theme } from './theme';

export interface CompareEvents {
  seek: (time: number) => void;
  showDecision: (side: 0 | 1, decision: DecisionEvent) => void;
}

const COLUMNS = { work: 'work', walk: 'way', wait: 'wait', idle: 'idle' };
const MOST_ROWS = 24;

export function comparison(a: Run, b: Run, theme: Theme, events: CompareEvents): HTMLElement {
  const result = compare(a, b);
  return el(
    'div',
    { class: 'details', data: { kind: 'comparison' } },
    el('h3', {}, 'A and B'),
    el('p', {}, `A: ${a.name}`, el('br'), `B: ${b.name}`),
    ...result.notes.map((note) => el('p', {}, note)),
    el('h4', {}, 'First decision that differs'),
    first(result.firstDifference, [a, b], theme, events),
    el('h4', {}, 'What the agents did, in ticks'),
    el(
      'p',
      { class: 'hint' },
      'Per agent: A, B, and B minus A. Of an agent the differences add up to the difference of the runs.',
    ),
    agents(result.agents, theme),
    el('h4', {}, 'Machines that differ most, busy ticks'),
    machines(result.machines.slice(0, 6)),
  );
}

function first(
  difference: { a: DecisionEvent | undefined; b: DecisionEvent | undefined } | undefined,
  runs: [Run, Run],
  theme: Theme,
  events: CompareEvents,
): HTMLElement {
  if (!difference) return el('p', { data: { first: 'none' } }, 'None: all decisions are the same.');
  const sides = [difference.a, difference.b].map((decision, side) => {
    const letter = side === 0 ? 'A' : 'B';
    if (!decision) return el('li', {}, `${letter}: no further decision`);
    const crew = Object.values(decision.crew).flat().join(', ');
    return el(
      'li',
      {},
      swatch(taskColour(runs[side]!, decision.task, theme)),
      el(
        'div',
        {},
        `${letter}: tick ${decision.t}, `,
        el('b', {}, shown(decision.task)),
        el('br'),
        el('span', { class: 'muted' }, crew),
      ),
      button('Why?', `Show this decision of ${letter}`, () => events.showDecision(side as 0 | 1, decision)),
    );
  });
  const t = Math.min(difference.a?.t ?? Infinity, difference.b?.t ?? Infinity);
  return el(
    'div',
    { data: { first: String(t) } },
    el('ul', { class: 'agents' }, ...sides),
    button('Go there', `Go to tick ${t}`, () => events.seek(t)),
  );
}

function agents(all: AgentDifference[], theme: Theme): HTMLElement {
  const head = el('tr', {}, el('th', {}, 'agent'), ...SHARE_KINDS.map((kind) => el('th', {}, COLUMNS[kind])));
  const rows = all.slice(0, MOST_ROWS).map(({ worker, a, b }) => {
    const cells = SHARE_KINDS.map((kind) => {
      if (!a || !b) return el('td', {}, String((a ?? b)![kind]), el('small', {}, a ? 'only A' : 'only B'));
      return el(
        'td',
        {},
        `${a[kind]}, ${b[kind]}`,
        difference(b[kind] - a[kind], kind === 'work' || kind === 'idle', theme),
      );
    });
    return el('tr', {}, el('th', {}, worker), ...cells);
  });
  return el('table', { class: 'numbers' }, el('thead', {}, head), el('tbody', {}, ...rows));
}

function difference(ticks: number, neutral: boolean, theme: Theme): HTMLElement {
  const mark = el('small', {}, signed(ticks));
  if (ticks !== 0 && !neutral) mark.style.color = ticks > 0 ? theme.tasks[5]! : theme.tasks[2]!;
  return mark;
}

function machines(all: { machine: string; a: number; b: number }[]): HTMLElement {
  const head = el('tr', {}, ...['machine', 'A', 'B', 'B − A'].map((text) => el('th', {}, text)));
  const rows = all.map(({ machine, a, b }) =>
    el(
      'tr',
      {},
      el('th', {}, shown(machine)),
      el('td', {}, String(a)),
      el('td', {}, String(b)),
      el('td', {}, signed(b - a)),
    ),
  );
  return el('table', { class: 'numbers' }, el('thead', {}, head), el('tbody', {}, ...rows));
}
