// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from 'three';
import { describe, expect, it } from 'vitest';
import { attitude, direction, mixedAngle, niceStep, place } from '../src/flights/frames';

const RAD = Math.PI / 180;
const NOSE = new Vector3(0, 0, -1);
const RIGHT_WING = new Vector3(1, 0, 0);

/** Where the body's forward axis points, north, east, down, by the direction cosines of
 * z-y-x angles. */
function noseOf(pitch: number, yaw: number): Vector3 {
  const level = Math.cos(pitch * RAD);
  return place(level * Math.cos(yaw * RAD), level * Math.sin(yaw * RAD), Math.sin(pitch * RAD));
}

describe('attitude', () => {
  it('points the nose where pitch and yaw say, whatever the roll', () => {
    for (const [roll, pitch, yaw] of [[0, 0, 0], [40, 20, 75], [-170, -60, -130], [90, 5, 180]]) {
      const nose = NOSE.clone().applyQuaternion(attitude(roll, pitch, yaw));
      expect(nose.distanceTo(noseOf(pitch, yaw))).toBeLessThan(1e-12);
      expect(nose.distanceTo(direction(yaw, pitch))).toBeLessThan(1e-12);
    }
  });
  it('lowers the right wing when it rolls right', () => {
    const wing = RIGHT_WING.clone().applyQuaternion(attitude(30, 0, 0));
    expect(wing.y).toBeCloseTo(-0.5, 12);
    expect(wing.x).toBeCloseTo(Math.cos(30 * RAD), 12);
  });
  it('is a turn: of length one', () => {
    expect(attitude(12, 34, 56).length()).toBeCloseTo(1, 12);
  });
});

it('east is right of north seen from above', () => {
  const north = place(1, 0, 0);
  const east = place(0, 1, 0);
  expect(north.clone().cross(east).y).toBeLessThan(0);
});

it('angles are mixed the short way round', () => {
  expect(mixedAngle(179, -179, 0.5)).toBeCloseTo(180, 12);
  expect(mixedAngle(-170, 170, 0.25)).toBeCloseTo(-175, 12);
  expect(mixedAngle(10, 30, 0.5)).toBeCloseTo(20, 12);
});

it('steps of a grid are 1, 2 or 5 times a power of ten', () => {
  expect([0.3, 7, 1200, 5000].map(niceStep)).toEqual([0.5, 10, 2000, 5000]);
});
