// SPDX-License-Identifier: Apache-2.0
// The document of a report, as skein packs it (src/report/report_data.cpp).
import type { ArrayReference, Pack } from './pack';

export const KNOWN_FORMAT = 3;

export type Columns = Record<string, ArrayReference>;

export interface Setting {
  key: string;
  value: string;
  help: string;
  /** The preset's value, where it differs. */
  preset?: string;
}

export interface Estimate {
  value: number | null;
  low: number | null;
  high: number | null;
  count: number;
}

export interface Run {
  name: string;
  path: string;
  task: string;
  seed: number;
  preset: string;
  total_steps: number;
  /** Runs that differ by their seed alone have the same. */
  repetition: number;
  notes: string[];
  configuration: Setting[];
  metrics: Columns;
  timing: Columns;
  evaluation: { success_rate?: number; sampled?: { estimates: Record<string, Estimate> } } | null;
}

export interface Quantity {
  key: string;
  symbol: string;
  label: string;
  section: string;
  shown_per_unit: number;
  decimals: number;
  is_headline: boolean;
  /** Which side is the better one; empty of what only describes a flight. */
  better: 'higher' | 'lower' | '';
}

/** An agent's values less another one's, episode by episode. */
export interface PairedDifferences {
  estimates: Record<string, Estimate>;
  success_p_value: number;
}

export interface ComparedAgent {
  name: string;
  action_repeat: number;
  terminations: Record<string, number>;
  estimates: Record<string, Estimate>;
  /** Of the first agent itself none. */
  against_first?: PairedDifferences;
  /** [agent] from each of those ahead of this one, if the data have more than from the first. */
  against?: PairedDifferences[];
}

export interface Comparison {
  task: string;
  /** Of a study. */
  level?: string;
  conditions: string;
  episodes: number;
  seed: number;
  quantities: Quantity[];
  agents: ComparedAgent[];
}

export interface Target {
  column: string;
  is_angle: boolean;
  tolerance: number;
}

export interface Flight {
  agent: number;
  episode: number;
  end: string;
  return: number;
  duration_s: number;
  /** When a mission's further targets came, and when targets counted as reached. */
  new_target_s: number[];
  reached_s: number[];
  /** Between rows; the last one, at `duration_s`, may come sooner. */
  interval_s: number;
  columns: Columns;
}

export interface FlightSet {
  task: string;
  conditions: string;
  seed: number;
  agents: string[];
  targets: Target[];
  is_point: boolean;
  hold_s: number;
  /** Of the aircraft. */
  span_ft: number;
  flights: Flight[];
}

/** Whether conditions (DescribeEvaluation in src/config/conditions.cpp) are those of missions. */
export function areOfMissions(conditions: string): boolean {
  return /; missions of /.test(conditions);
}

/** Whether targets come one after another. Of missions that never came to a second target only the
 * conditions say it. */
export function isOfMissions(set: FlightSet): boolean {
  return areOfMissions(set.conditions)
    || set.flights.some((flight) => flight.new_target_s.length > 0);
}

export const MISSION_FLOWN = 'mission flown';

/** "low_speed" is "low speed". What ends a mission by its time is its length: no target is missed
 * by it. */
export function nameOfEnd(end: string, isMission: boolean): string {
  return isMission && end === 'time_limit' ? MISSION_FLOWN : end.replace(/_/g, ' ');
}

export interface ReportDocument {
  format: number;
  skein: string;
  made: string;
  runs: Run[];
  comparisons: Comparison[];
  flights: FlightSet[];
}

export type ReportPack = Pack<ReportDocument>;
