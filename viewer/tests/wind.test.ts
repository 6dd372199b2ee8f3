// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from 'vitest';
import type { FlightRecord } from '../src/flights/record';
import { commonWind, steadyWind } from '../src/flights/wind';

/** A flight in wind of these columns, ft/s; the air of others rests. */
function flown(columns: Record<string, number[]>, episode = 0): FlightRecord {
  return {
    episode,
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

describe('the wind of some flights', () => {
  const north = (speed: number, episode: number) =>
    flown({ wind_north_fps: [speed, speed + 1, speed - 1, speed] }, episode);

  it('is that of their episode', () => {
    expect(commonWind([north(30, 4), north(30, 4)])?.toArray()).toEqual([0, 0, -30]);
    expect(commonWind([flown({})])).toBeNull();
  });
  it('is none where episodes have others', () => {
    expect(commonWind([north(30, 0), north(30, 0), north(-30, 1)])).toBeNull();
    expect(commonWind([north(30, 0), flown({}, 1)])).toBeNull();
    expect(commonWind([flown({}), north(30, 1)])).toBeNull();
  });
  it('is the one that all episodes have', () => {
    expect(commonWind([north(30, 0), north(31, 1), north(29, 2)])?.toArray()).toEqual([0, 0, -30]);
  });
});
