// SPDX-License-Identifier: Apache-2.0
// A flight that was recorded, read at any time.
import type { Numbers } from '../pack';
import {
  type Flight, type FlightSet, isOfMissions, MISSION_FLOWN, nameOfEnd, type ReportPack,
} from '../report';
import { attitude, mixedAngle, place } from './frames';
import { Quaternion, Vector3 } from 'three';

const ANGLES = new Set(['yaw_deg', 'roll_deg', 'pitch_deg', 'error_yaw_deg']);
/** What is held during a step stands in the row at its end. */
const HELD = /^(target|command|action)_/;

/** Degrees, with the signs of Skein: trailing edge down, rolls left, turns left. */
export interface Surfaces {
  elevator: number;
  aileron: number;
  rudder: number;
  leadingEdgeFlap: number;
}

/** How an aircraft is at a time; read again and again into the same one. */
export class Pose {
  readonly place = new Vector3();
  readonly attitude = new Quaternion();
  readonly surfaces: Surfaces = { elevator: 0, aileron: 0, rudder: 0, leadingEdgeFlap: 0 };
}

/** What jumps when a target comes. */
const OF_TARGET = /^(target|error)_/;

/** Rows, and times in s, that are reached but for a rounding error are reached. */
const ROUNDING = 1e-6;

/** A time in s without its rounding error: equal to that of the same row of another flight. */
export function rounded(time: number): number {
  return Number(time.toFixed(6));
}

/** The same values; for one that is not there the one before, for the first ones the next. */
function filled(values: Numbers): Numbers {
  let before = values.find(Number.isFinite) ?? 0;
  return values.map((value) => {
    if (Number.isFinite(value)) before = value;
    return before;
  });
}

/** Between two rows of a column. */
function mixed(values: Numbers, left: number, right: number, share: number): number {
  return values[left] + (values[right] - values[left]) * share;
}

export class FlightRecord {
  readonly rows: number;
  /** Between rows, s; the last one, at the flight's end, may come sooner. */
  readonly interval: number;
  /** To its end, s. */
  readonly duration: number;
  readonly agent: number;
  readonly episode: number;
  readonly end: string;
  /** Whether the aircraft was: it ended neither at its target nor at the end of its time. */
  readonly isLost: boolean;
  readonly result: number;
  /** When targets after the first came, and when targets counted as reached, s. */
  readonly newTargets: number[];
  readonly reached: number[];
  private readonly columns = new Map<string, Numbers>();
  /** Of those that have been drawn, without gaps. */
  private readonly drawnColumns = new Map<string, Numbers>();
  /** What is read for every frame: the column names of a pose. */
  private readonly path: Numbers[];
  private readonly moving: Numbers[];
  /** The attitude of each row. */
  private readonly turns: Float32Array;
  private readonly other = new Quaternion();

  constructor(flight: Flight, pack: ReportPack, private readonly isMission: boolean) {
    this.agent = flight.agent;
    this.episode = flight.episode;
    this.end = nameOfEnd(flight.end, isMission);
    this.isLost = !['target_reached', 'time_limit'].includes(flight.end);
    this.result = flight.return;
    this.interval = flight.interval_s;
    this.newTargets = flight.new_target_s;
    this.reached = flight.reached_s;
    for (const [name, reference] of Object.entries(flight.columns)) {
      this.columns.set(name, pack.array(reference));
    }
    this.rows = this.column('north_ft').length;
    this.duration = flight.duration_s;
    this.path = ['north_ft', 'east_ft', 'altitude_ft'].map((name) => this.drawnColumn(name));
    this.moving = ['elevator_deg', 'aileron_deg', 'rudder_deg', 'leading_edge_flap_deg']
      .map((name) => this.drawnColumn(name));
    this.turns = this.attitudes();
  }

  /** "target reached at 20.6 s, flown for 29.5 s": what came of a flight of one target may be known
   * before its end. */
  outcome(): string {
    const [reached] = this.reached;
    const flown = `${this.duration.toFixed(1)} s`;
    if (this.end === MISSION_FLOWN) return `${this.end}, ${flown}`;
    const isEarlier = !this.isMission && reached < this.duration - ROUNDING;
    if (!isEarlier) return `${this.end} at ${flown}`;
    const end = this.end === 'target reached' ? 'flown for' : `${this.end} at`;
    return `target reached at ${reached.toFixed(1)} s, ${end} ${flown}`;
  }

  private attitudes(): Float32Array {
    const [roll, pitch, yaw] = ['roll_deg', 'pitch_deg', 'yaw_deg']
      .map((name) => this.drawnColumn(name));
    const turns = new Float32Array(4 * this.rows);
    for (let row = 0; row < this.rows; row += 1) {
      attitude(roll[row], pitch[row], yaw[row], this.other).toArray(turns, 4 * row);
    }
    return turns;
  }

