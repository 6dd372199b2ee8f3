// SPDX-License-Identifier: Apache-2.0
// What an episode asks for, with its tolerances: a point with its box, or the direction in which
// the aircraft should fly, at the altitude it should have.
import {
  BoxGeometry, BufferGeometry, Color, DoubleSide, EdgesGeometry, Float32BufferAttribute, Group,
  Line, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Vector3,
} from 'three';
import type { Target } from '../report';
import { direction, place } from './frames';
import type { FlightRecord } from './record';

export class Goal {
  readonly group = new Group();
  private readonly tolerance = new Map<string, number>();
  private readonly stem: Line | null = null;
  private readonly fan: Mesh | null = null;
  private readonly centre: LineSegments | null = null;

  constructor(
    private readonly record: FlightRecord, targets: Target[], private readonly isPoint: boolean,
    private readonly colour: string,
  ) {
    for (const target of targets) this.tolerance.set(target.column, target.tolerance);
    if (isPoint) {
      this.addBox();
      return;
    }
    this.stem = new Line(new BufferGeometry(), this.line(0.6));
    this.fan = new Mesh(new BufferGeometry(), this.face(0.14));
    this.centre = new LineSegments(new BufferGeometry(), this.line(1));
    for (const object of [this.stem, this.fan, this.centre]) {
      object.frustumCulled = false;
      this.group.add(object);
    }
  }

  private line(opacity: number): LineBasicMaterial {
    return new LineBasicMaterial({ color: new Color(this.colour), transparent: true, opacity });
  }

  private face(opacity: number): MeshBasicMaterial {
    return new MeshBasicMaterial({
      color: new Color(this.colour), transparent: true, opacity, side: DoubleSide, depthWrite: false,
    });
  }

  private half(column: string): number {
    return this.tolerance.get(column) ?? 0;
  }

  private targetPoint(time: number): Vector3 {
    return place(this.record.value('target_north_ft', time),
      this.record.value('target_east_ft', time), this.record.value('target_altitude_ft', time));
  }

  private addBox(): void {
    const box = new BoxGeometry(2 * this.half('east_ft'), 2 * this.half('altitude_ft'),
      2 * this.half('north_ft'));
    this.group.add(new Mesh(box, this.face(0.25)),
      new LineSegments(new EdgesGeometry(box), this.line(1)));
    // A cross that is seen from afar.
    const reach = 8 * this.half('east_ft');
    const cross = new BufferGeometry();
    cross.setAttribute('position', new Float32BufferAttribute([
      -reach, 0, 0, reach, 0, 0, 0, -reach, 0, 0, reach, 0, 0, 0, -reach, 0, 0, reach], 3));
    this.group.add(new LineSegments(cross, this.line(0.8)));
  }

  /** As it is at a time; `length` feet is how far a direction is drawn. */
  show(time: number, length: number): void {
    if (this.isPoint) {
      this.group.position.copy(this.targetPoint(time));
      return;
    }
    const at = this.record.place(time, new Vector3());
    const from = at.clone();
    const isLevel = this.record.has('target_altitude_ft');
    if (isLevel) from.y = this.record.value('target_altitude_ft', time);
    const yaw = this.record.value('target_yaw_deg', time);
    const climb = isLevel ? 0 : this.record.value('target_pitch_deg', time);
    const ray = (dYaw: number, dClimb: number, rise: number) =>
      direction(yaw + dYaw, climb + dClimb).multiplyScalar(length).add(from)
        .add(new Vector3(0, rise, 0));
    const [wide, high] = [this.half('yaw_deg'), isLevel ? 0 : this.half('pitch_deg')];
    const rise = this.half('altitude_ft');
    const up = new Vector3(0, rise, 0);
    const corners = [ray(-wide, -high, -rise), ray(wide, -high, -rise), ray(wide, high, rise),
      ray(-wide, high, rise)];
    const [low, top] = [from.clone().sub(up), from.clone().add(up)];
    const faces = [low, corners[0], corners[1], top, corners[2], corners[3],
      low, corners[0], corners[3], low, corners[3], top,
      low, corners[1], corners[2], low, corners[2], top];
    this.fan?.geometry.setFromPoints(faces);
    const edges = corners.flatMap((corner, i) => [corner, corners[(i + 1) % 4]]);
    this.centre?.geometry.setFromPoints([from, ray(0, 0, 0), ...edges]);
    this.stem?.geometry.setFromPoints([at, from]);
  }

  /** Places that belong to it, which should be in view. */
  places(): Vector3[] {
    if (this.isPoint) return [this.targetPoint(0)];
    if (!this.record.has('target_altitude_ft')) return [];
    const at = this.record.place(0, new Vector3());
    return [at.setY(this.record.value('target_altitude_ft', 0))];
  }
}
