// SPDX-License-Identifier: Apache-2.0
// The flights of an episode, or of all, in space.
import {
  AmbientLight, Box3, BufferGeometry, Color, DirectionalLight, Float32BufferAttribute,
  LineBasicMaterial, LineSegments, Scene, Vector3, WebGLRenderer,
} from 'three';
import { colourOf, styleColour } from '../palette';
import type { FlightSet } from '../report';
import { SPAN_FT } from './aircraft';
import { Cameras, type CameraName } from './cameras';
import { Fleet } from './fleet';
import { Ghosts } from './ghosts';
import { Goal, recordsWithGoal } from './goal';
import { type Ground, makeGround, windArrow } from './ground';
import { Ladder } from './ladder';
import { type FlightRecord, Pose } from './record';
import { type Colouring, Trails } from './trails';
import { commonWind } from './wind';

/** An aircraft is drawn at least so large, as a share of its distance; of many smaller. */
const LEAST_SIZE = 0.03;
const LEAST_SIZE_OF_MANY = 0.012;
export const MANY = 60;
/** Of many, those are outlines that are no larger than that share of their distance. */
const FAR_SIZE = 0.02;
/** Of more agents' own targets none is shown. */
const MOST_GOALS = 40;

export class FlightScene {
  readonly scene = new Scene();
  readonly cameras: Cameras;
  readonly ground: Ground;
  private readonly fleet: Fleet;
  private readonly ghosts: Ghosts;
  private readonly ladder = new Ladder(styleColour('--accent'));
  private readonly trails: Trails;
  private readonly goals: Goal[] = [];
  private readonly stems: LineSegments;
  private readonly pose = new Pose();
  private readonly leastSize: number;
  private readonly spanFt: number;

  /** `followed` is the index of the record that cameras go with. */
  constructor(
    readonly records: FlightRecord[], set: FlightSet, element: HTMLElement, public followed: number,
  ) {
    const colours = records.map((record) => colourOf(record.agent));
    this.spanFt = set.span_ft;
    this.leastSize = records.length > MANY ? LEAST_SIZE_OF_MANY : LEAST_SIZE;
    const way = this.way();
    const box = new Box3().setFromPoints(way);
    this.addGoals(set, box);
    this.ground = makeGround(box, styleColour('--scene-grid'), styleColour('--muted'));
    this.fleet = new Fleet(colours);
    this.ghosts = new Ghosts(records, (record) => colourOf(record.agent));
    this.trails = new Trails(records, colours);
    this.stems = this.makeStems();
    this.scene.background = new Color(styleColour('--sky'));
    this.scene.add(new AmbientLight('#ffffff', 1.5), this.ground.group, this.fleet.group,
      this.trails.group, this.stems, this.ghosts.group, this.ladder.group,
      ...this.goals.map((goal) => goal.group));
    const sun = new DirectionalLight('#ffffff', 2.2);
    sun.position.set(0.5, 1, 0.3);
    this.scene.add(sun);
    const wind = commonWind(records);
    if (wind) this.scene.add(windArrow(wind, this.ground, box, styleColour('--target')));
    this.cameras = new Cameras(element, [way[0], ...this.goals.flatMap((g) => g.places()), ...way],
      this.size);
  }

  /** How much larger than its model the aircraft is. */
  private get size(): number {
    return this.spanFt / SPAN_FT;
  }

  private addGoals(set: FlightSet, box: Box3): void {
    const { own, isShared } = recordsWithGoal(set, this.records);
    if (!isShared && own.length > MOST_GOALS) return;
    for (const record of own) {
      const colour = isShared ? styleColour('--target') : colourOf(record.agent);
      const goal = new Goal(record, set.targets, set.is_point, colour);
      goal.places().forEach((point) => box.expandByPoint(point));
      this.goals.push(goal);
    }
  }

  /** Places along all flights, the followed one's last. */
  private way(): Vector3[] {
    const followed = this.records[this.followed];
    const others = this.records.filter((record) => record !== followed);
    const points = [followed.place(0, new Vector3())];
    for (const record of [...others, followed]) {
      const step = Math.max(record.duration / 40, record.interval);
      for (let time = 0; time <= record.duration; time += step) {
        points.push(record.place(time, new Vector3()));
      }
    }
    return points;
  }

  /** From every aircraft down to the grid, so that height is seen. */
  private makeStems(): LineSegments {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position',
      new Float32BufferAttribute(new Float32Array(6 * this.records.length), 3));
    const lines = new LineSegments(geometry, new LineBasicMaterial({
      color: new Color(styleColour('--muted')), transparent: true, opacity: 0.5,
    }));
    lines.frustumCulled = false;
    lines.visible = this.records.length <= MOST_GOALS;
    return lines;
  }

  colourTrails(colouring: Colouring): void {
    this.trails.colour(colouring);
  }

  choose(name: CameraName, time: number): void {
    const record = this.records[this.followed];
    this.cameras.choose(name, record.place(time, this.pose.place),
      record.attitude(time, this.pose.attitude));
  }

  /** How much larger than its model an aircraft is drawn so far from the camera. */
  private readonly scaleAt = (at: Vector3): number =>
    Math.max(this.size, (at.distanceTo(this.cameras.camera.position) * this.leastSize) / SPAN_FT);

  /** Everything as it is at `time`. */
  update(time: number, trail: number, seconds: number): void {
    const { pose, cameras } = this;
    const record = this.records[this.followed];
    cameras.follow(record.place(time, pose.place), record.attitude(time, pose.attitude), seconds);
    const reach = cameras.camera.position.distanceTo(pose.place);
    this.showAircraft(time);
    this.ghosts.show(time, this.scaleAt);
    const isInside = cameras.chosen === 'cockpit';
    this.ladder.group.visible = isInside;
    if (isInside) this.ladder.show(record, time, cameras.camera.position);
    // From behind an aircraft one would look through its ribbon.
    const isBehind = cameras.chosen === 'chase' || isInside;
    this.trails.show(time, trail,
      isBehind ? 2 * this.size : Math.max(10 * this.size, reach * 0.006));
    for (const goal of this.goals) goal.show(time, Math.max(150, reach * 0.25));
  }

  private showAircraft(time: number): void {
    const { pose, cameras, records } = this;
    const hidden = cameras.chosen === 'cockpit' ? this.followed : -1;
    const stems = this.stems.geometry.getAttribute('position');
    this.fleet.begin();
    for (let i = 0; i < records.length; i += 1) {
      if (i === hidden) continue;
      records[i].pose(time, pose);
      const scale = this.scaleAt(pose.place);
      const size = (scale * SPAN_FT) / pose.place.distanceTo(cameras.camera.position);
      this.fleet.add(i, pose, scale, records.length > MANY && size < FAR_SIZE);
      stems.setXYZ(2 * i, pose.place.x, pose.place.y, pose.place.z);
      stems.setXYZ(2 * i + 1, pose.place.x, this.ground.altitudeFt, pose.place.z);
    }
    stems.needsUpdate = this.stems.visible;
    this.fleet.commit();
  }

  render(renderer: WebGLRenderer): void {
    renderer.render(this.scene, this.cameras.camera);
  }

  dispose(): void {
    this.cameras.dispose();
    this.fleet.dispose();
    this.ghosts.dispose();
    this.ladder.dispose();
    this.trails.dispose();
  }
}
