// SPDX-License-Identifier: Apache-2.0
// What an episode asks for, with its tolerances: a point with its box, or the direction in which
// the aircraft should fly, at the altitude it should have.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, DoubleSide, EdgesGeometry,
  Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh, MeshBasicMaterial, Vector3,
} from 'three';
import type { FlightSet, Target } from '../report';
import { direction, place } from './frames';
import type { FlightRecord } from './record';

/** Places that change with time, drawn without new memory for every frame. */
class Places {
  readonly geometry = new BufferGeometry();
  private readonly attribute: BufferAttribute;

  constructor(count: number) {
    this.attribute = new BufferAttribute(new Float32Array(3 * count), 3);
    this.geometry.setAttribute('position', this.attribute);
  }

  set(points: readonly Vector3[]): void {
    points.forEach((point, i) => this.attribute.setXYZ(i, point.x, point.y, point.z));
    this.attribute.needsUpdate = true;
  }
}

/** What an aircraft should fly to: a wedge as wide as the tolerances, with a line in its middle. */
class Wedge {
  readonly group = new Group();
  private readonly points = Array.from({ length: 8 }, () => new Vector3());
  private readonly faces = new Places(18);
  private readonly edges = new Places(12);
  private readonly facePoints: Vector3[];
  private readonly edgePoints: Vector3[];

  constructor(face: MeshBasicMaterial, line: LineBasicMaterial) {
    const [at, from, low, top, a, b, c, d] = this.points;
    const tip = new Vector3();
    this.points.push(tip);
    this.facePoints = [low, a, b, top, c, d, low, a, d, low, d, top, low, b, c, low, c, top];
    this.edgePoints = [from, tip, a, b, b, c, c, d, d, a, at, from];
    for (const object of [new Mesh(this.faces.geometry, face),
      new LineSegments(this.edges.geometry, line)]) {
      object.frustumCulled = false;
      this.group.add(object);
    }
  }

  /** From above or below the aircraft at `at`, `length` feet long. */
  show(at: Vector3, altitude: number, yaw: number, climb: number, half: Half, length: number): void {
    const [foot, from, low, top, a, b, c, d, tip] = this.points;
    foot.copy(at);
    from.copy(at).setY(altitude);
    low.copy(from).setY(altitude - half.rise);
    top.copy(from).setY(altitude + half.rise);
    const ray = (point: Vector3, dYaw: number, dClimb: number, rise: number) => {
      direction(yaw + dYaw, climb + dClimb, point).multiplyScalar(length).add(from);
      point.y += rise;
    };
    ray(tip, 0, 0, 0);
    ray(a, -half.yaw, -half.climb, -half.rise);
    ray(b, half.yaw, -half.climb, -half.rise);
    ray(c, half.yaw, half.climb, half.rise);
    ray(d, -half.yaw, half.climb, half.rise);
    this.faces.set(this.facePoints);
    this.edges.set(this.edgePoints);
  }
}

/** Half the widths of a wedge: degrees, and feet. */
interface Half {
  yaw: number;
  climb: number;
  rise: number;
}

/** A cross of three lines, each `reach` feet to both sides. */
function crossAt(at: Vector3, reach: number): number[] {
  return [[reach, 0, 0], [0, reach, 0], [0, 0, reach]].flatMap(([x, y, z]) =>
    [at.x - x, at.y - y, at.z - z, at.x + x, at.y + y, at.z + z]);
}

/** Those of the records whose targets are shown in space, of tasks that have a place or a heading as
 * target: of points one an episode, as all agents fly to it, but for missions; of directions
 * everyone's. */
export function recordsWithGoal(
  { is_point: isPoint, targets }: FlightSet, records: FlightRecord[],
): { own: FlightRecord[]; isShared: boolean } {
  const isShared = isPoint && records.every((record) => record.newTargets.length === 0);
  if (!isPoint && !targets.some(({ column }) => column === 'yaw_deg')) return { own: [], isShared };
  if (!isShared) return { own: records, isShared };
  return { isShared, own: records.filter((record, i) =>
    records.findIndex((other) => other.episode === record.episode) === i) };
}

