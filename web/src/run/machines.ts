// What a machine did: working, held between two operations, recovering.

import type { LogEvent, OperationEvent } from '../log/events';
import type { Header, Tick } from '../log/header';
import { firstWhere } from './series';

export type MachineState = 'working' | 'held' | 'recovering';

export interface MachineInterval {
  begin: Tick;
  end: Tick; // Infinity: not over yet
  state: MachineState;
  operation: string;
  n: number; // the decision whose task it belongs to, when a worker operates it; else 0
}

export class Machines {
  readonly intervals = new Map<string, MachineInterval[]>();

  constructor(private readonly header: Header) {
    for (const machine of header.machines) this.intervals.set(machine, []);
  }

  /** `n` is the decision that the operating worker follows, 0: none. */
  add(event: LogEvent, n: number): void {
    if (event.event === 'operation_start') this.start(event, n);
    else if (event.event === 'operation_end') this.end(event);
    else if (event.event === 'recovery_end') this.free(event);
  }

  at(machine: string, time: number): MachineInterval | undefined {
    const all = this.intervals.get(machine) ?? [];
    const next = firstWhere(all.length, (i) => all[i]!.begin > time);
    const last = all[next - 1];
    return last && time < last.end ? last : undefined;
  }

  private start(event: OperationEvent, n: number): void {
    const operation = this.header.operations.get(event.operation)!;
    for (const machine of [...operation.uses, ...operation.claims, ...operation.frees]) {
      this.change(machine, event.t, { state: 'working', operation: operation.name, n });
      const all = this.intervals.get(machine);
      if (all) all[all.length - 1]!.end = event.until!; // expected, until the log says so
    }
  }

  private end(event: OperationEvent): void {
    const operation = this.header.operations.get(event.operation)!;
    for (const machine of operation.claims) {
      this.change(machine, event.t, { state: 'held', operation: operation.name, n: 0 });
    }
    for (const machine of [...operation.uses, ...operation.frees]) {
      if (operation.recovery > 0) {
        this.change(machine, event.t, { state: 'recovering', operation: operation.name, n: 0 });
      } else this.close(machine, event.t);
    }
  }

  private free(event: OperationEvent): void {
    const operation = this.header.operations.get(event.operation)!;
    for (const machine of [...operation.uses, ...operation.frees]) this.close(machine, event.t);
  }

  private change(machine: string, t: Tick, to: Pick<MachineInterval, 'state' | 'operation' | 'n'>): void {
    this.close(machine, t);
    this.intervals.get(machine)?.push({ begin: t, end: Infinity, ...to });
  }

  private close(machine: string, t: Tick): void {
    const all = this.intervals.get(machine);
    const last = all?.[all.length - 1];
    if (!last) return;
    last.end = Math.min(last.end, t);
    if (last.end <= last.begin) all.pop();
  }
}
