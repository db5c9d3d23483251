// Who holds a carrier, or where it stands, at any time.

import type { CarrierInfo, Pose, Tick } from '../log/header';
import { firstWhere } from './series';

interface Hold {
  t: Tick;
  worker?: string; // none: it stands
  pose: Pose; // where it stands
}

export class CarrierTrack {
  private readonly holds: Hold[];

  constructor(
    readonly info: CarrierInfo,
    start: Pose,
  ) {
    this.holds = [{ t: 0, pose: start }];
  }

  pickUp(t: Tick, worker: string): void {
    this.holds.push({ t, worker, pose: this.holds[this.holds.length - 1]!.pose });
  }

  putDown(t: Tick, pose: Pose): void {
    this.holds.push({ t, pose });
  }

  at(time: number): Hold {
    const next = firstWhere(this.holds.length, (i) => this.holds[i]!.t > time);
    return this.holds[Math.max(0, next - 1)]!;
  }
}
