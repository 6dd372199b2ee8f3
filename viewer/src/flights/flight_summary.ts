// SPDX-License-Identifier: Apache-2.0
// What came of a flight, and its extremes: to find the one that is to be looked at.
import type { FlightRecord } from './record';

/** A value, and when it was; no value where a flight has none. */
export interface Moment {
  value: number;
  time: number;
}

export interface Extreme {
  name: string;
  column: string;
  decimals: number;
  /** Which of two values is the more extreme one. */
  measure: (value: number) => number;
}

export const EXTREMES: Extreme[] = [
  { name: 'peak nz, g', column: 'load_factor_g', decimals: 2, measure: (value) => value },
  { name: 'lowest nz, g', column: 'load_factor_g', decimals: 2, measure: (value) => -value },
  { name: 'peak |alpha|, deg', column: 'alpha_deg', decimals: 1, measure: Math.abs },
  { name: 'peak |beta|, deg', column: 'beta_deg', decimals: 2, measure: Math.abs },
  { name: 'peak |p|, deg/s', column: 'p_deg_s', decimals: 0, measure: Math.abs },
  { name: 'lowest altitude, ft', column: 'altitude_ft', decimals: 0, measure: (value) => -value },
];

/** The most extreme value among a flight's rows and when it first was; null if it has none. */
export function extremeOf(record: FlightRecord, { column, measure }: Extreme): Moment | null {
  if (!record.has(column)) return null;
  const values = record.column(column);
  let worst = -1;
  for (let row = 0; row < values.length; row += 1) {
    if (!Number.isFinite(values[row])) continue;
    if (worst < 0 || measure(values[row]) > measure(values[worst])) worst = row;
  }
  return worst < 0 ? null : { value: values[worst], time: record.timeOf(worst) };
}

/** 2 of a flight that was lost, 1 of one that reached no target in its time, else 0. */
function rankOf(record: FlightRecord): number {
  if (record.isLost) return 2;
  return record.reached.length === 0 ? 1 : 0;
}

/** Lost flights first, then those without a target; then, of missions, who reached fewer, and of
 * the others who reached it later. */
export function worstFirst(a: FlightRecord, b: FlightRecord): number {
  const later = (b.reached[0] ?? 0) - (a.reached[0] ?? 0);
  return rankOf(b) - rankOf(a) || a.reached.length - b.reached.length || later;
}
