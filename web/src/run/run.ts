// A run, as far as its log has been read: everything the page shows can be asked of it, at any time.

import type { DecisionEvent, LogEvent } from '../log/events';
import type { Header, Pose, Tick } from '../log/header';
import { CarrierTrack } from './carriers';
import { Diary, type Activity } from './diary';
import { Machines } from './machines';
import { Material, materials } from './material';
import { Motion } from './motion';
import { firstWhere, StepSeries } from './series';

export interface Milestone {
  t: Tick;
  name: string;
}
export interface Ending {
  t: Tick;
  status: string;
  makespan: Tick | null;
  progress: number;
}
export interface TaskRun {
  decision: DecisionEvent;
  until: Tick; // Infinity while it runs
  members: Set<string>; // workers
}

export interface OperationRun {
  operation: string;
  begin: Tick;
  end: Tick;
}

const SOMEWHERE: Pose = { x: 0, y: 0, yaw: 0 };

export class Run {
  readonly motions = new Map<string, Motion>();
  readonly diaries = new Map<string, Diary>();
  readonly carriers = new Map<string, CarrierTrack>();
  readonly machines: Machines;
  readonly material: Material;
  readonly materials: Set<string>;
  readonly decisions: DecisionEvent[] = [];
  readonly tasks = new Map<number, TaskRun>(); // by decision
  readonly milestones: Milestone[] = [];
  readonly eventTicks: Tick[] = []; // in which something happens, each once
  readonly zones = new Map<string, StepSeries>(); // 1: closed
  /** Where workers stood when they took from a place or operated a machine: for logs that do not say. */
  readonly seenAt = new Map<string, string>();
  last: Tick = 0;
  end: Ending | undefined;
  version = 0; // grows with every event

  private readonly operations: OperationRun[] = []; // in order of their beginnings
  private longest: Tick = 0; // of the operations
  private readonly kinds = new Map<string, string>();
  private activitiesAt = -1;
  private readonly kept = new Map<string, Activity[]>();

  constructor(
    readonly name: string,
    readonly header: Header,
  ) {
    this.machines = new Machines(header);
    this.material = new Material(header);
    this.materials = materials(header);
    for (const { id, kind, start } of header.workers) {
      this.kinds.set(id, kind);
      this.motions.set(id, new Motion(this.pose(start, kind), start));
      this.diaries.set(id, new Diary());
    }
    for (const info of header.carriers) this.carriers.set(info.id, new CarrierTrack(info, this.pose(info.start)));
    for (const zone of header.zones) this.zones.set(zone.name, new StepSeries(0));
  }

  add(event: LogEvent): void {
    this.version += 1;
    this.last = event.t;
    if (this.eventTicks[this.eventTicks.length - 1] !== event.t) this.eventTicks.push(event.t);
    this.material.add(event);
    switch (event.event) {
      case 'decision':
        return this.decide(event);
      case 'join':
        this.tasks.get(event.n)?.members.add(event.worker);
        return this.diaries.get(event.worker)!.bind(event.n, event.t, true);
      case 'release':
        return this.diaries.get(event.worker)!.leave(event.t);
      case 'task_end':
        return this.finish(event.n, event.t);
      case 'go':
      case 'reroute':
        return this.go(event);
      case 'blocked':
        this.motions.get(event.worker)!.block(event);
        return this.diaries.get(event.worker)!.note(event.t, Infinity, 'wait', event);
      case 'transfer':
        this.see(event.worker, [event.from, event.to], event.t);
        return this.diaries.get(event.worker)!.note(event.t, event.until, 'work', event);
      case 'operation_start':
      case 'operation_end':
      case 'recovery_end':
        return this.operate(event);
      case 'pick_up':
        return this.carriers.get(event.carrier)!.pickUp(event.t, event.worker!);
      case 'put_down':
        return this.carriers.get(event.carrier)!.putDown(event.t, this.motions.get(event.worker!)!.at(event.t).pose);
      case 'berth':
        return;
      case 'zone':
        return this.zones.get(event.zone)?.set(event.t, event.closed ? 1 : 0);
      case 'milestone':
        this.milestones.push({ t: event.t, name: event.name });
        return;
      case 'end':
        this.end = { t: event.t, status: event.status, makespan: event.makespan, progress: event.progress };
    }
  }

