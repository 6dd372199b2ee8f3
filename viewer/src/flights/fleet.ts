// SPDX-License-Identifier: Apache-2.0
// All aircraft of a scene, a draw call for each part of the model, and one for those that are small.
import {
  BufferGeometry, Color, DoubleSide, Group, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion,
  Vector3,
} from 'three';
import { aircraftParts, farAircraft, type Part } from './aircraft';
import type { Pose } from './record';

const RAD = Math.PI / 180;
const WHITE = new Color('#ffffff');

/** Instances of one geometry: those that are shown come first. */
class Instances {
  readonly mesh: InstancedMesh;
  private readonly tints: Float32Array;

  constructor(geometry: BufferGeometry, material: MeshLambertMaterial, colours: Color[]) {
    this.mesh = new InstancedMesh(geometry, material, Math.max(colours.length, 1));
    this.mesh.frustumCulled = false;
    colours.forEach((colour, i) => this.mesh.setColorAt(i, colour));
    this.tints = new Float32Array(3 * colours.length);
    colours.forEach((colour, i) => colour.toArray(this.tints, 3 * i));
  }

  set(slot: number, aircraft: number, matrix: Matrix4): void {
    this.mesh.setMatrixAt(slot, matrix);
    const colours = this.mesh.instanceColor?.array as Float32Array;
    for (let k = 0; k < 3; k += 1) colours[3 * slot + k] = this.tints[3 * aircraft + k];
  }

  show(count: number): void {
    this.mesh.count = count;
    this.mesh.visible = count > 0;
    this.mesh.instanceMatrix.needsUpdate = true;
    if (this.mesh.instanceColor) this.mesh.instanceColor.needsUpdate = true;
  }

  dispose(): void {
    this.mesh.geometry.dispose();
    this.mesh.dispose();
  }
}

export class Fleet {
  readonly group = new Group();
  private readonly parts: { part: Part; instances: Instances }[];
  private readonly far: Instances;
  private readonly material: MeshLambertMaterial;
  private nearCount = 0;
  private farCount = 0;
  private readonly whole = new Matrix4();
  private readonly turned = new Matrix4();
  private readonly turn = new Quaternion();
  private readonly arm = new Vector3();
  private readonly one = new Vector3(1, 1, 1);
  private readonly size = new Vector3();

  /** `colours` of the aircraft, in their order; `opacity` below 1 makes them ghosts. */
  constructor(colours: string[], opacity = 1) {
    this.material = new MeshLambertMaterial({
      vertexColors: true, side: DoubleSide, transparent: opacity < 1, opacity,
      depthWrite: opacity === 1,
    });
    const own = colours.map((colour) => new Color(colour));
    const pale = own.map((colour) => WHITE.clone().lerp(colour, opacity < 1 ? 1 : 0.35));
    this.parts = aircraftParts().map((part) => ({
      part, instances: new Instances(part.geometry, this.material, part.isTinted ? own : pale),
    }));
    this.far = new Instances(farAircraft(), this.material,
      own.map((colour) => WHITE.clone().lerp(colour, 0.7)));
    this.group.add(this.far.mesh, ...this.parts.map(({ instances }) => instances.mesh));
  }

  /** Before the aircraft of a frame. */
  begin(): void {
    this.nearCount = 0;
    this.farCount = 0;
  }

  /** Shows an aircraft, `scale` times as large as its model; from afar by its outline alone. */
  add(aircraft: number, pose: Pose, scale: number, isFar: boolean): void {
    this.whole.compose(pose.place, pose.attitude, this.size.setScalar(scale));
    if (isFar) {
      this.far.set(this.farCount, aircraft, this.whole);
      this.farCount += 1;
      return;
    }
    for (const { part, instances } of this.parts) {
      const angle = part.angle(pose.surfaces);
      instances.set(this.nearCount, aircraft, angle === 0 ? this.whole : this.hinged(part, angle));
    }
    this.nearCount += 1;
  }

  /** The aircraft's matrix with a turn about the part's hinge: to it and back. */
  private hinged(part: Part, angle: number): Matrix4 {
    this.turn.setFromAxisAngle(part.axis, angle * RAD);
    this.arm.copy(part.hinge).applyQuaternion(this.turn).negate().add(part.hinge);
    return this.turned.compose(this.arm, this.turn, this.one).premultiply(this.whole);
  }

  commit(): void {
    for (const { instances } of this.parts) instances.show(this.nearCount);
    this.far.show(this.farCount);
  }

  dispose(): void {
    for (const { instances } of this.parts) instances.dispose();
    this.far.dispose();
    this.material.dispose();
  }
}
