// SPDX-License-Identifier: Apache-2.0
// Where a scene is seen from.
import { Box3, PerspectiveCamera, Quaternion, Vector3 } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';

export const CAMERA_NAMES = ['overview', 'follow', 'chase', 'cockpit'] as const;
export type CameraName = (typeof CAMERA_NAMES)[number];

/** Places about an aircraft that is as large as its model, feet. */
const CHASE = new Vector3(0, 22, 95);
/** Of an overview, from behind, rad. */
const FROM_THE_SIDE = 1.15;
const COCKPIT = new Vector3(0, 3.6, -14);
const BESIDE = new Vector3(110, 55, 150);
/** What is nearer is not drawn. */
const NEAR_FT = 4;

export class Cameras {
  readonly camera: PerspectiveCamera;
  /** Is told when someone turns the view by hand. */
  onTurned = () => {};
  private readonly orbit: OrbitControls;
  private isFollowing = false;
  private isTurned = false;
  private name: CameraName = 'overview';
  private readonly target = new Vector3();
  private readonly before = new Vector3();
  private readonly offset = new Vector3();
  private readonly smooth = new Quaternion();

  /** `way` is all that an overview has to show, from the first place flown to the last; the
   * aircraft is `size` times as large as its model. */
  constructor(
    element: HTMLElement, private readonly way: Vector3[], private readonly size: number,
  ) {
    this.camera = new PerspectiveCamera(50, 1, NEAR_FT * Math.min(size, 1), 600000);
    this.orbit = new OrbitControls(this.camera, element);
    this.orbit.enableDamping = false;
    this.orbit.minDistance = 20 * size;
    this.orbit.maxDistance = 400000;
    this.orbit.addEventListener('change', () => {
      if (this.isFollowing) return;
      this.isTurned = true;
      this.onTurned();
    });
    this.home(new Vector3());
  }

  /** Looks from where another does, in its own place. */
  copyView(other: Cameras): void {
    this.isFollowing = true;
    this.offset.subVectors(other.camera.position, other.orbit.target);
    if (this.name === 'overview') this.orbit.target.copy(other.orbit.target);
    this.camera.position.addVectors(this.orbit.target, this.offset);
    this.orbit.update();
    this.isFollowing = false;
  }

  /** Looks from where another one of the same flights did, if that was turned by hand. */
  resume(other: Cameras): void {
    if (!other.isTurned) return;
    this.copyView(other);
    this.isTurned = true;
  }

  get chosen(): CameraName {
    return this.name;
  }

  /** Sees the whole way from its side, or stands beside the aircraft at `at`. */
  private home(at: Vector3): void {
    this.camera.up.set(0, 1, 0);
    if (this.name === 'overview') {
      this.standBack();
    } else {
      this.orbit.target.copy(at);
      this.camera.position.copy(at).addScaledVector(BESIDE, this.size);
    }
    this.before.copy(at);
    this.isFollowing = true;
    this.orbit.update();
    this.isFollowing = false;
    this.isTurned = false;
  }

  private standBack(): void {
    const box = new Box3().setFromPoints(this.way);
    box.getCenter(this.orbit.target);
    const along = this.way[this.way.length - 1].clone().sub(this.way[0]).setY(0);
    if (along.length() < 1) along.set(0, 0, -1);
    // From the right of the way and behind, and from above.
    along.normalize().applyAxisAngle(new Vector3(0, 1, 0), Math.PI + FROM_THE_SIDE);
    along.setY(0.5).normalize();
    let distance = Math.max(box.getSize(new Vector3()).length() / 4, 500);
    for (let i = 0; i < 60; i += 1) {
      this.camera.position.copy(this.orbit.target).addScaledVector(along, distance);
      this.camera.lookAt(this.orbit.target);
      this.camera.updateMatrixWorld();
      if (this.way.every((point) => this.isInView(point))) return;
      distance *= 1.06;
    }
  }

  private isInView(point: Vector3): boolean {
    const { x, y, z } = this.target.copy(point).project(this.camera);
    return Math.abs(x) < 0.9 && Math.abs(y) < 0.8 && z < 1;
  }

  choose(name: CameraName, at: Vector3, attitude: Quaternion): void {
    this.name = name;
    this.orbit.enabled = name === 'overview' || name === 'follow';
    this.smooth.copy(attitude);
    this.camera.fov = name === 'cockpit' ? 65 : 50;
    this.camera.updateProjectionMatrix();
    this.home(at);
  }

  /** As much of the scene as fits, in a view of this shape. */
  reshape(aspect: number): void {
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    if (this.name === 'overview' && !this.isTurned) this.home(this.before.clone());
  }

  /** Goes with the aircraft; `seconds` since the last call smooth a chase. */
  follow(at: Vector3, attitude: Quaternion, seconds: number): void {
    if (this.name === 'follow') {
      this.isFollowing = true;
      this.offset.subVectors(at, this.before);
      this.camera.position.add(this.offset);
      this.orbit.target.copy(at);
      this.orbit.update();
      this.isFollowing = false;
    } else if (this.name !== 'overview') {
      const isChase = this.name === 'chase';
      const share = isChase ? 1 - Math.exp(-4 * seconds) : 1;
      this.smooth.slerp(attitude, share);
      this.camera.position.copy(isChase ? CHASE : COCKPIT).multiplyScalar(this.size)
        .applyQuaternion(this.smooth).add(at);
      this.camera.up.set(0, 1, 0).applyQuaternion(this.smooth);
      // Of a chase the aircraft is in the lower half of the view.
      this.target.set(0, isChase ? 12 : COCKPIT.y, isChase ? 0 : -400).multiplyScalar(this.size)
        .applyQuaternion(this.smooth).add(at);
      this.camera.lookAt(this.target);
    }
    this.before.copy(at);
  }

  dispose(): void {
    this.orbit.dispose();
  }
}
