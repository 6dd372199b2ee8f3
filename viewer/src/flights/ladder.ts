// SPDX-License-Identifier: Apache-2.0
// The symbols of a head-up display, in the scene itself so that they lie where they belong: horizon
// and pitch ladder, and the flight path marker where the aircraft flies to.
import {
  BufferGeometry, Color, Float32BufferAttribute, Group, LineBasicMaterial, LineLoop, LineSegments,
  Vector3,
} from 'three';
import { attitude, direction } from './frames';
import { label } from './ground';
import type { FlightRecord } from './record';

/** Feet from the eye: beyond the nose, before everything else that is not as near. */
const REACH = 300;
const STEP_DEG = 10;
/** Where a rung begins and ends beside the nose, degrees. */
const [INNER, OUTER] = [4, 10];

function rungPoints(elevation: number): number[] {
  const points: Vector3[] = [];
  for (const side of [-1, 1]) {
    const [near, far] = elevation === 0 ? [INNER, 40] : [INNER, OUTER];
    const at = (beside: number, above = elevation) =>
      direction(side * beside, above).multiplyScalar(REACH);
    points.push(at(near), at(far));
    // Ends point to the horizon.
    if (elevation !== 0) points.push(at(far), at(far, elevation - Math.sign(elevation) * 1.2));
  }
  return points.flatMap((point) => point.toArray());
}

export class Ladder {
  readonly group = new Group();
  private readonly rungs = new Group();
  private readonly marker: LineLoop;
  private readonly wind = new Vector3();

  constructor(colour: string) {
    const material = new LineBasicMaterial({ color: new Color(colour), depthTest: false });
    const points: number[] = [];
    for (let elevation = -80; elevation <= 80; elevation += STEP_DEG) {
      points.push(...rungPoints(elevation));
      if (elevation === 0) continue;
      const text = label(String(elevation), colour, 9);
      direction(OUTER + 2.5, elevation, text.position).multiplyScalar(REACH);
      this.rungs.add(text);
    }
    const lines = new BufferGeometry();
    lines.setAttribute('position', new Float32BufferAttribute(points, 3));
    this.rungs.add(new LineSegments(lines, material));
    const ring = Array.from({ length: 24 }, (_, i) => {
      const angle = (i * Math.PI) / 12;
      return new Vector3(3.5 * Math.sin(angle), 3.5 * Math.cos(angle), 0);
    });
    this.marker = new LineLoop(new BufferGeometry().setFromPoints(ring), material);
    this.group.add(this.rungs, this.marker);
    this.group.traverse((object) => {
      object.renderOrder = 10;
      object.frustumCulled = false;
    });
  }

  /** About the eye at `eye`, of an aircraft's flight at a time. */
  show(record: FlightRecord, time: number, eye: Vector3): void {
    this.group.position.copy(eye);
    attitude(0, 0, record.drawn('yaw_deg', time), this.rungs.quaternion);
    const ahead = Math.min(time + 0.2, record.duration);
    const before = Math.max(ahead - 0.4, 0);
    // Over the ground: what the wind does is in it.
    record.place(ahead, this.marker.position).sub(record.place(before, this.wind));
    this.marker.position.setLength(REACH);
    this.marker.lookAt(eye);
  }

  dispose(): void {
    this.group.traverse((object) => {
      if ('geometry' in object) (object.geometry as BufferGeometry).dispose();
    });
  }
}
