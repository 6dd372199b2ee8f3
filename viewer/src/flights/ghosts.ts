// SPDX-License-Identifier: Apache-2.0
// What high-level policies ask for: a translucent aircraft ahead of their own, with the commanded
// pitch and heading, the farther away the faster it should fly.
import {
  BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments, Vector3,
} from 'three';
import { SPAN_FT } from './aircraft';
import { Fleet } from './fleet';
import { attitude, direction } from './frames';
import { type FlightRecord, Pose } from './record';

/** Ahead of its aircraft where the speed is as commanded, in spans. */
const AHEAD = 3;

export function hasCommands(record: FlightRecord): boolean {
  return record.has('command_pitch_deg') && record.has('command_yaw_deg');
}

export class Ghosts {
  readonly group = new Group();
  private readonly records: FlightRecord[];
  private readonly fleet: Fleet;
  private readonly lines: LineSegments;
  private readonly pose = new Pose();
  private readonly at = new Vector3();

  constructor(records: FlightRecord[], colourOf: (record: FlightRecord) => string) {
    this.records = records.filter(hasCommands);
    const colours = this.records.map(colourOf);
    this.fleet = new Fleet(colours, 0.35);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position',
      new BufferAttribute(new Float32Array(6 * this.records.length), 3));
    this.lines = new LineSegments(geometry, new LineBasicMaterial({
      color: new Color(colours[0] ?? '#000000'), transparent: true, opacity: 0.6,
    }));
    this.lines.frustumCulled = false;
    this.group.add(this.fleet.group, this.lines);
    this.group.visible = this.records.length > 0;
  }

  /** As they are at a time; `scaleOf` is how much larger than its model an aircraft at a place is
   * drawn. */
  show(time: number, scaleOf: (place: Vector3) => number): void {
    if (!this.group.visible) return;
    const { pose } = this;
    const ends = this.lines.geometry.getAttribute('position');
    this.fleet.begin();
    this.records.forEach((record, i) => {
      record.place(time, this.at);
      const pitch = record.drawn('command_pitch_deg', time);
      const yaw = record.drawn('command_yaw_deg', time);
      const flown = Math.max(record.drawn('true_airspeed_fps', time), 1);
      const share = record.drawn('command_true_airspeed_fps', time) / flown;
      const scale = scaleOf(this.at);
      direction(yaw, pitch, pose.place).multiplyScalar(AHEAD * SPAN_FT * scale * share).add(this.at);
      attitude(0, pitch, yaw, pose.attitude);
      this.fleet.add(i, pose, scale, false);
      ends.setXYZ(2 * i, this.at.x, this.at.y, this.at.z);
      ends.setXYZ(2 * i + 1, pose.place.x, pose.place.y, pose.place.z);
    });
    this.fleet.commit();
    ends.needsUpdate = true;
  }

  dispose(): void {
    this.fleet.dispose();
    this.lines.geometry.dispose();
  }
}
