// The eye: orbit, pan and zoom, the view from above, and following an agent.

import { PerspectiveCamera, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { Pose } from '../log/header';
import type { Box } from './geometry';

export type CameraMode = 'overview' | 'top' | 'follow' | 'free';

const FIELD_OF_VIEW = 38; // degrees
const FROM_ABOVE = 12; // narrower: walls and racks hardly lean outwards

export class HallCamera {
  readonly camera = new PerspectiveCamera(FIELD_OF_VIEW, 1, 0.5, 6000);
  mode: CameraMode = 'overview';
  followed: string | undefined;
  private readonly controls: OrbitControls;
  private readonly aim = new Vector3();

  constructor(
    surface: HTMLElement,
    private readonly bounds: Box,
    private readonly height: number, // of what stands highest
    changed: () => void,
  ) {
    this.controls = new OrbitControls(this.camera, surface);
    this.controls.maxPolarAngle = Math.PI * 0.495;
    this.controls.minDistance = 3;
    this.controls.maxDistance = 4000;
    this.controls.zoomToCursor = true;
    this.controls.addEventListener('change', changed);
    this.controls.addEventListener('start', () => {
      if (this.mode !== 'follow') this.mode = 'free';
    });
  }

  resize(width: number, height: number): void {
    this.camera.aspect = width / Math.max(1, height);
    this.camera.updateProjectionMatrix();
    if (this.mode === 'overview' || this.mode === 'top') this.show(this.mode);
  }

  /** Puts the whole hall into the picture, from the south and above or straight from above. */
  show(mode: 'overview' | 'top'): void {
    this.mode = mode;
    this.followed = undefined;
    const { x0, x1, y0, y1 } = this.bounds;
    this.aim.set((x0 + x1) / 2, 0, -(y0 + y1) / 2);
    this.setField(mode === 'top' ? FROM_ABOVE : FIELD_OF_VIEW);
    // Steeper where the picture is narrow, so that the hall fills it.
    const slope = Math.min(0.8, Math.max(0.3, 0.42 * this.camera.aspect));
    const direction = mode === 'top' ? new Vector3(0, 1, 0.0001) : new Vector3(0, 1, slope);
    this.fit(direction.normalize());
  }

  follow(agent: string, pose: Pose): void {
    this.mode = 'follow';
    this.setField(FIELD_OF_VIEW);
    this.followed = agent;
    this.aim.set(pose.x, 1, -pose.y);
    this.camera.position.set(pose.x, 11, -pose.y + 12);
    this.controls.target.copy(this.aim);
    this.controls.update();
  }

  /** Keeps the followed agent in the middle; the eye keeps its distance and direction. */
  track(pose: Pose): void {
    this.aim.set(pose.x, 1, -pose.y);
    this.camera.position.add(this.aim).sub(this.controls.target);
    this.controls.target.copy(this.aim);
    this.controls.update();
  }

  dispose(): void {
    this.controls.dispose();
  }

  /** The smallest distance from which all corners of the hall are in the picture, and in its middle. */
  private fit(direction: Vector3): void {
    for (let round = 0; round < 4; ++round) {
      let [near, far] = [2, 5000];
      for (let step = 0; step < 22; ++step) {
        const distance = (near + far) / 2;
        this.stand(direction, distance);
        if (this.extent().outside) near = distance;
        else far = distance;
      }
      this.stand(direction, far);
      const { low, high } = this.extent();
      // What is nearer looks larger, so the middle of the floor is not the middle of its picture. A little lower
      // still, for the title.
      this.aim.z -=
        (((low + high) / 2 + 0.05) * far * Math.tan((this.camera.fov * Math.PI) / 360)) / Math.max(0.3, direction.y);
    }
    this.controls.target.copy(this.aim);
    this.controls.update();
  }

  private setField(degrees: number): void {
    this.camera.fov = degrees;
    this.camera.updateProjectionMatrix();
  }

  private stand(direction: Vector3, distance: number): void {
    this.camera.position.copy(direction).multiplyScalar(distance).add(this.aim);
    this.camera.lookAt(this.aim);
    this.camera.updateMatrixWorld();
  }

  private extent(): { low: number; high: number; outside: boolean } {
    const { x0, x1, y0, y1 } = this.bounds;
    const corner = new Vector3();
    const extent = { low: Infinity, high: -Infinity, outside: false };
    for (const x of [x0, x1]) {
      for (const y of [y0, y1]) {
        for (const up of [0, this.height]) {
          corner.set(x, up, -y).project(this.camera);
          extent.low = Math.min(extent.low, corner.y);
          extent.high = Math.max(extent.high, corner.y);
          if (Math.abs(corner.x) > 0.97 || corner.z > 1) extent.outside = true;
        }
      }
    }
    if (extent.high - extent.low > 1.8) extent.outside = true;
    return extent;
  }
}