  /** Whether there is such a column, with a number in it. */
  has(name: string): boolean {
    return this.columns.get(name)?.some(Number.isFinite) ?? false;
  }

  get names(): string[] {
    return [...this.columns.keys()];
  }

  /** NaN where there is no number; of a column that is not there, zeros. */
  column(name: string): Numbers {
    return this.columns.get(name) ?? new Float32Array(this.rows);
  }

  private drawnColumn(name: string): Numbers {
    const values = this.drawnColumns.get(name) ?? filled(this.column(name));
    this.drawnColumns.set(name, values);
    return values;
  }

  /** When a row is, s. */
  timeOf(row: number): number {
    return row < this.rows - 1 ? row * this.interval : this.duration;
  }

  /** The row of a time, with its fraction; the first or the last outside. */
  private rowAt(time: number): number {
    const before = Math.max(this.rows - 2, 0);
    const from = this.timeOf(before);
    const row = time > from ? before + (time - from) / (this.duration - from)
      : time / this.interval;
    const inside = Math.min(Math.max(row, 0), this.rows - 1);
    return Math.abs(inside - Math.round(inside)) < ROUNDING ? Math.round(inside) : inside;
  }

  /** When the last target came between two rows, if one did: long flights leave rows out. */
  private targetBetween(left: number, right: number): number | undefined {
    const [from, to] = [this.timeOf(left), this.timeOf(right) - ROUNDING];
    return this.newTargets.filter((time) => time > from && time < to).at(-1);
  }

  /** A column at a time, s: linear between rows, but for what is held during a step. NaN in a gap;
   * of a column that is not there, 0. */
  value(name: string, time: number): number {
    return this.read(this.columns.get(name), name, time);
  }

  /** The same for what is drawn in space, without gaps: there the number before, or the first. */
  drawn(name: string, time: number): number {
    return this.read(this.drawnColumn(name), name, time);
  }

  private read(values: Numbers | undefined, name: string, time: number): number {
    if (!values || values.length === 0) return 0;
    const row = this.rowAt(time);
    const [left, right] = [Math.floor(row), Math.ceil(row)];
    if (left === right) return values[left];
    const came = OF_TARGET.test(name) ? this.targetBetween(left, right) : undefined;
    if (came !== undefined) return values[time <= came ? left : right];
    if (HELD.test(name)) return values[right];
    if (ANGLES.has(name)) return mixedAngle(values[left], values[right], row - left);
    return mixed(values, left, right, row - left);
  }

  place(time: number, out: Vector3): Vector3 {
    const row = this.rowAt(time);
    const left = Math.floor(row);
    const right = Math.min(left + 1, this.rows - 1);
    const [north, east, altitude] = this.path;
    return place(mixed(north, left, right, row - left), mixed(east, left, right, row - left),
      mixed(altitude, left, right, row - left), out);
  }

  attitude(time: number, out: Quaternion): Quaternion {
    const row = this.rowAt(time);
    const left = Math.floor(row);
    const right = Math.min(left + 1, this.rows - 1);
    out.fromArray(this.turns, 4 * left);
    return out.slerp(this.other.fromArray(this.turns, 4 * right), row - left);
  }

  pose(time: number, out: Pose): Pose {
    this.place(time, out.place);
    this.attitude(time, out.attitude);
    const row = Math.round(this.rowAt(time));
    const [elevator, aileron, rudder, flap] = this.moving;
    const { surfaces } = out;
    surfaces.elevator = elevator[row];
    surfaces.aileron = aileron[row];
    surfaces.rudder = rudder[row];
    surfaces.leadingEdgeFlap = flap[row];
    return out;
  }

  /** Which of a mission's targets is flown to, from 0. */
  targetAt(time: number): number {
    let target = 0;
    while (target < this.newTargets.length && this.newTargets[target] < time) target += 1;
    return target;
  }

  /** When the n-th target's flight begins and ends, s. */
  targetTimes(target: number): [from: number, to: number] {
    return [target > 0 ? this.newTargets[target - 1] : 0, this.newTargets[target] ?? this.duration];
  }

  /** When the last row is in which the n-th target is flown to, s; null where it came and went
   * between two rows. */
  lastRowTime(target: number): number | null {
    const [from, to] = this.targetTimes(target);
    const time = this.timeOf(Math.floor(this.rowAt(to)));
    return target === 0 || time > from + ROUNDING ? time : null;
  }

  /** Whether the n-th target counted as reached by `time`. */
  isReached(target: number, time: number): boolean {
    const [from, to] = this.targetTimes(target);
    return this.reached.some((at) => at > from && at <= to + ROUNDING && at <= time);
  }
}

/** The flights of a set by their agent and episode. */
export function recordsOf(set: FlightSet, pack: ReportPack): FlightRecord[] {
  const isMission = isOfMissions(set);
  return set.flights.map((flight) => new FlightRecord(flight, pack, isMission));
}
