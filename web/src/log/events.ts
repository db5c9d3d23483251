// The lines of an event log after the first, and the check that one of them fits the header.

import { isObject, type Header, type Tick } from './header';

export type PathPoint = [x: number, y: number, yaw: number, share: number];

export interface Why {
  alternatives?: { task: string; ends?: Tick | null; ruled_out?: boolean }[];
  planned_end?: Tick;
  not_selectable?: Record<string, string>;
  candidates?: Record<
    string,
    { free: { worker: string; ticks: number | null; metres?: number | null }[]; needed_at?: string }
  >;
}
interface At {
  t: Tick;
}
export interface DecisionEvent extends At {
  event: 'decision';
  n: number;
  task: string;
  crew: Record<string, string[]>;
  why?: Why;
}
export interface WayEvent extends At {
  event: 'go' | 'reroute';
  n?: number;
  worker: string;
  from?: string;
  pose?: [number, number, number];
  to: string;
  departs: Tick;
  arrives: Tick;
  metres: number;
  path?: PathPoint[];
}
export interface BlockedEvent extends At {
  event: 'blocked';
  worker: string;
  pose: [number, number, number];
  to: string;
}
export interface TransferEvent extends At {
  event: 'transfer';
  n: number;
  worker: string;
  from: string;
  to: string;
  until: Tick;
}
export interface OperationEvent extends At {
  event: 'operation_start' | 'operation_end' | 'recovery_end';
  operation: string;
  until?: Tick;
  worker?: string;
}
export interface CarrierEvent extends At {
  event: 'pick_up' | 'put_down' | 'berth';
  n: number;
  worker?: string;
  carrier: string;
  station?: string;
  berth?: string;
}
export type LogEvent =
  | DecisionEvent
  | WayEvent
  | BlockedEvent
  | TransferEvent
  | OperationEvent
  | CarrierEvent
  | (At & { event: 'join'; n: number; worker: string; role: string })
  | (At & { event: 'release'; n: number; worker: string })
  | (At & { event: 'task_end'; n: number; task: string })
  | (At & { event: 'zone'; zone: string; closed: boolean })
  | (At & { event: 'milestone'; name: string })
  | (At & { event: 'end'; status: string; makespan: Tick | null; progress: number });

type Rule =
  | 'number'
  | 'string'
  | 'boolean'
  | 'object'
  | 'pose'
  | 'worker'
  | 'carrier'
  | 'station'
  | 'operation'
  | 'zone'
  | 'end'
  | 'berth';

const RULES: Record<LogEvent['event'], Record<string, Rule>> = {
  decision: { n: 'number', task: 'string', crew: 'object' },
  join: { n: 'number', worker: 'worker', role: 'string' },
  go: { worker: 'worker', from: 'station', to: 'station', departs: 'number', arrives: 'number', metres: 'number' },
  reroute: { worker: 'worker', pose: 'pose', to: 'station', departs: 'number', arrives: 'number', metres: 'number' },
  blocked: { worker: 'worker', pose: 'pose', to: 'station' },
  pick_up: { n: 'number', worker: 'worker', carrier: 'carrier' },
  put_down: { n: 'number', worker: 'worker', carrier: 'carrier', station: 'station' },
  berth: { n: 'number', carrier: 'carrier', berth: 'berth' },
  transfer: { n: 'number', worker: 'worker', from: 'end', to: 'end', until: 'number' },
  operation_start: { operation: 'operation', until: 'number' },
  operation_end: { operation: 'operation' },
  recovery_end: { operation: 'operation' },
  release: { n: 'number', worker: 'worker' },
  task_end: { n: 'number', task: 'string' },
  zone: { zone: 'zone', closed: 'boolean' },
  milestone: { name: 'string' },
  end: { status: 'string', progress: 'number' },
};

/** Checks events against one header. */
export class EventChecker {
  private readonly names: Partial<Record<Rule, Set<string>>>;

  constructor(header: Header) {
    const places = header.places.map((place) => place.name);
    const carriers = header.carriers.map((carrier) => carrier.id);
    this.names = {
      worker: new Set(header.workers.map((worker) => worker.id)),
      carrier: new Set(carriers),
      station: new Set(header.stations.keys()),
      operation: new Set(header.operations.keys()),
      zone: new Set(header.zones.map((zone) => zone.name)),
      end: new Set([...places, ...carriers]),
      berth: new Set(header.places.filter((place) => place.berth).map((place) => place.name)),
    };
  }

  /** Why `value` is not an event of this log, or nothing. */
  fault(value: Record<string, unknown>): string | undefined {
    if (typeof value.t !== 'number' || !Number.isFinite(value.t) || value.t < 0) return 'it has no tick "t"';
    if (typeof value.event !== 'string') return 'it has no "event"';
    if (!Object.hasOwn(RULES, value.event)) return `"${value.event}" is no event of this version`;
    for (const [key, rule] of Object.entries(RULES[value.event as LogEvent['event']])) {
      const fault = this.faultOf(value[key], rule);
      if (fault) return `"${key}" of ${value.event} ${fault}`;
    }
    if (value.event === 'decision') {
      if (!isCrew(value.crew)) return '"crew" of decision is not {role: [id, ...]}';
      if (value.why !== undefined && !isWhy(value.why)) return '"why" of decision is not as the format says';
    }
    return value.path === undefined || isPath(value.path) ? undefined : '"path" is not a list of [x, y, yaw, share]';
  }

  private faultOf(value: unknown, rule: Rule): string | undefined {
    const known = this.names[rule];
    if (known) {
      if (typeof value !== 'string') return 'is missing';
      return known.has(value) ? undefined : `is "${value}", which the header does not name`;
    }
    if (rule === 'pose') return isNumbers(value, 3) ? undefined : 'is not [x, y, yaw]';
    if (rule === 'number') return Number.isFinite(value) ? undefined : 'is not a number';
    return typeof value === rule && value !== null ? undefined : `is not a ${rule}`;
  }
}

function isNumbers(value: unknown, size: number): boolean {
  return Array.isArray(value) && value.length === size && value.every((entry) => Number.isFinite(entry));
}

function isPath(value: unknown): boolean {
  return Array.isArray(value) && value.every((point) => isNumbers(point, 4));
}

function isCrew(value: unknown): boolean {
  const ids = (entry: unknown): boolean => Array.isArray(entry) && entry.every((id) => typeof id === 'string');
  return isObject(value) && Object.values(value).every(ids);
}

function isWhy(value: unknown): boolean {
  if (!isObject(value)) return false;
  const { alternatives = [], planned_end = 0, not_selectable = {}, candidates = {} } = value;
  const tasks = Array.isArray(alternatives) && alternatives.every((a) => isObject(a) && typeof a.task === 'string');
  const reasons = isObject(not_selectable) && Object.values(not_selectable).every((r) => typeof r === 'string');
  const ways =
    isObject(candidates) &&
    Object.values(candidates).every((role) => isObject(role) && textOrNone(role.needed_at) && areFree(role.free));
  return tasks && Number.isFinite(planned_end) && reasons && ways;
}

const textOrNone = (value: unknown): boolean => value === undefined || typeof value === 'string';

function areFree(value: unknown): boolean {
  const numberOrNone = (entry: unknown): boolean => entry === undefined || entry === null || Number.isFinite(entry);
  return (
    Array.isArray(value) &&
    value.every((f) => isObject(f) && typeof f.worker === 'string' && numberOrNone(f.ticks) && numberOrNone(f.metres))
  );
}