  kindOf(worker: string): string {
    return this.kinds.get(worker) ?? '';
  }

  /** What a worker did so far; kept until the next event. */
  activities(worker: string): Activity[] {
    if (this.activitiesAt !== this.version) this.kept.clear();
    this.activitiesAt = this.version;
    let all = this.kept.get(worker);
    if (!all) this.kept.set(worker, (all = this.diaries.get(worker)?.activities(this.last) ?? []));
    return all;
  }

  /** The operations that are under way. */
  operationsAt(time: number): OperationRun[] {
    const from = firstWhere(this.operations.length, (i) => this.operations[i]!.begin > time - this.longest);
    const to = firstWhere(this.operations.length, (i) => this.operations[i]!.begin > time);
    return this.operations.slice(from, to).filter(({ end }) => time < end);
  }

  /** Items of the order that are finished. */
  finished(time: number): number {
    return this.header.order ? this.material.count(this.header.order.finishedIn, time) : 0;
  }

  carrierPose(carrier: string, time: number): { pose: Pose; worker: string | undefined } {
    const hold = this.carriers.get(carrier)!.at(time);
    const pose = hold.worker ? this.motions.get(hold.worker)!.at(time).pose : hold.pose;
    return { pose, worker: hold.worker };
  }

  /** The pose of a kind at a station; a station where the kind has no business: that of another kind. */
  pose(station: string, kind?: string): Pose {
    const poses = this.header.stations.get(station);
    if (!poses || poses.size === 0) return SOMEWHERE;
    const last = [...poses.values()].pop()!; // carriers are moved by robots, which files name last
    return (kind !== undefined ? poses.get(kind) : undefined) ?? last;
  }

  private decide(event: DecisionEvent): void {
    this.decisions.push(event);
    const members = new Set<string>();
    for (const ids of Object.values(event.crew)) {
      for (const id of Array.isArray(ids) ? ids : []) {
        const diary = this.diaries.get(id);
        if (!diary) continue;
        members.add(id);
        diary.bind(event.n, event.t, false);
      }
    }
    this.tasks.set(event.n, { decision: event, until: Infinity, members });
  }

  private finish(n: number, t: Tick): void {
    const task = this.tasks.get(n);
    if (!task) return;
    task.until = t;
    for (const member of task.members) {
      const diary = this.diaries.get(member)!;
      if (diary.current?.n === n) diary.leave(t);
    }
  }

  private go(event: Extract<LogEvent, { event: 'go' | 'reroute' }>): void {
    const kind = this.kindOf(event.worker);
    this.motions.get(event.worker)!.go(event, this.pose(event.from ?? event.to, kind), this.pose(event.to, kind));
    // To where it stands already: nothing moves, even if the line asks a tick for it.
    if (event.event === 'go' && event.from === event.to) return;
    this.diaries.get(event.worker)!.note(event.departs, event.arrives, 'walk', event);
  }

  private operate(event: Extract<LogEvent, { event: 'operation_start' | 'operation_end' | 'recovery_end' }>): void {
    const diary = event.worker === undefined ? undefined : this.diaries.get(event.worker);
    this.machines.add(event, diary?.current?.n ?? 0);
    if (event.event === 'operation_start' && event.until! > event.t) {
      this.operations.push({ operation: event.operation, begin: event.t, end: event.until! });
      this.longest = Math.max(this.longest, event.until! - event.t);
    }
    if (event.event !== 'operation_start' || !diary) return;
    const { uses, claims } = this.header.operations.get(event.operation)!;
    this.see(event.worker!, [...uses, ...claims], event.t);
    diary.note(event.t, event.until!, 'work', event);
  }

  private see(worker: string, what: string[], t: Tick): void {
    const station = this.motions.get(worker)!.at(t).station;
    if (station) for (const name of what) if (!this.seenAt.has(name)) this.seenAt.set(name, station);
  }
}
