// SPDX-License-Identifier: Apache-2.0
// Which strip charts a set of flights has: what an engineer reads.
import type { FlightSet } from '../report';
import { type Series, union } from '../series';
import { type FlightRecord, rounded } from './record';

export interface Strip {
  title: string;
  /** Columns in one chart: the first solid, the second dashed, on an axis of its own if of another
   * unit. */
  columns: string[];
  isOn: boolean;
  tolerance?: number;
  secondAxis?: boolean;
}

/** Of more flights in view the charts hold the first episodes': more lines are not told apart. */
export const MOST_CHARTED = 12;

const NAMES: Record<string, string> = {
  p_deg_s: 'roll rate p', q_deg_s: 'pitch rate q', r_deg_s: 'yaw rate r', power: 'power, %',
};

const UNITS: [RegExp, string][] = [
  [/_deg_s$/, 'deg/s'], [/_deg$/, 'deg'], [/_fps$/, 'ft/s'], [/_ft$/, 'ft'], [/_g$/, 'g'],
];

/** "true_airspeed_fps" is "true airspeed, ft/s". */
export function titleOf(column: string): string {
  const found = UNITS.find(([pattern]) => pattern.test(column));
  const name = NAMES[column] ?? column.replace(found ? found[0] : /$^/, '').replace(/_/g, ' ');
  return found ? `${name}, ${found[1]}` : name;
}

const DECIMALS: [RegExp, number][] = [
  [/^action_|_g$|^(error_)?(alpha|beta)_deg$/, 2], [/mach/, 3], [/_deg$|_fps$|^power$/, 1],
  [/_deg_s$/, 1], [/_ft$/, 0],
];

/** A value of a column, as finely as it is read in flight: always as many decimals, so that it
 * stands still. */
export function reading(column: string, value: number): string {
  if (!Number.isFinite(value)) return '–';
  const [, decimals] = DECIMALS.find(([pattern]) => pattern.test(column)) ?? [/$^/, 2];
  const text = value.toFixed(decimals);
  return Number(text) === 0 ? text.replace('-', '') : text;
}

/** An angle from -180 to 180 degrees. */
export function isWrapped(column: string): boolean {
  return /(roll|yaw)_deg$/.test(column);
}

/** The rows from `from` to before `to` after which such an angle goes on at the other end. */
export function wrapsOf(
  values: ArrayLike<number | null | undefined>, from: number, to: number,
): number[] {
  return Array.from({ length: Math.max(to - from, 0) }, (_, i) => from + i).filter((row) => {
    const [left, right] = [values[row], values[row + 1]];
    return left != null && right != null && Math.abs(right - left) > 180;
  });
}

/** What is held from one policy step to the next, and drawn so. */
export function isCommand(column: string): boolean {
  return /^(action|command|target)_/.test(column);
}

/** The columns over one time axis, which is the first of the arrays: the rows of the longest
 * flight, and the ends of all. */
export function dataOf(records: FlightRecord[], strip: Strip): [xs: number[], ...lines: Series[]] {
  const longest = records.reduce((a, b) => (a.duration > b.duration ? a : b));
  const rows = Array.from({ length: longest.rows }, (_, row) => rounded(longest.timeOf(row)));
  const xs = union([rows, records.map((record) => rounded(record.duration))]);
  const lines = records.flatMap((record) => strip.columns.map((column) => {
    const isThere = record.has(column);
    return xs.map((x) => {
      const value = isThere && x <= rounded(record.duration) ? record.value(column, x) : NaN;
      return Number.isFinite(value) ? value : null;
    });
  }));
  return [xs, ...lines];
}

/** Those of the flights in view that the charts hold: of the first episodes, of all agents. */
export function chartedOf(shown: FlightRecord[]): FlightRecord[] {
  return [...shown].sort((a, b) => a.episode - b.episode || a.agent - b.agent).slice(0, MOST_CHARTED);
}

/** The charts that a set of flights has, of any of its agents. */
export function stripsOf(set: FlightSet, records: FlightRecord[]): Strip[] {
  const isThere = (column: string) => records.some((record) => record.has(column));
  const errors = set.targets.map((target) => ({
    title: titleOf(`error_${target.column}`), columns: [`error_${target.column}`], isOn: true,
    tolerance: target.tolerance,
  }));
  const pair = (command: string, surface: string, isOn: boolean): Strip => ({
    title: `${titleOf(command)}, and dashed ${titleOf(surface)} (right)`,
    columns: [command, surface], isOn, secondAxis: true,
  });
  /** With what a high-level policy commands, if one does. */
  const one = (column: string, isOn: boolean): Strip => {
    const command = `command_${column}`;
    return isThere(command)
      ? { title: `${titleOf(column)}, and dashed as commanded`, columns: [column, command], isOn: true }
      : { title: titleOf(column), columns: [column], isOn };
  };
  return [
    ...errors,
    { title: 'normal load factor, g', columns: ['load_factor_g'], isOn: true },
    one('alpha_deg', true), one('beta_deg', true), one('roll_deg', true),
    pair('action_pitch', 'elevator_deg', true), pair('action_roll', 'aileron_deg', true),
    pair('action_yaw', 'rudder_deg', false), pair('action_throttle', 'power', true),
    one('p_deg_s', true), one('q_deg_s', false), one('r_deg_s', false),
    one('pitch_deg', false), one('yaw_deg', false), one('true_airspeed_fps', true),
    one('mach', false), one('altitude_ft', true), one('lateral_load_factor_g', false),
    one('leading_edge_flap_deg', false), one('reward', false),
    ...['action_target_pitch', 'action_target_yaw', 'action_target_speed'].map((c) => one(c, false)),
  ].filter((strip) => strip.columns.every(isThere));
}
