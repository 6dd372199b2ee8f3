// SPDX-License-Identifier: Apache-2.0
// A flight that was recorded, read at any time.
import type { Flight, FlightSet, ReportPack } from '../report';
import { attitude, mixedAngle, place } from './frames';
import { Quaternion, Vector3 } from 'three';

const ANGLES = new Set(['yaw_deg', 'roll_deg', 'pitch_deg', 'target_yaw_deg', 'error_yaw_deg']);

export class FlightRecord {
  readonly rows: number;
  readonly interval: number;
  readonly agent: number;
  readonly episode: number;
  readonly end: string;
  readonly result: number;
  private readonly columns = new Map<string, Float32Array>();

  constructor(flight: Flight, pack: ReportPack) {
    this.agent = flight.agent;
    this.episode = flight.episode;
    this.end = flight.end.replace(/_/g, ' ');
    this.result = flight.return;
    this.interval = flight.interval_s;
    for (const [name, reference] of Object.entries(flight.columns)) {
      this.columns.set(name, pack.array(reference));
    }
    this.rows = this.column('north_ft').length;
  }

  has(name: string): boolean {
    return this.columns.has(name);
  }

  /** Of a column that is not there, zeros. */
  column(name: string): Float32Array {
    return this.columns.get(name) ?? new Float32Array(this.rows);
  }

  get duration(): number {
    return (this.rows - 1) * this.interval;
  }

  /** A column at a time, s: linear between rows, the first or the last outside. */
  value(name: string, time: number): number {
    const values = this.columns.get(name);
    if (!values || values.length === 0) return 0;
    const row = Math.min(Math.max(time / this.interval, 0), values.length - 1);
    const left = Math.floor(row);
    const right = Math.min(left + 1, values.length - 1);
    const share = row - left;
    if (ANGLES.has(name)) return mixedAngle(values[left], values[right], share);
    return values[left] + (values[right] - values[left]) * share;
  }

  place(time: number, out: Vector3): Vector3 {
    return place(this.value('north_ft', time), this.value('east_ft', time),
      this.value('altitude_ft', time), out);
  }

  attitude(time: number, out: Quaternion): Quaternion {
    // Between rows the angles turn by little; where pitch nears 90 deg rows are not mixed.
    const isSteep = Math.abs(this.value('pitch_deg', time)) > 80;
    const at = isSteep ? Math.round(time / this.interval) * this.interval : time;
    return attitude(this.value('roll_deg', at), this.value('pitch_deg', at),
      this.value('yaw_deg', at), out);
  }
}

/** The flights of a set by their agent and episode. */
export function recordsOf(set: FlightSet, pack: ReportPack): FlightRecord[] {
  return set.flights.map((flight) => new FlightRecord(flight, pack));
}