export class Goal {
  readonly group = new Group();
  private readonly tolerance = new Map<string, number>();
  private readonly box = new Group();
  private readonly wedge: Wedge | null = null;
  private readonly at = new Vector3();
  private readonly half: Half;
  private readonly isLevel: boolean;

  constructor(
    private readonly record: FlightRecord, targets: Target[], private readonly isPoint: boolean,
    private readonly colour: string,
  ) {
    for (const target of targets) this.tolerance.set(target.column, target.tolerance);
    this.isLevel = record.has('target_altitude_ft');
    this.half = {
      yaw: this.halfOf('yaw_deg'), climb: this.isLevel ? 0 : this.halfOf('pitch_deg'),
      rise: this.halfOf('altitude_ft'),
    };
    if (isPoint) {
      this.addBox();
      this.addOthers();
      return;
    }
    this.wedge = new Wedge(this.face(0.14), this.line(1));
    this.group.add(this.wedge.group);
  }

  private line(opacity: number): LineBasicMaterial {
    return new LineBasicMaterial({ color: new Color(this.colour), transparent: true, opacity });
  }

  private face(opacity: number): MeshBasicMaterial {
    return new MeshBasicMaterial({
      color: new Color(this.colour), transparent: true, opacity, side: DoubleSide, depthWrite: false,
    });
  }

  private halfOf(column: string): number {
    return this.tolerance.get(column) ?? 0;
  }

  private targetPoint(time: number, out = new Vector3()): Vector3 {
    return place(this.record.drawn('target_north_ft', time),
      this.record.drawn('target_east_ft', time), this.record.drawn('target_altitude_ft', time),
      out);
  }

  /** All points of a mission that its rows know, of an episode its only one. */
  private allPoints(): Vector3[] {
    return Array.from({ length: this.record.newTargets.length + 1 }, (_, i) =>
      this.record.lastRowTime(i))
      .filter((time) => time !== null)
      .map((time) => this.targetPoint(time));
  }

  private addBox(): void {
    const box = new BoxGeometry(2 * this.halfOf('east_ft'), 2 * this.halfOf('altitude_ft'),
      2 * this.halfOf('north_ft'));
    // A cross that is seen from afar.
    const cross = new BufferGeometry();
    cross.setAttribute('position', new Float32BufferAttribute(
      crossAt(new Vector3(), 8 * this.halfOf('east_ft')), 3));
    this.box.add(new Mesh(box, this.face(0.25)), new LineSegments(new EdgesGeometry(box), this.line(1)),
      new LineSegments(cross, this.line(0.8)));
    this.group.add(this.box);
  }

  /** Of a mission the other targets, faint, with the way from one to the next. */
  private addOthers(): void {
    const points = this.allPoints();
    if (points.length < 2) return;
    const ways = points.slice(1).flatMap((point, i) => [...points[i].toArray(), ...point.toArray()]);
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(
      [...points.flatMap((point) => crossAt(point, 5 * this.halfOf('east_ft'))), ...ways], 3));
    this.group.add(new LineSegments(geometry, this.line(0.3)));
  }

  /** As it is at a time; `length` feet is how far a direction is drawn. */
  show(time: number, length: number): void {
    const { record } = this;
    if (this.isPoint) {
      this.targetPoint(time, this.box.position);
      return;
    }
    record.place(time, this.at);
    this.wedge?.show(this.at, this.isLevel ? record.drawn('target_altitude_ft', time) : this.at.y,
      record.drawn('target_yaw_deg', time),
      this.isLevel ? 0 : record.drawn('target_pitch_deg', time), this.half, length);
  }

  /** Places that belong to it, which should be in view. */
  places(): Vector3[] {
    if (this.isPoint) return this.allPoints();
    if (!this.isLevel) return [];
    const at = this.record.place(0, new Vector3());
    return [at.setY(this.record.drawn('target_altitude_ft', 0))];
  }
}
