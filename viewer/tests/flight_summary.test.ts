// SPDX-License-Identifier: Apache-2.0
import { expect, it } from 'vitest';
import { EXTREMES, extremeOf, worstFirst } from '../src/flights/flight_summary';
import type { FlightRecord } from '../src/flights/record';

const flight = (end: string, reached: number[]) =>
  ({ isLost: end === 'lost', reached }) as unknown as FlightRecord;

it('lost flights come first, then those without a target, then the slow ones', () => {
  const fast = flight('target', [10]);
  const slow = flight('target', [20]);
  const late = flight('time', []);
  const lost = flight('lost', []);
  const lostInHold = flight('lost', [5]);
  expect([fast, lostInHold, late, slow, lost].sort(worstFirst))
    .toEqual([lost, lostInHold, late, slow, fast]);
});

it('missions with fewer targets come first', () => {
  const few = flight('time', [10]);
  const many = flight('time', [20, 30]);
  expect([many, few].sort(worstFirst)).toEqual([few, many]);
});

const record = (columns: Record<string, number[]>) => ({
  has: (name: string) => name in columns,
  column: (name: string) => Float32Array.from(columns[name]),
  timeOf: (row: number) => row / 2,
}) as unknown as FlightRecord;
const extreme = (name: string) => {
  const found = EXTREMES.find((one) => one.name.startsWith(name));
  if (!found) throw new Error(name);
  return found;
};

it('an extreme has its sign and its first moment, gaps left out', () => {
  const flown = record({ load_factor_g: [NaN, 1, 5, -2, 5], p_deg_s: [0, 3, -90], alpha_deg: [NaN] });
  expect(extremeOf(flown, extreme('peak nz'))).toEqual({ value: 5, time: 1 });
  expect(extremeOf(flown, extreme('lowest nz'))).toEqual({ value: -2, time: 1.5 });
  expect(extremeOf(flown, extreme('peak |p|'))).toEqual({ value: -90, time: 1 });
  expect(extremeOf(flown, extreme('peak |alpha|'))).toBe(null);
  expect(extremeOf(flown, extreme('peak |beta|'))).toBe(null);
});
