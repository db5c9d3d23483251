import { describe, expect, it } from 'vitest';
import { logText, runOf } from '../../tests/support';
import { LogReader } from './reader';

const HEADER =
  '{"format":"linewright/event_log/1","line":"small","workers":[{"id":"human.0","kind":"human","start":"here"}],"stations":{"here":{"human":[0,0,0]},"there":{"human":[4,3,0]}}}';
const GO = '{"t":1,"event":"go","worker":"human.0","from":"here","to":"there","departs":1,"arrives":6,"metres":5}';
const END = '{"t":9,"event":"end","status":"finished","makespan":9,"progress":1.0}';

function problemsOf(text: string, limits?: ConstructorParameters<typeof LogReader>[0]): string[] {
  const reader = new LogReader(limits);
  reader.push(text);
  reader.finish();
  return reader.problems.map(({ severity, text: words }) => `${severity}: ${words}`);
}

describe('the reader of logs', () => {
  it('reads the same, however the text is cut into pieces', () => {
    const text = logText('kitting_cell');
    const whole = new LogReader().push(text);
    for (const size of [1, 7, 1000]) {
      const reader = new LogReader();
      const events = [];
      for (let at = 0; at < text.length; at += size) events.push(...reader.push(text.slice(at, at + size)));
      events.push(...reader.finish());
      expect(events).toEqual(whole);
      expect(reader.problems).toEqual([]);
    }
  });

  it('has nothing to say about a whole log', () => {
    expect(problemsOf(`${HEADER}\n${GO}\n${END}\n`)).toEqual([]);
  });

  it('says where a log is cut off, and shows what is there', () => {
    expect(problemsOf(`${HEADER}\n${GO}\n`)).toEqual([
      'warning: The log is cut off after tick 1: the run is shown up to tick 1.',
    ]);
    expect(problemsOf(`${HEADER}\n${GO}\n{"t":9,"ev`)[0]).toContain('cut off in the middle of a line');
    const text = logText('routed');
    const half = runOf(text.slice(0, text.length / 2));
    expect(half.end).toBeUndefined();
    expect(half.last).toBeGreaterThan(100);
  });

  it('refuses what is no log, is empty, or has another version', () => {
    expect(problemsOf('')).toEqual(['error: The file is empty: there is no log in it.']);
    expect(problemsOf('\n \n')).toEqual(['error: The file is empty: there is no log in it.']);
    expect(problemsOf('\x89PNG\n\x1a\n')[0]).toMatch(/^error: This is not an event log/);
    expect(problemsOf('{"schema": "line/1"}\n')[0]).toMatch(/^error: This is not an event log/);
    expect(problemsOf('[]\n')[0]).toMatch(/^error: This is not an event log/);
    expect(problemsOf('{"format":"linewright/event_log/7"}\n')[0]).toMatch(
      /^error: This log has version 7 .* reads version 1/,
    );
    expect(problemsOf('x'.repeat(9e6))[0]).toMatch(/^error: This is not an event log: it has no lines/);
  });

  it.each([
    ['not JSON', 'nonsense', 'it is not a JSON object'],
    ['a list', '[1]', 'it is not a JSON object'],
    ['no tick', '{"event":"end"}', 'it has no tick "t"'],
    ['no event', '{"t":3}', 'it has no "event"'],
    ['an unknown event', '{"t":3,"event":"dance"}', '"dance" is no event of this version'],
    ['a name of objects', '{"t":3,"event":"constructor"}', '"constructor" is no event of this version'],
    [
      'an unknown worker',
      GO.replace('human.0', 'human.7'),
      '"worker" of go is "human.7", which the header does not name',
    ],
    ['a missing key', GO.replace('"arrives":6,', ''), '"arrives" of go is not a number'],
    ['time that runs backwards', GO.replace('"t":1', '"t":0'), 'time runs backwards'],
    [
      'a broken path',
      GO.replace('"metres":5', '"metres":5,"path":[[1,2]]'),
      '"path" is not a list of [x, y, yaw, share]',
    ],
    ['a broken crew', '{"t":3,"event":"decision","n":1,"task":"a","crew":{"human":"human.0"}}', '"crew" of decision'],
    [
      'a number for a station in its reasons',
      '{"t":3,"event":"decision","n":1,"task":"a","crew":{},"why":{"candidates":{"x":{"free":[],"needed_at":7}}}}',
      '"why" of decision',
    ],
    [
      'broken reasons',
      '{"t":3,"event":"decision","n":1,"task":"a","crew":{},"why":{"candidates":{"x":null}}}',
      '"why" of decision',
    ],
  ])('leaves out a line with %s, and says which', (_what, line, reason) => {
    const [problem, ...others] = problemsOf(`${HEADER}\n${GO}\n${line}\n${END}\n`);
    expect(problem).toContain(`Line 3 is left out: ${reason}`);
    expect(others).toEqual([]);
  });

  it('describes only the first of many broken lines', () => {
    const problems = problemsOf(`${HEADER}\n${'nonsense\n'.repeat(50)}${END}\n`);
    expect(problems).toHaveLength(4);
    expect(problems[3]).toContain('47 further lines are left out');
  });

  it('stops where a log is too large for a page, and shows what it has read', () => {
    const many = `${HEADER}\n${`${GO}\n`.repeat(40)}${END}\n`;
    expect(problemsOf(many, { characters: 1e9, events: 10 })[0]).toMatch(
      /too large for a page .* 10 events .* up to tick 1/,
    );
    const reader = new LogReader({ characters: 1000, events: 1e9 });
    for (let at = 0; at < many.length; at += 100) reader.push(many.slice(at, at + 100));
    reader.finish();
    expect(reader.problems[0]!.text).toContain('too large');
    expect(reader.characters).toBeLessThan(1200);
  });

  it('survives a header in which everything has the wrong type', () => {
    const keys = [
      'line',
      'order',
      'workers',
      'carriers',
      'stations',
      'places',
      'machines',
      'operations',
      'tasks',
      'zones',
      'hall',
      'kinds',
      'machine_areas',
    ];
    for (const value of [null, 3, 'text', [null, 1, 'a', [2]], { a: null, b: 1, c: { d: [] } }]) {
      const header = Object.fromEntries(keys.map((key) => [key, value]));
      const text = `${JSON.stringify({ ...header, format: 'linewright/event_log/1' })}\n${END}\n`;
      expect(runOf(text).last).toBe(9);
    }
  });
});
