// SPDX-License-Identifier: Apache-2.0
// The steady wind of a flight, told from its gusts.
import { Vector3 } from 'three';
import type { Numbers } from '../pack';
import type { FlightRecord } from './record';

/** A wind that is weaker is not drawn, nor is a difference that is smaller one, ft/s. */
const LEAST_WIND_FPS = 3;

/** Mean and variance of the numbers of a column. */
function momentsOf(values: Numbers): { mean: number; variance: number } {
  const numbers = Array.from(values).filter(Number.isFinite);
  const meanOf = (terms: number[]) =>
    terms.reduce((sum, term) => sum + term, 0) / Math.max(1, terms.length);
  const mean = meanOf(numbers);
  return { mean, variance: meanOf(numbers.map((value) => (value - mean) ** 2)) };
}

/** The mean horizontal velocity of the air over the flight, ft/s in three.js's axes; null where
 * that may be gusts alone. */
export function steadyWind(record: FlightRecord): Vector3 | null {
  const north = momentsOf(record.column('wind_north_fps'));
  const east = momentsOf(record.column('wind_east_fps'));
  // Rows hold steady wind and gusts together. Gusts last for seconds, so that over a short flight
  // they do not average out: their mean alone rarely exceeds their own standard deviation.
  const gusts = Math.sqrt(north.variance + east.variance);
  const wind = new Vector3(east.mean, 0, -north.mean);
  return wind.length() < Math.max(LEAST_WIND_FPS, gusts) ? null : wind;
}

/** The steady wind of some flights; null where it is not the same for all. */
export function commonWind(records: FlightRecord[]): Vector3 | null {
  const [first, ...others] = records;
  const wind = steadyWind(first);
  // Every episode draws its own; the agents that fly it all have that one.
  const isCommon = others.every((record) => record.episode === first.episode
    || (wind && (steadyWind(record)?.distanceTo(wind) ?? Infinity) < LEAST_WIND_FPS));
  return isCommon ? wind : null;
}
