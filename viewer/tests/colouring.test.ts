// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import { colourScales, readableRange } from '../src/flights/colouring';
import type { FlightRecord } from '../src/flights/record';
import type { FlightSet } from '../src/report';

/** A flight of these columns alone. */
function flown(columns: Record<string, number[]>): FlightRecord {
  return {
    has: (name: string) => name in columns,
    column: (name: string) => Float32Array.from(columns[name] ?? []),
  } as unknown as FlightRecord;
}

function scaleOf(name: string, records: FlightRecord[]) {
  const set = { targets: [{ column: 'yaw_deg', is_angle: true, tolerance: 5 }] };
  const scales = colourScales(set as unknown as FlightSet, records);
  return scales.find((scale) => scale.name === name) as (typeof scales)[0];
}

describe('a readable range', () => {
  const random = (seed: number) => Math.abs(Math.sin(seed * 12.9898) * 43758.5453) % 1;

  it('holds the numbers, and not much more', () => {
    for (let i = 0; i < 200; i += 1) {
      const low = 3000 * (random(i) - 0.3);
      const high = low + 1 + 1000 * random(i + 0.5) ** 3;
      const [from, to] = readableRange([high, NaN, low, Infinity]);
      expect(from).toBeLessThanOrEqual(low);
      expect(to).toBeGreaterThanOrEqual(high);
      // At each end a step, of which there are at least four.
      if (high - low < 0.01 * Math.abs(high)) continue;
      expect(to - from).toBeLessThanOrEqual(1.5 * (high - low));
    }
  });
  it('has ends that are quick to read', () => {
    expect(readableRange([1, 4.99])).toEqual([1, 5]);
    expect(readableRange([-0.31, 7.2])).toEqual([-1, 8]);
    expect(readableRange([171.3, 218.9])).toEqual([170, 220]);
    expect(readableRange([612, 1088])).toEqual([600, 1100]);
  });
  it('is never empty', () => {
    expect(readableRange([1000, 1000])).toEqual([999, 1001]);
    expect(readableRange([0])).toEqual([-0.001, 0.001]);
    expect(readableRange([NaN])).toEqual([0, 1]);
    expect(readableRange([])).toEqual([0, 1]);
  });
});

describe('colours of trails', () => {
  const slow = flown({ true_airspeed_fps: [171, NaN, 195], load_factor_g: [1, 1, 2] });
  const quick = flown({ true_airspeed_fps: [219, 219, 219], load_factor_g: [1, 3.6, 1] });

  it('go over the range of the flights of the set', () => {
    const scale = scaleOf('true airspeed', [slow, quick]);
    expect([scale.low, scale.high]).toEqual(['170 ft/s', '220 ft/s']);
    expect(scale.share(slow, 0)).toBeCloseTo(0.02, 6);
    expect(scale.share(quick, 0)).toBeCloseTo(0.98, 6);
    const { low, high } = scaleOf('load factor', [slow, quick]);
    expect([low, high]).toEqual(['1 g', '4 g']);
  });
  it('are the agent’s where there is no number', () => {
    expect(scaleOf('true airspeed', [slow, quick]).share(slow, 1)).toBeNull();
    expect(scaleOf('error', [slow]).share(slow, 0)).toBeNull();
  });
});
