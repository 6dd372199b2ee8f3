// SPDX-License-Identifier: Apache-2.0
// From Skein's axes (north, east, down; the body's forward, right, down) to three.js's: x east (and
// to the right of the body), y up, z south (and backwards). Both are right-handed.
import { Quaternion, Vector3 } from 'three';

const RAD = Math.PI / 180;

/** Feet; altitude is up. */
export function place(northFt: number, eastFt: number, altitudeFt: number, out = new Vector3()) {
  return out.set(eastFt, altitudeFt, -northFt);
}

/** The attitude of roll, pitch and yaw, degrees. */
export function attitude(
  rollDeg: number, pitchDeg: number, yawDeg: number, out = new Quaternion(),
): Quaternion {
  const [roll, pitch, yaw] = [(rollDeg * RAD) / 2, (pitchDeg * RAD) / 2, (yawDeg * RAD) / 2];
  const [cr, cp, cy] = [Math.cos(roll), Math.cos(pitch), Math.cos(yaw)];
  const [sr, sp, sy] = [Math.sin(roll), Math.sin(pitch), Math.sin(yaw)];
  // Components about north (forward), east (right) and down, z-y-x order.
  const x = sr * cp * cy - cr * sp * sy;
  const y = cr * sp * cy + sr * cp * sy;
  const z = cr * cp * sy - sr * sp * cy;
  const w = cr * cp * cy + sr * sp * sy;
  return out.set(y, -z, -x, w);
}

/** The direction of a heading and a climb angle, degrees. */
export function direction(yawDeg: number, pitchDeg: number, out = new Vector3()): Vector3 {
  const level = Math.cos(pitchDeg * RAD);
  return place(level * Math.cos(yawDeg * RAD), level * Math.sin(yawDeg * RAD),
    Math.sin(pitchDeg * RAD), out);
}

/** Between two angles the short way round, degrees. */
export function mixedAngle(a: number, b: number, share: number): number {
  const turn = ((((b - a) % 360) + 540) % 360) - 180;
  return a + turn * share;
}

/** `value` rounded up to 1, 2 or 5 times a power of ten. */
export function niceStep(value: number): number {
  const power = 10 ** Math.floor(Math.log10(Math.max(value, 1e-9)));
  return [1, 2, 5, 10].map((m) => m * power).find((step) => step >= value) ?? 10 * power;
}
