// The first line of an event log (docs/formats/event_log.md). Keys that a log lacks are filled in with what
// changes nothing; only what no picture can be drawn without is an error.

export type Tick = number;
export type Point = [number, number];

export interface Pose {
  x: number; // metres
  y: number;
  yaw: number; // radians, counter-clockwise from +x
}

export interface WorkerInfo {
  id: string;
  kind: string;
  start: string;
}
export interface CarrierInfo extends WorkerInfo {
  capacity: number;
}
export interface PlaceInfo {
  name: string;
  of: string;
  initial: number;
  capacity?: number;
  berth?: string; // kind of carrier that stands here; the tokens are the items in it
  at?: string; // station
}
export interface OperationInfo {
  name: string;
  takes: number;
  recovery: number;
  uses: string[];
  claims: string[];
  frees: string[];
  consumes: Map<string, number>;
  produces: Map<string, number>;
}
export interface Obstacle {
  name: string;
  polygon: Point[];
  height: number;
}
export interface Zone {
  name: string;
  polygon: Point[];
}
export interface KindInfo {
  length: number; // metres, along the heading
  width: number;
}
export interface Header {
  line: string;
  hash: string;
  tickSeconds: number;
  horizon: number;
  order?: { product: string; quantity: number; finishedIn: string };
  workers: WorkerInfo[];
  carriers: CarrierInfo[];
  stations: Map<string, Map<string, Pose>>;
  places: PlaceInfo[];
  machines: string[];
  operations: Map<string, OperationInfo>;
  tasks: { number: number; name: string }[];
  zones: Zone[];
  bounds?: [number, number, number, number]; // x0, x1, y0, y1
  obstacles: Obstacle[];
  kinds: Map<string, KindInfo>;
  machineStations: Map<string, string>;
  machineAreas: Map<string, Point[]>;
  machinePositions: Map<string, string[]>;
}

type Json = unknown;
type JsonObject = Record<string, Json>;

export function isObject(value: Json): value is JsonObject {
  return typeof value === 'object' && value !== null && !Array.isArray(value);
}
const number = (value: Json, otherwise: number): number =>
  typeof value === 'number' && Number.isFinite(value) ? value : otherwise;
const text = (value: Json, otherwise = ''): string => (typeof value === 'string' ? value : otherwise);
const objects = (value: Json): JsonObject[] => (Array.isArray(value) ? value.filter(isObject) : []);
const texts = (value: Json): string[] =>
  Array.isArray(value) ? value.filter((entry): entry is string => typeof entry === 'string') : [];
const entries = (value: Json): [string, Json][] => (isObject(value) ? Object.entries(value) : []);

function pose(value: Json): Pose | undefined {
  if (!Array.isArray(value) || value.length < 2) return undefined;
  const [x, y, yaw] = value as Json[];
  if (typeof x !== 'number' || typeof y !== 'number') return undefined;
  return { x, y, yaw: number(yaw, 0) };
}

function polygon(value: Json): Point[] {
  if (!Array.isArray(value)) return [];
  const corners = value.map(pose);
  if (corners.length < 3 || corners.includes(undefined)) return [];
  return corners.map((corner) => [corner!.x, corner!.y]);
}

function counts(value: Json): Map<string, number> {
  return new Map(entries(value).map(([name, count]) => [name, number(count, 0)]));
}

function stations(value: Json): Header['stations'] {
  const all: Header['stations'] = new Map();
  for (const [name, kinds] of entries(value)) {
    const poses = new Map<string, Pose>();
    for (const [kind, at] of entries(kinds)) {
      const where = pose(at);
      if (where) poses.set(kind, where);
    }
    all.set(name, poses);
  }
  return all;
}

function place(entry: JsonObject): PlaceInfo {
  const name = text(entry.name);
  const info: PlaceInfo = { name, of: text(entry.of, name), initial: number(entry.initial, 0) };
  if (typeof entry.capacity === 'number') info.capacity = entry.capacity;
  if (typeof entry.berth === 'string') info.berth = entry.berth;
  if (typeof entry.at === 'string') info.at = entry.at;
  return info;
}

