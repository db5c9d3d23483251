/** Frames per second while the run plays, measured on the page. */
export class FrameMeter {
  private times: number[] = [];

  count(now: number, playing: boolean): void {
    if (!playing) this.times = [];
    this.times.push(now);
    if (this.times.length > 600) this.times.shift();
  }

  reset(): void {
    this.times = [];
  }

  read(): { frames: number; seconds: number; framesPerSecond: number; longestMs: number } {
    const { times } = this;
    const frames = Math.max(0, times.length - 1);
    const seconds = frames > 0 ? (times[frames]! - times[0]!) / 1000 : 0;
    let longestMs = 0;
    for (let i = 1; i < times.length; ++i) longestMs = Math.max(longestMs, times[i]! - times[i - 1]!);
    return { frames, seconds, framesPerSecond: seconds > 0 ? frames / seconds : 0, longestMs };
  }
}

/**
 * How finely the hall is drawn while it plays: without a graphics card, pixels are what costs. A picture that stands
 * still is always drawn finely.
 */
export class Fineness {
  private level = 0;
  private slow = 0; // frames in a row that took too long

  constructor(private readonly slowMs = 80) {}

  get scale(): number {
    return [1, 0.75, 0.55][this.level]!;
  }

  /** A frame of a playing run took so long. Returns whether the scale changed. */
  took(ms: number): boolean {
    this.slow = ms > this.slowMs ? this.slow + 1 : 0;
    if (this.slow < 5 || this.level === 2) return false;
    this.level += 1;
    this.slow = 0;
    return true;
  }
}
