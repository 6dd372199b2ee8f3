// SPDX-License-Identifier: Apache-2.0
// A low-poly fighter of about the F-16's size (49 ft long), in parts, so that its surfaces move.
// Body axes as in frames.ts, feet, the origin near the centre of gravity.
import { BufferGeometry, Float32BufferAttribute, Vector3 } from 'three';
import type { Surfaces } from './record';

/** Of the model, without the rails at its tips. */
export const SPAN_FT = 30;

type Point = [x: number, y: number, z: number];

/** Flat-shaded triangles. */
class Mesh {
  private readonly positions: number[] = [];
  private readonly colours: number[] = [];

  triangle(a: Point, b: Point, c: Point, shade: number): void {
    this.positions.push(...a, ...b, ...c);
    for (let i = 0; i < 9; i += 1) this.colours.push(shade);
  }

  quad(a: Point, b: Point, c: Point, d: Point, shade: number): void {
    this.triangle(a, b, c, shade);
    this.triangle(a, c, d, shade);
  }

  /** A thin plate by its outline, and its underside. */
  plate(outline: Point[], thickness: Point, shade: number): void {
    const top = outline.map((p) => p.map((v, i) => v + thickness[i] / 2) as Point);
    const bottom = outline.map((p) => p.map((v, i) => v - thickness[i] / 2) as Point);
    for (let i = 1; i + 1 < outline.length; i += 1) {
      this.triangle(top[0], top[i], top[i + 1], shade);
      this.triangle(bottom[0], bottom[i + 1], bottom[i], shade);
    }
    outline.forEach((_, i) => {
      const next = (i + 1) % outline.length;
      this.quad(top[i], bottom[i], bottom[next], top[next], shade);
    });
  }

  /** A body of elliptic sections along z. */
  hull(sections: { z: number; y: number; width: number; height: number }[], shade: number): void {
    const sides = 10;
    const ring = (k: number): Point[] => Array.from({ length: sides }, (_, i) => {
      const angle = (2 * Math.PI * i) / sides;
      const { z, y, width, height } = sections[k];
      return [(width / 2) * Math.sin(angle), y + (height / 2) * Math.cos(angle), z];
    });
    for (let k = 0; k + 1 < sections.length; k += 1) {
      const [front, back] = [ring(k), ring(k + 1)];
      for (let i = 0; i < sides; i += 1) {
        const j = (i + 1) % sides;
        this.quad(front[i], front[j], back[j], back[i], shade);
      }
    }
  }

  geometry(): BufferGeometry {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new Float32BufferAttribute(this.positions, 3));
    geometry.setAttribute('color', new Float32BufferAttribute(this.colours, 3));
    geometry.computeVertexNormals();
    return geometry;
  }
}

/** A part of the aircraft: fixed, or turning about a hinge. */
export interface Part {
  geometry: BufferGeometry;
  /** A point of the hinge, and its direction: a positive angle lowers the trailing edge (turns it
   * left, of the rudder). */
  hinge: Vector3;
  axis: Vector3;
  /** Its angle, degrees, by the values of the recorded surfaces. */
  angle: (surfaces: Surfaces) => number;
  isTinted: boolean;
}

const BODY = 0.82;
const DARK = 0.3;

function part(
  build: (mesh: Mesh) => void, hinge: Point = [0, 0, 0], axis: Point = [1, 0, 0],
  angle: Part['angle'] = () => 0, isTinted = false,
): Part {
  const mesh = new Mesh();
  build(mesh);
  return {
    geometry: mesh.geometry(), hinge: new Vector3(...hinge),
    axis: new Vector3(...axis).normalize(), angle, isTinted,
  };
}

function fuselage(mesh: Mesh): void {
  mesh.hull([
    { z: -28, y: 0, width: 0.1, height: 0.1 }, { z: -24, y: 0.1, width: 2, height: 1.9 },
    { z: -18, y: 0.2, width: 3.6, height: 3.4 }, { z: -11, y: 0.1, width: 4.6, height: 4.4 },
    { z: -4, y: -0.2, width: 6.4, height: 5 }, { z: 6, y: -0.1, width: 6.6, height: 4.6 },
    { z: 14, y: 0, width: 4.8, height: 4.2 }, { z: 18.5, y: 0, width: 3.2, height: 3.2 },
  ], BODY);
  mesh.hull([{ z: 18.5, y: 0, width: 3.2, height: 3.2 }, { z: 18.6, y: 0, width: 0.1, height: 0.1 }],
    DARK);
  // The intake under the cockpit.
  mesh.hull([
    { z: -13, y: -2.3, width: 4.2, height: 2.4 }, { z: -2, y: -2, width: 4.6, height: 2.6 },
    { z: 6, y: -1.2, width: 4, height: 2 },
  ], 0.62);
}