function operation(entry: JsonObject): OperationInfo {
  return {
    name: text(entry.name),
    takes: number(entry.takes, 0),
    recovery: number(entry.recovery, 0),
    uses: texts(entry.uses),
    claims: texts(entry.claims),
    frees: texts(entry.frees),
    consumes: counts(entry.consumes),
    produces: counts(entry.produces),
  };
}

function kinds(value: Json): Map<string, KindInfo> {
  const all = new Map<string, KindInfo>();
  for (const [kind, about] of entries(value)) {
    if (!isObject(about)) continue;
    const outline = polygon(about.outline_m);
    const size = outline.length > 0 ? extentOf(outline) : about.footprint_m;
    if (Array.isArray(size)) all.set(kind, { length: number(size[0], 1.2), width: number(size[1], 0.8) });
    else if (typeof about.radius_m === 'number')
      all.set(kind, { length: 2 * about.radius_m, width: 2 * about.radius_m });
  }
  return all;
}

function extentOf(outline: Point[]): Point {
  const size = (axis: 0 | 1): number => {
    const values = outline.map((corner) => corner[axis]);
    return Math.max(...values) - Math.min(...values);
  };
  return [size(0), size(1)];
}

function bounds(value: Json): Header['bounds'] {
  if (!Array.isArray(value) || value.length !== 4) return undefined;
  const [x0, x1, y0, y1] = value.map((entry) => number(entry, NaN)) as [number, number, number, number];
  return x1 > x0 && y1 > y0 ? [x0, x1, y0, y1] : undefined;
}

function order(value: Json): Header['order'] {
  if (!isObject(value)) return undefined;
  return { product: text(value.product), quantity: number(value.quantity, 0), finishedIn: text(value.finished_in) };
}

/** Reads the header; `value` is the parsed first line. */
export function readHeader(value: Record<string, unknown>): Header {
  const hall = isObject(value.hall) ? value.hall : {};
  const shape = (entry: JsonObject): Point[] => polygon(entry.polygon);
  return {
    line: text(value.line, 'line without a name'),
    hash: text(value.scenario_hash),
    tickSeconds: number(value.tick_s, 1),
    horizon: number(value.horizon, 0),
    order: order(value.order),
    workers: objects(value.workers).map((w) => ({ id: text(w.id), kind: text(w.kind), start: text(w.start) })),
    carriers: objects(value.carriers).map((c) => ({
      id: text(c.id),
      kind: text(c.kind),
      start: text(c.start),
      capacity: number(c.capacity, 1),
    })),
    stations: stations(value.stations),
    places: objects(value.places).map(place),
    machines: texts(value.machines),
    operations: new Map(objects(value.operations).map((entry) => [text(entry.name), operation(entry)])),
    tasks: objects(value.tasks).map((task) => ({ number: number(task.number, 0), name: text(task.name) })),
    zones: objects(value.zones)
      .map((zone) => ({ name: text(zone.name), polygon: shape(zone) }))
      .filter((zone) => zone.polygon.length > 0),
    bounds: bounds(hall.bounds),
    obstacles: objects(hall.obstacles)
      .map((entry) => ({ name: text(entry.name), polygon: shape(entry), height: number(entry.height, 1) }))
      .filter((obstacle) => obstacle.polygon.length > 0),
    kinds: kinds(value.kinds),
    machineStations: new Map(
      entries(value.machine_stations).filter((entry): entry is [string, string] => typeof entry[1] === 'string'),
    ),
    machineAreas: new Map(
      entries(value.machine_areas)
        .map(([machine, area]): [string, Point[]] => [machine, polygon(area)])
        .filter(([, area]) => area.length > 0),
    ),
    machinePositions: new Map(entries(value.machine_positions).map(([machine, names]) => [machine, texts(names)])),
  };
}
