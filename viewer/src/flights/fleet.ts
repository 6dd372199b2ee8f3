// SPDX-License-Identifier: Apache-2.0
// All aircraft of a scene, a draw call for each part of the model.
import {
  Color, DoubleSide, Group, InstancedMesh, Matrix4, MeshLambertMaterial, Quaternion, Vector3,
} from 'three';
import { aircraftParts, type Part, type Surfaces } from './aircraft';
import type { FlightRecord } from './record';

const RAD = Math.PI / 180;

/** Where an aircraft is drawn. */
export interface Pose {
  place: Vector3;
  attitude: Quaternion;
  scale: number;
}

export function surfacesOf(record: FlightRecord, time: number): Surfaces {
  return {
    elevator: record.value('elevator_deg', time),
    aileron: record.value('aileron_deg', time),
    rudder: record.value('rudder_deg', time),
    leadingEdgeFlap: record.value('leading_edge_flap_deg', time),
  };
}

export class Fleet {
  readonly group = new Group();
  private readonly parts: { part: Part; mesh: InstancedMesh }[];
  private readonly whole = new Matrix4();
  private readonly turned = new Matrix4();
  private readonly turn = new Quaternion();
  private readonly arm = new Vector3();
  private readonly one = new Vector3(1, 1, 1);
  private readonly size = new Vector3();

  /** `colours` of the aircraft, in their order. */
  constructor(colours: string[]) {
    const material = new MeshLambertMaterial({ vertexColors: true, side: DoubleSide });
    this.parts = aircraftParts().map((part) => {
      const mesh = new InstancedMesh(part.geometry, material, Math.max(colours.length, 1));
      mesh.count = colours.length;
      mesh.frustumCulled = false;
      colours.forEach((colour, i) => {
        const own = new Color(colour);
        mesh.setColorAt(i, part.isTinted ? own : new Color('#ffffff').lerp(own, 0.35));
      });
      this.group.add(mesh);
      return { part, mesh };
    });
  }

  /** Shows aircraft `index` so; a scale of 0 hides it. */
  set(index: number, pose: Pose, surfaces: Surfaces): void {
    this.whole.compose(pose.place, pose.attitude, this.size.setScalar(pose.scale));
    for (const { part, mesh } of this.parts) {
      const angle = part.angle(surfaces);
      if (angle === 0) {
        mesh.setMatrixAt(index, this.whole);
        continue;
      }
      // About the hinge: to it and back.
      this.turn.setFromAxisAngle(part.axis, angle * RAD);
      this.arm.copy(part.hinge).applyQuaternion(this.turn).negate().add(part.hinge);
      this.turned.compose(this.arm, this.turn, this.one).premultiply(this.whole);
      mesh.setMatrixAt(index, this.turned);
    }
  }

  commit(): void {
    for (const { mesh } of this.parts) mesh.instanceMatrix.needsUpdate = true;
  }

  dispose(): void {
    for (const { part, mesh } of this.parts) {
      part.geometry.dispose();
      mesh.dispose();
    }
  }
}
