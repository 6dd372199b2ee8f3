// SPDX-License-Identifier: Apache-2.0
// The ways flown, as ribbons that lie in the wings' plane, with a line in their middle so that they
// are seen from afar: one draw call each for all aircraft.
import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Group, LineSegments, Mesh, Quaternion,
  ShaderMaterial, Vector3,
} from 'three';
import { ramp } from '../palette';
import type { FlightRecord } from './record';

/** What colours a trail: the share (0 to 1) of a ramp that a row has, or, if null, its agent. */
export type Colouring = (record: FlightRecord, row: number) => number | null;

const VERTEX = /* glsl */ `
attribute vec3 wing;
attribute vec3 tint;
attribute float time;
uniform float width;
varying vec3 vTint;
varying float vTime;
void main() {
  vTint = tint;
  vTime = time;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position + wing * width, 1.0);
}`;

const FRAGMENT = /* glsl */ `
uniform float now;
uniform float length;
uniform float opacity;
uniform float ahead;
varying vec3 vTint;
varying float vTime;
void main() {
  if (vTime < now - length) discard;
  // What is still to come is faint.
  gl_FragColor = vec4(vTint, vTime > now ? opacity * ahead : opacity);
}`;

/** Of more aircraft the lines alone are drawn: they would cover each other, and cost the most. */
const MOST_RIBBONS = 60;
/** Rows of all trails together. */
const MOST_ROWS = 120000;
const MOST_ROWS_OF_MANY = 40000;

interface Uniforms {
  now: { value: number };
  length: { value: number };
  width: { value: number };
}

/** Rows of a record that a trail goes through. */
function rowsOf(record: FlightRecord, most: number): number[] {
  const stride = Math.max(1, Math.ceil(record.rows / most));
  const rows = [];
  for (let row = 0; row < record.rows; row += stride) rows.push(row);
  if (rows[rows.length - 1] !== record.rows - 1) rows.push(record.rows - 1);
  return rows;
}

export class Trails {
  readonly group = new Group();
  private readonly shared: Uniforms = {
    now: { value: 0 }, length: { value: 1e9 }, width: { value: 20 },
  };
  private readonly tints: Float32Array;
  private readonly tintAttribute: BufferAttribute;
  private readonly rows: number[][];
  private readonly geometries: BufferGeometry[] = [];
  private readonly materials: ShaderMaterial[] = [];

  constructor(private readonly records: FlightRecord[], private readonly colours: string[]) {
    const isMany = records.length > MOST_RIBBONS;
    const most = Math.floor((isMany ? MOST_ROWS_OF_MANY : MOST_ROWS) / Math.max(records.length, 1));
    this.rows = records.map((record) => rowsOf(record, Math.min(Math.max(most, 40), 1000)));
    const count = 2 * this.rows.reduce((sum, rows) => sum + rows.length, 0);
    const positions = new Float32Array(3 * count);
    const wings = new Float32Array(3 * count);
    const times = new Float32Array(count);
    this.tints = new Float32Array(3 * count);
    const ribbons: number[] = [];
    const lines: number[] = [];
    const [at, right, attitude] = [new Vector3(), new Vector3(), new Quaternion()];
    let vertex = 0;
    records.forEach((record, i) => this.rows[i].forEach((row, k) => {
      const time = record.timeOf(row);
      record.place(time, at);
      right.set(1, 0, 0).applyQuaternion(record.attitude(time, attitude));
      for (const side of [-1, 1]) {
        at.toArray(positions, 3 * vertex);
        right.clone().multiplyScalar(side).toArray(wings, 3 * vertex);
        times[vertex] = time;
        vertex += 1;
      }
      if (k === 0) return;
      const [a, b, c, d] = [vertex - 4, vertex - 3, vertex - 2, vertex - 1];
      ribbons.push(a, b, c, b, d, c);
      lines.push(a, c);
    }));
    this.tintAttribute = new BufferAttribute(this.tints, 3);
    const attributes = {
      position: new BufferAttribute(positions, 3), wing: new BufferAttribute(wings, 3),
      time: new BufferAttribute(times, 1), tint: this.tintAttribute,
    };
    const geometryOf = (index: number[]) => {
      const geometry = new BufferGeometry();
      for (const [name, value] of Object.entries(attributes)) geometry.setAttribute(name, value);
      geometry.setIndex(index);
      this.geometries.push(geometry);
      return geometry;
    };
    const ribbon = new Mesh(geometryOf(ribbons), this.material(this.shared.width, 0.6, 0));
    ribbon.visible = !isMany;
    const line = new LineSegments(geometryOf(lines), this.material({ value: 0 }, 1, 0.4));
    for (const object of [ribbon, line]) {
      object.frustumCulled = false;
      this.group.add(object);
    }
    this.colour(() => null);
  }

  private material(width: { value: number }, opacity: number, ahead: number): ShaderMaterial {
    const material = new ShaderMaterial({
      uniforms: {
        now: this.shared.now, length: this.shared.length, width, opacity: { value: opacity },
        ahead: { value: ahead },
      },
      vertexShader: VERTEX, fragmentShader: FRAGMENT, side: DoubleSide,
      transparent: true, depthWrite: false,
    });
    this.materials.push(material);
    return material;
  }

  /** Colours every row by the ramp; those of null in their agent's colour. */
  colour(share: Colouring): void {
    let vertex = 0;
    const own = new Color();
    this.records.forEach((record, i) => {
      own.set(this.colours[i]).convertLinearToSRGB();
      for (const row of this.rows[i]) {
        const value = share(record, row);
        const tint = value === null ? own.toArray() : ramp(value);
        for (let side = 0; side < 2; side += 1) {
          this.tints.set(tint, 3 * vertex);
          vertex += 1;
        }
      }
    });
    this.tintAttribute.needsUpdate = true;
  }

  /** What is flown at `now`, over the last `length` seconds; half as wide as `width` feet. */
  show(now: number, length: number, width: number): void {
    this.shared.now.value = now;
    this.shared.length.value = length;
    this.shared.width.value = width;
  }

  dispose(): void {
    this.geometries.forEach((geometry) => geometry.dispose());
    this.materials.forEach((material) => material.dispose());
  }
}
