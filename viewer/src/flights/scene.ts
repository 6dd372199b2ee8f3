// SPDX-License-Identifier: Apache-2.0
// The flights of an episode, or of all, in space.
import {
  AmbientLight, Box3, BufferGeometry, Color, DirectionalLight, Float32BufferAttribute,
  LineBasicMaterial, LineSegments, Quaternion, Scene, Vector3, WebGLRenderer,
} from 'three';
import { colourOf, styleColour } from '../palette';
import type { FlightSet } from '../report';
import { Cameras, type CameraName } from './cameras';
import { Fleet, surfacesOf } from './fleet';
import { Goal } from './goal';
import { type Ground, makeGround, windArrow } from './ground';
import type { FlightRecord } from './record';
import { type Colouring, Trails } from './trails';

/** An aircraft is drawn at least so large, as a share of its distance. */
const LEAST_SIZE = 0.03;
const SPAN_FT = 31;

export class FlightScene {
  readonly scene = new Scene();
  readonly cameras: Cameras;
  readonly ground: Ground;
  private readonly fleet: Fleet;
  private readonly trails: Trails;
  private readonly goals: Goal[] = [];
  private readonly stems: LineSegments;
  private readonly pose = { place: new Vector3(), attitude: new Quaternion(), scale: 1 };

  /** `followed` is the index of the record that cameras go with. */
  constructor(
    readonly records: FlightRecord[], set: FlightSet, element: HTMLElement, public followed: number,
  ) {
    const colours = records.map((record) => colourOf(record.agent));
    const way = this.way();
    const box = new Box3().setFromPoints(way);
    const goalRecords = records.filter((record, i) =>
      records.findIndex((other) => other.episode === record.episode) === i);
    const few = records.length <= 40;
    for (const record of set.is_point || few ? (set.is_point ? goalRecords : records) : []) {
      const colour = set.is_point ? styleColour('--target') : colourOf(record.agent);
      const goal = new Goal(record, set.targets, set.is_point, colour);
      goal.places().forEach((point) => box.expandByPoint(point));
      this.goals.push(goal);
    }
    this.ground = makeGround(box, styleColour('--scene-grid'), styleColour('--muted'));
    this.fleet = new Fleet(colours);
    this.trails = new Trails(records, colours);
    this.stems = this.makeStems();
    this.scene.background = new Color(styleColour('--sky'));
    this.scene.add(new AmbientLight('#ffffff', 1.5), this.ground.group, this.fleet.group,
      this.trails.group, this.stems, ...this.goals.map((goal) => goal.group));
    const sun = new DirectionalLight('#ffffff', 2.2);
    sun.position.set(0.5, 1, 0.3);
    this.scene.add(sun);
    const first = records[0];
    const wind = new Vector3(first.value('wind_east_fps', 0), -first.value('wind_down_fps', 0),
      -first.value('wind_north_fps', 0));
    const arrow = windArrow(wind, this.ground, box, styleColour('--target'));
    if (arrow) this.scene.add(arrow);
    this.cameras = new Cameras(element, [way[0], ...this.goals.flatMap((g) => g.places()), ...way]);
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
    lines.visible = this.records.length <= 40;
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

  /** Everything as it is at `time`. */
  update(time: number, trail: number, seconds: number): void {
    const { pose } = this;
    const record = this.records[this.followed];
    this.cameras.follow(record.place(time, pose.place), record.attitude(time, pose.attitude), seconds);
    const { camera } = this.cameras;
    const stems = this.stems.geometry.getAttribute('position');
    this.records.forEach((flight, i) => {
      flight.place(time, pose.place);
      flight.attitude(time, pose.attitude);
      const distance = pose.place.distanceTo(camera.position);
      pose.scale = Math.max(1, (distance * LEAST_SIZE) / SPAN_FT);
      if (this.cameras.chosen === 'cockpit' && i === this.followed) pose.scale = 0;
      this.fleet.set(i, pose, surfacesOf(flight, time));
      stems.setXYZ(2 * i, pose.place.x, pose.place.y, pose.place.z);
      stems.setXYZ(2 * i + 1, pose.place.x, this.ground.altitudeFt, pose.place.z);
    });
    stems.needsUpdate = true;
    this.fleet.commit();
    const reach = camera.position.distanceTo(record.place(time, pose.place));
    // From behind an aircraft one would look through its ribbon.
    const isBehind = this.cameras.chosen === 'chase' || this.cameras.chosen === 'cockpit';
    this.trails.show(time, trail, isBehind ? 2 : Math.max(10, reach * 0.006));
    for (const goal of this.goals) goal.show(time, Math.max(150, reach * 0.25));
  }

  render(renderer: WebGLRenderer): void {
    renderer.render(this.scene, this.cameras.camera);
  }

  dispose(): void {
    this.cameras.dispose();
    this.fleet.dispose();
    this.trails.dispose();
  }
}
