// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { FlightRecord } from '../src/flights/record';
import { steadyWind } from '../src/flights/wind';

/** A flight in wind of these columns, ft/s; the air of others rests. */
function flown(columns: Record<string, number[]>): FlightRecord {
  return {
    column: (name: string) => Float32Array.from(columns[name] ?? [0, 0, 0, 0]),
  } as unknown as FlightRecord;
}

describe('the wind of a flight', () => {
  it('is its horizontal mean, to where it blows', () => {
    const wind = steadyWind(flown({
      wind_north_fps: [195, 205, NaN, 200], wind_east_fps: [-45, -55, -50, -50],
      wind_down_fps: [30, 20, 25, 25],
    }));
    expect(wind?.toArray()).toEqual([-50, 0, -200]);
  });
  it('is none where gusts may be all of it', () => {
    expect(steadyWind(flown({ wind_north_fps: [10, -6, 8, -4], wind_down_fps: [9, 9, 9, 9] })))
      .toBeNull();
    // Gusts across count, too.
    const along = { wind_north_fps: [5, 5, 5, 5] };
    expect(steadyWind(flown(along))).not.toBeNull();
    expect(steadyWind(flown({ ...along, wind_east_fps: [8, -8, 8, -8] }))).toBeNull();
  });
  it('is none where it is weak, and where no column says it', () => {
    expect(steadyWind(flown({ wind_east_fps: [2, 2, 2, 2] }))).toBeNull();
    expect(steadyWind(flown({}))).toBeNull();
    expect(steadyWind(flown({ wind_north_fps: [NaN], wind_east_fps: [NaN] }))).toBeNull();
  });
});
