// How many items lie where, at any tick: the tokens of the line, followed from event to event as
// docs/formats/event_log.md says.

import type { LogEvent, OperationEvent, TransferEvent } from '../log/events';
import type { Header, OperationInfo, Tick } from '../log/header';
import { firstAfter, StepSeries } from './series';

export class Material {
  /** By place and by carrier. A berth's tokens are those of the carrier that stands in it. */
  readonly counts = new Map<string, StepSeries>();

  private readonly of = new Map<string, string>();
  private readonly loads = new Map<string, { ticks: Tick[]; of: string[] }>(); // by carrier
  private readonly berths = new Set<string>();
  private readonly standing = new Map<string, string>(); // berth to carrier
  private inHand: TransferEvent[] = []; // transfers that have not ended, in order of their ends
  private counted: Tick = 0;

  constructor(private readonly header: Header) {
    for (const place of header.places) {
      this.of.set(place.name, place.of);
      this.counts.set(place.name, new StepSeries(place.initial));
      if (place.berth) this.berths.add(place.name);
    }
    for (const carrier of header.carriers) this.counts.set(carrier.id, new StepSeries(0));
  }

  add(event: LogEvent): void {
    this.passTo(event.t);
    if (event.event === 'transfer') this.lift(event);
    else if (event.event === 'operation_start') this.flow(event, -1);
    else if (event.event === 'operation_end') this.flow(event, +1);
    else if (event.event === 'decision') this.leaveBerths(event.t, Object.values(event.crew));
    else if ((event.event === 'berth' || event.event === 'put_down') && event.berth) {
      this.enterBerth(event.t, event.berth, event.carrier);
    }
  }

  count(name: string, time: number): number {
    return this.counts.get(name)?.at(time) ?? 0;
  }

  /** Of what the items in a carrier are; they are all of one material. */
  loadOf(carrier: string, time: number): string | undefined {
    const load = this.loads.get(carrier);
    return load?.of[firstAfter(load.ticks, time) - 1];
  }

  private load(carrier: string, t: Tick, material: string): void {
    const load = this.loads.get(carrier) ?? { ticks: [], of: [] };
    this.loads.set(carrier, load);
    if (load.of[load.of.length - 1] === material) return;
    load.ticks.push(t);
    load.of.push(material);
  }

  /** Items counted so far that have been put down by hand until `t`. */
  private passTo(t: Tick): void {
    if (t < this.counted) return;
    this.counted = t;
    while (this.inHand.length > 0 && this.inHand[0]!.until <= t) {
      const done = this.inHand.shift()!;
      this.move(done.from, done.until, -1);
      this.move(done.to, done.until, +1);
    }
  }

  private lift(event: TransferEvent): void {
    const at = this.inHand.findIndex((other) => other.until > event.until);
    this.inHand.splice(at < 0 ? this.inHand.length : at, 0, event);
    const material = this.of.get(event.from) ?? this.of.get(event.to);
    for (const end of [event.from, event.to]) if (!this.of.has(end) && material) this.load(end, event.t, material);
  }

  private flow(event: OperationEvent, sign: number): void {
    const operation: OperationInfo | undefined = this.header.operations.get(event.operation);
    const flows = sign < 0 ? operation?.consumes : operation?.produces;
    for (const [place, count] of flows ?? []) this.move(place, event.t, sign * count);
  }

  private move(where: string, t: Tick, change: number): void {
    this.counts.get(where)?.add(t, change);
    const carrier = this.standing.get(where);
    if (!carrier) return;
    this.counts.get(carrier)?.add(t, change);
    this.load(carrier, t, this.of.get(where) ?? 'item');
  }

  private enterBerth(t: Tick, berth: string, carrier: string): void {
    if (!this.berths.has(berth)) return;
    this.standing.set(berth, carrier);
    this.counts.get(berth)!.set(t, this.counts.get(carrier)?.latest ?? 0);
  }

  /** A carrier that gets bound to a task no longer counts as standing in its berth. */
  private leaveBerths(t: Tick, roles: string[][]): void {
    for (const members of roles) {
      for (const [berth, carrier] of this.standing) {
        if (!members.includes(carrier)) continue;
        this.standing.delete(berth);
        this.counts.get(berth)!.set(t, 0);
      }
    }
  }
}

/**
 * The materials that become the product; other tokens only steer machines ("belt to advance") and are not shown.
 * A material belongs to it if operations turn it, in any number of steps, into what the order is finished in.
 */
export function materials(header: Header): Set<string> {
  const of = new Map(header.places.map((place) => [place.name, place.of]));
  const finished = header.order ? of.get(header.order.finishedIn) : undefined;
  if (finished === undefined) return new Set(of.values());
  const found = new Set([finished]);
  for (let before = 0; before < found.size; ) {
    before = found.size;
    for (const operation of header.operations.values()) {
      const out = [...operation.produces.keys()].some((place) => found.has(of.get(place)!));
      if (out) for (const place of operation.consumes.keys()) found.add(of.get(place)!);
    }
  }
  return found;
}
