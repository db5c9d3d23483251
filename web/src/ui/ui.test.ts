import { describe, expect, it } from 'vitest';
import { loadRun } from '../../tests/support';
import { Clock } from './clock';
import { Fineness, FrameMeter } from './meter';
import { niceStep } from './gantt_draw';
import { ganttRows } from './gantt_rows';
import { inkOn, THEMES } from './theme';

describe('the clock', () => {
  const clock = (): Clock => Object.assign(new Clock(), { last: 100 });

  it('plays at its speed and stops at the end', () => {
    const it_ = clock();
    it_.play();
    it_.advance(1000);
    expect(it_.time).toBe(8);
    it_.tickSeconds = 0.5;
    it_.advance(1000);
    expect(it_.time).toBe(24);
    it_.advance(1e6);
    expect([it_.time, it_.playing]).toEqual([100, false]);
    it_.play();
    expect(it_.time).toBe(0);
  });

  it('finds neighbours, and stays where there are none', () => {
    const it_ = clock();
    it_.seek(5);
    expect([it_.neighbour([1, 5, 9], 1), it_.neighbour([1, 5, 9], -1), it_.neighbour([5], 1)]).toEqual([9, 1, 5]);
  });

  it('follows a run that grows until the user seeks', () => {
    const it_ = clock();
    it_.follow();
    it_.grow(150);
    expect(it_.moving).toBe(true);
    it_.advance(100);
    expect(it_.time).toBeGreaterThan(105);
    expect(it_.time).toBeLessThan(150);
    for (let i = 0; i < 100; ++i) it_.advance(100);
    expect([it_.time, it_.moving]).toEqual([150, false]);
    it_.seek(20);
    it_.grow(200);
    expect(it_.time).toBe(20);
  });

  it('has speeds from 1 to 64', () => {
    const it_ = clock();
    it_.faster(100);
    expect(it_.speed).toBe(64);
    it_.faster(-100);
    expect(it_.speed).toBe(1);
  });
});

describe('the frame meter', () => {
  it('says how fast the run plays, and what of it is the page', () => {
    const meter = new FrameMeter();
    meter.count(0, 99, false);
    for (let frame = 1; frame <= 1000; ++frame) meter.count(frame * 20, frame % 10 === 0 ? 15 : 4, true);
    expect(meter.read()).toMatchObject({ framesPerSecond: 50, longestMs: 20, scriptMs: 4 });
    meter.count(1e6, 3, false);
    expect(meter.read()).toMatchObject({ frames: 0, framesPerSecond: 0, scriptMs: 3 });
  });
});

describe('the fineness of the hall', () => {
  it('gives way only after some slow frames in a row, and not without end', () => {
    const fineness = new Fineness(80);
    for (const ms of [100, 100, 100, 100, 20, 100, 100, 100, 100]) fineness.took(ms);
    expect(fineness.scale).toBe(1);
    fineness.took(100);
    expect(fineness.scale).toBe(0.75);
    for (let i = 0; i < 50; ++i) fineness.took(1000);
    expect(fineness.scale).toBe(0.55);
  });
});

describe('the Gantt chart', () => {
  it('has a row for every person, robot and busy machine, progress and the buffers', () => {
    const run = loadRun('routed');
    const { rows, height } = ganttRows(run);
    const names = (kind: string): string[] => rows.filter((row) => row.kind === kind).map((row) => row.name);
    expect(names('worker')).toEqual(['human.0', 'human.1', 'robot.0', 'robot.1']);
    expect(names('machine')).toEqual(run.header.machines);
    expect(names('progress')).toEqual(['stored_ducts']);
    expect(names('level')).toEqual(expect.arrayContaining(['flange_table', 'bend_table', 'outfeed_berth']));
    rows.reduce((y, row) => (expect(row.y).toBe(y), y + row.height), 0);
    expect(height).toBeGreaterThan(rows[rows.length - 1]!.y);
  });

  it('has ticks at 1, 2, 5, 10, …', () => {
    expect([0.2, 1.5, 3, 7, 12, 260].map(niceStep)).toEqual([1, 2, 5, 10, 20, 500]);
  });
});

describe('the colours', () => {
  it('can be read: text on every task colour has a contrast of at least 4', () => {
    const luminance = (colour: string): number =>
      [1, 3, 5].reduce((sum, at, i) => {
        const v = parseInt(colour.slice(at, at + 2), 16) / 255;
        return sum + [0.2126, 0.7152, 0.0722][i]! * (v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
      }, 0);
    const contrast = (a: string, b: string): number => {
      const [high, low] = [luminance(a), luminance(b)].sort((x, y) => y - x) as [number, number];
      return (high + 0.05) / (low + 0.05);
    };
    for (const theme of Object.values(THEMES)) {
      for (const colour of theme.tasks) expect(contrast(colour, inkOn(colour)), colour).toBeGreaterThan(4);
      expect(contrast(theme.ink, theme.paper)).toBeGreaterThan(10);
      expect(contrast(theme.muted, theme.paper)).toBeGreaterThan(4.5);
    }
  });
});
