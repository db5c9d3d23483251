import { describe, expect, it } from 'vitest';
import { loadRun, logText } from '../../tests/support';
import type { WayEvent } from '../log/events';
import { Motion, turned } from './motion';

const HERE = { x: 0, y: 0, yaw: 0 };
const THERE = { x: 8, y: 6, yaw: Math.PI / 2 };

function way(t: number, departs: number, arrives: number, more: Partial<WayEvent> = {}): WayEvent {
  return { t, event: 'go', worker: 'w', from: 'here', to: 'there', departs, arrives, metres: 10, ...more };
}

describe('motion', () => {
  it('is straight and even where the log has no path, and looks where it goes', () => {
    const motion = new Motion(HERE, 'here');
    motion.go(way(2, 4, 14), HERE, THERE);
    expect(motion.at(3)).toMatchObject({ moving: false, pose: HERE });
    const half = motion.at(9);
    expect(half).toMatchObject({ moving: true, pose: { x: 4, y: 3 } });
    expect(half.pose.yaw).toBeCloseTo(Math.atan2(6, 8));
    expect(motion.at(14)).toMatchObject({ moving: false, pose: THERE, station: 'there', since: 14 });
    expect(motion.at(1000).pose).toEqual(THERE);
  });

  it('passes every point of every path of a log at its share of the time', () => {
    const run = loadRun('routed');
    const ways = logText('routed')
      .split('\n')
      .filter((line) => line.includes('"path"'));
    let checked = 0;
    for (const event of ways.map((line) => JSON.parse(line) as WayEvent)) {
      for (const [x, y, yaw, share] of event.path!) {
        const { pose } = run.motions.get(event.worker)!.at(event.departs + share * (event.arrives - event.departs));
        expect(Math.hypot(pose.x - x, pose.y - y)).toBeLessThan(1e-6);
        if (share > 0 && share < 1) checked += Math.abs(Math.sin((pose.yaw - yaw) / 2)) < 1e-6 ? 1 : 0;
      }
    }
    expect(checked).toBeGreaterThan(100); // corners have two headings at one share, so not every one can agree
  });

  it('forgets a way that another one replaces before it has begun', () => {
    const motion = new Motion(HERE, 'here');
    motion.go(way(2, 8, 18), HERE, THERE);
    motion.go(way(5, 6, 16, { to: 'here' }), HERE, HERE);
    expect(motion.at(12).pose).toMatchObject({ x: 0, y: 0 });
  });

  it('goes on from between two stations, and stands where there is no way', () => {
    const motion = new Motion(HERE, 'here');
    motion.go(way(0, 0, 10), HERE, THERE);
    motion.block({ t: 5, event: 'blocked', worker: 'w', pose: [4, 3, 1], to: 'there' });
    expect(motion.at(7)).toMatchObject({ moving: false, pose: { x: 4, y: 3, yaw: 1 }, station: undefined });
    motion.go(way(8, 9, 11, { event: 'reroute', pose: [4, 3, 1] }), HERE, THERE);
    expect(motion.at(8.5).pose).toMatchObject({ x: 4, y: 3 });
    expect(motion.at(10).pose).toMatchObject({ x: 6, y: 4.5 });
  });

  it('shows the way ahead from where the worker is to the end', () => {
    const motion = new Motion(HERE, 'here');
    motion.go(
      way(0, 0, 10, {
        path: [
          [0, 0, 0, 0],
          [8, 0, 0, 0.5],
          [8, 6, 1, 1],
        ],
      }),
      HERE,
      THERE,
    );
    expect(motion.ahead(2).map(({ x, y }) => [x, y])).toEqual([
      [3.2, 0],
      [8, 0],
      [8, 6],
      [8, 6],
    ]);
    expect(motion.ahead(7).map(({ x, y }) => [x, y])[0]![0]).toBe(8);
    expect(motion.ahead(10)).toEqual([]);
  });

  it('turns the short way round', () => {
    expect(turned(3, -3, 0.5)).toBeCloseTo(Math.PI);
    expect(turned(-3, 3, 1)).toBeCloseTo(3 - 2 * Math.PI);
  });
});
