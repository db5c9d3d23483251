// Where a worker is and which way it looks, at any time. Follows go, reroute and blocked of the log.

import type { BlockedEvent, PathPoint, WayEvent } from '../log/events';
import type { Pose, Tick } from '../log/header';
import { firstWhere } from './series';

/** Ticks in which a worker on a straight way turns into it, and out of it on arrival. For the eye only. */
const TURN_TICKS = 0.5;

interface Stretch {
  start: Tick; // from when on this holds
  end: Tick; // when it has arrived; start, where it only stands
  from: Pose;
  to: Pose;
  path?: PathPoint[];
  station?: string; // where it leads or stands; none: between two
}

export interface Spot {
  pose: Pose;
  moving: boolean;
  station: string | undefined; // where it stands
  since: Tick; // when it came to stand
}

export class Motion {
  private readonly stretches: Stretch[];

  constructor(start: Pose, station: string) {
    this.stretches = [standing(0, start, station)];
  }

  /** A way that was announced; `to` is the pose at its end, `from` the pose of the station it begins at. */
  go(event: WayEvent, from: Pose, to: Pose): void {
    this.replace(event.t);
    const begin = event.pose ? { x: event.pose[0], y: event.pose[1], yaw: event.pose[2] } : from;
    if (event.departs > event.t) this.stretches.push(standing(event.t, begin, event.from));
    this.stretches.push({
      start: event.departs,
      end: Math.max(event.arrives, event.departs),
      from: begin,
      to,
      path: event.path && event.path.length > 0 ? event.path : undefined,
      station: event.to,
    });
  }

  block(event: BlockedEvent): void {
    this.replace(event.t);
    const [x, y, yaw] = event.pose;
    this.stretches.push(standing(event.t, { x, y, yaw }, undefined));
  }

  at(time: number): Spot {
    const stretch = this.current(time);
    if (time >= stretch.end || time < stretch.start) {
      return { pose: stretch.to, moving: false, station: stretch.station, since: stretch.end };
    }
    const share = (time - stretch.start) / (stretch.end - stretch.start);
    const pose = stretch.path ? along(stretch.path, stretch.to, share) : straight(stretch, time, share);
    return { pose, moving: true, station: undefined, since: stretch.start };
  }

  /** What is left of the way that the worker is on: from where it is to the end, and what it took so far. */
  ahead(time: number): Pose[] {
    const stretch = this.current(time);
    if (time >= stretch.end || time < stretch.start) return [];
    const share = (time - stretch.start) / (stretch.end - stretch.start);
    const rest = (stretch.path ?? []).filter((point) => point[3] > share).map(([x, y, yaw]) => ({ x, y, yaw }));
    return [this.at(time).pose, ...rest, stretch.to];
  }

  /** Ways that were gone, for the picture of the routes. */
  *ways(): Generator<{ from: Pose; to: Pose; path?: PathPoint[] }> {
    for (const stretch of this.stretches) if (stretch.end > stretch.start) yield stretch;
  }

  private current(time: number): Stretch {
    const next = firstWhere(this.stretches.length, (i) => this.stretches[i]!.start > time);
    return this.stretches[Math.max(0, next - 1)]!;
  }

  /** From `t` on something else holds: what would only begin now or later never happens. */
  private replace(t: Tick): void {
    while (this.stretches.length > 1 && this.stretches[this.stretches.length - 1]!.start >= t) this.stretches.pop();
  }
}

function standing(t: Tick, pose: Pose, station: string | undefined): Stretch {
  return { start: t, end: t, from: pose, to: pose, station };
}

/** The pose after `share` of the travel time. Corners are points with the same share and another yaw. */
function along(path: PathPoint[], end: Pose, share: number): Pose {
  const next = firstWhere(path.length, (i) => path[i]![3] > share);
  const before = path[Math.max(0, next - 1)]!;
  const after: PathPoint = path[next] ?? [end.x, end.y, end.yaw, 1];
  const span = after[3] - before[3];
  const part = span > 0 ? Math.min(1, Math.max(0, (share - before[3]) / span)) : 0;
  return {
    x: before[0] + part * (after[0] - before[0]),
    y: before[1] + part * (after[1] - before[1]),
    yaw: turned(before[2], after[2], part),
  };
}

function straight(stretch: Stretch, time: number, share: number): Pose {
  const { from, to } = stretch;
  const far = Math.hypot(to.x - from.x, to.y - from.y);
  if (far < 0.05) return { x: to.x, y: to.y, yaw: turned(from.yaw, to.yaw, share) };
  const heading = Math.atan2(to.y - from.y, to.x - from.x);
  const turn = Math.min(TURN_TICKS, (stretch.end - stretch.start) / 3);
  let yaw = heading;
  if (time < stretch.start + turn) yaw = turned(from.yaw, heading, (time - stretch.start) / turn);
  else if (time > stretch.end - turn) yaw = turned(to.yaw, heading, (stretch.end - time) / turn);
  return { x: from.x + share * (to.x - from.x), y: from.y + share * (to.y - from.y), yaw };
}

/** From one angle to another, the short way. */
export function turned(from: number, to: number, part: number): number {
  const whole = 2 * Math.PI;
  let by = (to - from) % whole;
  if (by > Math.PI) by -= whole;
  if (by < -Math.PI) by += whole;
  return from + by * part;
}