function canopy(mesh: Mesh): void {
  mesh.hull([
    { z: -20, y: 1.6, width: 0.3, height: 0.2 }, { z: -17, y: 2.1, width: 2.3, height: 2.2 },
    { z: -13.5, y: 2.2, width: 2.5, height: 2.8 }, { z: -8, y: 1.9, width: 1.2, height: 1.2 },
  ], 0.16);
}

/** Of side 1 (right) or -1 (left): wing without its moving edges, strake, and ventral fin. */
function wing(mesh: Mesh, side: number): void {
  const thickness: Point = [0, 0.45, 0];
  mesh.plate([[2.6 * side, 0, -5.6], [14.6 * side, 0, 2.5], [14.6 * side, 0, 5.2],
    [2.6 * side, 0, 6]], thickness, BODY);
  mesh.plate([[1.4 * side, 0.2, -15], [3 * side, 0.1, -6], [3 * side, 0, 0], [1.4 * side, 0, 0]],
    thickness, BODY);
  mesh.plate([[2 * side, -1.6, 10], [3 * side, -4, 12], [3 * side, -4, 14.5], [2 * side, -1.6, 15]],
    [0.3, 0, 0], 0.7);
}

/** The rails at the wing tips. */
function tips(mesh: Mesh): void {
  for (const side of [1, -1]) {
    mesh.plate([[14.5 * side, 0, 0], [15.3 * side, 0, 1], [15.3 * side, 0, 8], [14.5 * side, 0, 8]],
      [0, 0.7, 0], 1);
  }
}

function fin(mesh: Mesh): void {
  mesh.plate([[0, 1.6, 5], [0, 10.6, 14], [0, 10.6, 16.4], [0, 2, 15]], [0.5, 0, 0], BODY);
}

function flaperon(side: number): Part {
  return part((mesh) => mesh.plate([[3.4 * side, 0, 5.95], [11 * side, 0, 5.45],
    [11 * side, 0, 8], [3.4 * side, 0, 8.6]], [0, 0.35, 0], 0.72),
  [3.4 * side, 0, 5.95], [1, 0, 0],
  // Aileron + rolls left: the right one goes down, the left one up.
  (surfaces) => side * surfaces.aileron);
}

function leadingEdgeFlap(side: number): Part {
  return part((mesh) => mesh.plate([[3 * side, 0, -7.1], [14.6 * side, 0, 1.3],
    [14.6 * side, 0, 2.5], [3 * side, 0, -5.4]], [0, 0.35, 0], 0.72),
  [8.8 * side, 0, -1.5], [11.6, 0, side * 7.9],
  (surfaces) => -surfaces.leadingEdgeFlap);
}

function stabilator(side: number): Part {
  return part((mesh) => mesh.plate([[2.2 * side, 0, 11], [9.2 * side, -0.9, 16],
    [9.2 * side, -0.9, 18.6], [2.2 * side, 0, 18.6]], [0, 0.4, 0], 0.76),
  [2.2 * side, 0, 15.5], [1, 0, 0],
  (surfaces) => surfaces.elevator);
}

function rudder(): Part {
  return part((mesh) => mesh.plate([[0, 2.6, 15.05], [0, 10, 16.3], [0, 10, 18.4],
    [0, 2.6, 17.6]], [0.35, 0, 0], 0.72),
  [0, 2.6, 15.05], [0, -7.4, -1.25],
  (surfaces) => surfaces.rudder);
}

/** The model; tinted parts take the agent's colour. */
export function aircraftParts(): Part[] {
  const both = [1, -1];
  return [
    part(fuselage), part(canopy),
    part((mesh) => both.forEach((side) => wing(mesh, side))),
    part((mesh) => {
      fin(mesh);
      tips(mesh);
    }, [0, 0, 0], [1, 0, 0], () => 0, true),
    ...both.map(flaperon), ...both.map(leadingEdgeFlap), ...both.map(stabilator), rudder(),
  ];
}

/** What is seen of it from afar, of a few triangles. */
export function farAircraft(): BufferGeometry {
  const mesh = new Mesh();
  const [nose, tail, top]: Point[] = [[0, 0, -28], [0, 0, 18], [0, 2.6, -2]];
  for (const side of [1, -1]) {
    const flank: Point = [3.3 * side, -0.8, 2];
    mesh.triangle(nose, flank, top, BODY);
    mesh.triangle(top, flank, tail, BODY);
    mesh.triangle(nose, tail, flank, 0.62);
    mesh.triangle([2.6 * side, 0, -6], [15 * side, 0, 4], [2.6 * side, 0, 7], BODY);
    mesh.triangle([1.5 * side, 0, 11], [9 * side, -0.6, 18], [1.5 * side, 0, 18], 0.72);
  }
  mesh.triangle([0, 1.5, 5], [0, 10.6, 17], [0, 1.5, 17], 1);
  return mesh.geometry();
}
