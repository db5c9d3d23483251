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
