// The logs that the page has, and which one or two of them are to be shown.

import type { Run } from '../run/run';
import { newLog, read, type LoadedLog, type Source } from './sources';

export class Shelf {
  readonly logs: LoadedLog[] = [];
  chosen: [number, number] = [0, -1]; // indices of A and B; -1: none

  /** Reads logs; resolves when all that end by themselves have been read. */
  async add(sources: Source[], changed: () => void): Promise<void> {
    const fresh = sources.map((source) => ({ source, log: newLog(source) }));
    const first = this.logs.length;
    this.logs.push(...fresh.map(({ log }) => log));
    // One more log is compared with the first one; two or more with each other.
    this.chosen = fresh.length > 1 ? [first, first + 1] : [0, first > 0 ? first : -1];
    changed();
    await Promise.all(fresh.map(({ source, log }) => read(source, log, changed)));
  }

  /** The runs to show: those chosen that have been read, or are being written. */
  ready(): Run[] {
    const logs = [...new Set(this.chosen)].flatMap((index) => this.logs[index] ?? []);
    return logs.flatMap((log) => (log.run && (log.live || !log.reading) ? [log.run] : []));
  }

  isLive(run: Run): boolean {
    return this.logs.some((log) => log.run === run && log.live);
  }

  /** All have been read, and there is nothing to show in any. */
  get hopeless(): boolean {
    return !this.logs.some((log) => log.run || log.reading);
  }
}
