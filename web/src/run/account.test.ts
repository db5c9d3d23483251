// Explanations: comparison, waiting, decisions, marks.

import { describe, expect, it } from 'vitest';
import { loadRun } from '../../tests/support';
import { compare, firstDifference, SHARE_KINDS } from './compare';
import { describeDecision, describeTask } from './describe';
import { milestoneMarks, shown, TaskColours } from './names';

const a = loadRun('routed');
const b = loadRun('routed_fifo');

describe('the comparison of two runs', () => {
  const result = compare(a, b);

  it('explains the difference: of every agent the parts add up to it', () => {
    const whole = b.last - a.last;
    expect(whole).not.toBe(0);
    expect(result.agents).toHaveLength(4);
    for (const agent of result.agents) {
      expect(SHARE_KINDS.reduce((sum, kind) => sum + agent.b![kind] - agent.a![kind], 0)).toBe(whole);
    }
    expect(result.notes[0]).toBe(`B takes ${whole} ticks longer than A (${b.last} against ${a.last}; 1.6 %).`);
  });

  it('finds the first decision that differs', () => {
    const { a: one, b: other } = result.firstDifference!;
    expect(one!.n).toBe(other!.n);
    expect(JSON.stringify([one!.t, one!.task, one!.crew])).not.toBe(
      JSON.stringify([other!.t, other!.task, other!.crew]),
    );
    for (let i = 0; i < one!.n - 1; ++i)
      expect(a.decisions[i]).toMatchObject({ t: b.decisions[i]!.t, task: b.decisions[i]!.task });
  });

  it('finds none between equal runs', () => {
    expect(firstDifference(a, loadRun('routed'))).toBeUndefined();
    expect(compare(a, loadRun('routed')).notes[0]).toBe(`Both take ${a.last} ticks.`);
  });

  it('says when lines and crews are not the same', () => {
    const notes = compare(a, loadRun('kitting_cell')).notes.join(' ');
    expect(notes).toContain('different lines');
    expect(compare(loadRun('closed'), a).notes.join(' ')).toContain('The crews differ');
  });
});

describe('the account of a task', () => {
  it('has steps without gaps from its beginning to its end', () => {
    for (const { id } of a.header.workers) {
      for (const { n, since, until } of a.diaries.get(id)!.bindings) {
        const account = describeTask(a, id, n)!;
        let filled = since;
        for (const step of account.steps) {
          expect(step.begin).toBe(filled);
          filled = step.end;
        }
        expect(filled).toBe(Math.min(until, a.last));
      }
    }
  });

  it('says for whom a worker waits', () => {
    const robot = a.header.workers.find(({ kind }) => kind === 'robot')!.id;
    const { n } = a.diaries.get(robot)!.bindings[0]!;
    const waits = describeTask(a, robot, n)!.steps.filter(({ kind }) => kind === 'wait');
    expect(waits.map(({ text }) => text).join('\n')).toMatch(/waits for human\.\d, moving an item from .* until \d+/);
  });

  it('says that a closed zone bars the way', () => {
    const closed = loadRun('closed');
    const texts = closed.header.workers.flatMap(({ id }) =>
      closed.diaries.get(id)!.bindings.flatMap(({ n }) => describeTask(closed, id, n)!.steps.map(({ text }) => text)),
    );
    expect(texts.filter((text) => text.includes('a zone is closed'))).not.toHaveLength(0);
    expect(texts.filter((text) => text.includes('from where it was'))).not.toHaveLength(0);
  });
});

describe('the account of a decision', () => {
  it('has alternatives, reasons and candidates where the log has them', () => {
    const account = describeDecision(a, a.decisions[0]!);
    expect(account.alternatives.filter(({ chosen }) => chosen)).toHaveLength(1);
    expect(account.alternatives.some(({ best }) => best)).toBe(true);
    expect(account.impossible.map(({ reason }) => reason).join()).toContain('needs 1');
    const human = account.candidates.find(({ role }) => role === 'human')!;
    expect(human.rows).toHaveLength(2);
    expect(human.rows.filter(({ chosen }) => chosen)).toHaveLength(1);
    expect(account.plannedEnd).toBeUndefined();
    const planned = { ...a.decisions[0]!, why: { planned_end: 700 } };
    expect(describeDecision(a, planned).plannedEnd).toBe(700);
  });

  it('says so where it has none', () => {
    expect(describeDecision(b, b.decisions[0]!).explained).toBe(false);
  });
});

describe('names', () => {
  it('are shown without underscores, but identifiers of workers as they are', () => {
    expect(shown('weld_flange.inner')).toBe('weld flange · inner');
    expect(shown('human.0')).toBe('human.0');
  });

  it('give one mark to all milestones of a kind', () => {
    const marks = milestoneMarks(a.milestones.map(({ name }) => name));
    expect(new Set(marks.values()).size).toBe(9);
    expect(marks.get('flange_welded.inner')).toBe(marks.get('flange_welded.outer'));
    const many = milestoneMarks(Array.from({ length: 28 }, (_, i) => `kind${i}`));
    expect([many.get('kind25'), many.get('kind26'), many.get('kind27')]).toEqual(['z', 'aa', 'ab']);
  });

  it('give variants of a task one colour', () => {
    const colours = new TaskColours(a.header);
    expect(colours.of('load_flange.inner').colour).toBe(colours.of('load_flange.outer').colour);
    expect(colours.of('load_flange.inner').variant).not.toBe(colours.of('load_flange.outer').variant);
    expect(colours.of('bring_bends').colour).not.toBe(colours.of('bring_flanges').colour);
  });
});
