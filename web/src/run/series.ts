import type { Tick } from '../log/header';

/** A number that changes at ticks; the changes come in order of time. */
export class StepSeries {
  readonly ticks: Tick[] = [];
  readonly values: number[] = [];

  constructor(readonly initial: number) {}

  /** The value after the last change. */
  get latest(): number {
    return this.values.length > 0 ? this.values[this.values.length - 1]! : this.initial;
  }

  add(t: Tick, change: number): void {
    this.set(t, this.latest + change);
  }

  set(t: Tick, value: number): void {
    if (this.ticks[this.ticks.length - 1] === t) this.values[this.values.length - 1] = value;
    else {
      this.ticks.push(t);
      this.values.push(value);
    }
  }

  /** The value at a time, after all that happens in its tick. */
  at(time: number): number {
    const next = firstAfter(this.ticks, time);
    return next === 0 ? this.initial : this.values[next - 1]!;
  }

  get max(): number {
    let most = this.initial;
    for (const value of this.values) if (value > most) most = value;
    return most;
  }
}

/** Index of the first entry of an ascending list that is greater than `value`. */
export function firstAfter(ascending: readonly number[], value: number): number {
  return firstWhere(ascending.length, (i) => ascending[i]! > value);
}

/** The smallest index for which `holds` is true; it must be false before and true after. */
export function firstWhere(count: number, holds: (index: number) => boolean): number {
  let low = 0;
  let high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(middle)) high = middle;
    else low = middle + 1;
  }
  return low;
}
