const FRAMES = 600;

export interface FrameRate {
  frames: number;
  seconds: number;
  framesPerSecond: number;
  longestMs: number;
  /** What the page itself does for a frame, without what the browser draws after it: the median. */
  scriptMs: number;
}

/** Frames per second while the run plays, measured on the page. */
export class FrameMeter {
  private times: number[] = [];
  private scripts: number[] = [];

  /** A frame that began at `now` (ms) and took the page so long. */
  count(now: number, scriptMs: number, playing: boolean): void {
    if (!playing) this.reset();
    this.times.push(now);
    this.scripts.push(scriptMs);
    if (this.times.length > FRAMES) this.times.shift();
    if (this.scripts.length > FRAMES) this.scripts.shift();
  }

  reset(): void {
    this.times = [];
    this.scripts = [];
  }

  read(): FrameRate {
    const { times } = this;
    const frames = Math.max(0, times.length - 1);
    const seconds = frames > 0 ? (times[frames]! - times[0]!) / 1000 : 0;
    let longestMs = 0;
    for (let i = 1; i < times.length; ++i) longestMs = Math.max(longestMs, times[i]! - times[i - 1]!);
    const sorted = [...this.scripts].sort((a, b) => a - b);
    const scriptMs = sorted[sorted.length >> 1] ?? 0;
    return { frames, seconds, framesPerSecond: seconds > 0 ? frames / seconds : 0, longestMs, scriptMs };
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
