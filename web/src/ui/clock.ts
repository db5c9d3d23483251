// The time that the page shows, shared by all runs on it.

import type { Tick } from '../log/header';
import { firstAfter, firstWhere } from '../run/series';

export const SPEEDS = [1, 2, 4, 8, 16, 32, 64] as const;

const CATCH_UP_MS = 500; // in which two thirds of what is missing are made up

export class Clock {
  time = 0;
  playing = false;
  speed = 8; // times real time
  last: Tick = 0; // where the longest run ends
  following = false; // stays at the end of a run that is still going on
  tickSeconds = 1;

  seek(time: number): void {
    this.time = Math.min(this.last, Math.max(0, time));
    this.following = false;
  }

  play(): void {
    if (this.time >= this.last && !this.following) this.time = 0;
    this.playing = true;
  }

  pause(): void {
    this.playing = false;
  }

  /** The runs have grown up to `last`; who follows catches up smoothly. */
  grow(last: Tick): void {
    this.last = last;
  }

  /** Time passes by itself. */
  get moving(): boolean {
    return this.following ? this.time < this.last : this.playing;
  }

  /** Jumps to the end of a run that is still going on, and stays there. */
  follow(): void {
    this.time = this.last;
    this.following = true;
    this.playing = false;
  }

  /** `ms` of real time have passed. Returns whether the time shown changed. */
  advance(ms: number): boolean {
    if (this.following) return this.catchUp(ms);
    if (!this.playing) return false;
    const before = this.time;
    this.time = Math.min(this.last, this.time + (ms / 1000) * (this.speed / this.tickSeconds));
    if (this.time >= this.last) this.playing = false;
    return this.time !== before;
  }

  private catchUp(ms: number): boolean {
    const behind = this.last - this.time;
    const left = behind * Math.exp(-ms / CATCH_UP_MS);
    this.time = left < 0.05 ? this.last : this.last - left;
    return behind > 0;
  }

  faster(steps: number): void {
    const at = SPEEDS.indexOf(this.speed as (typeof SPEEDS)[number]);
    this.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, at + steps))]!;
  }

  /** The next (+1) or previous (-1) of ascending ticks, seen from now; none: now. */
  neighbour(ticks: readonly Tick[], direction: 1 | -1): Tick {
    const index =
      direction > 0 ? firstAfter(ticks, this.time) : firstWhere(ticks.length, (i) => ticks[i]! >= this.time) - 1;
    return ticks[index] ?? this.time;
  }
}
