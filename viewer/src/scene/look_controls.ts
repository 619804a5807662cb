// SPDX-License-Identifier: Apache-2.0
/** Controls of a camera that stands at a point and looks around, as RViz's FPS and FrameAligned views. */

import * as THREE from "three";

const RADIANS_PER_PX = 0.005;
const METERS_PER_PX = 0.01;
const METERS_PER_WHEEL = 0.004;
/** Just below 90 degrees, where yaw is still defined. */
const MAX_PITCH = 1.57;

/** The directions in which RViz's FrameAligned view can look, as angles of yaw and pitch. */
export const DIRECTIONS: ReadonlyMap<string, readonly [yaw: number, pitch: number]> = new Map([
  ["+x axis", [0, 0]],
  ["-x axis", [Math.PI, 0]],
  ["+y axis", [Math.PI / 2, 0]],
  ["-y axis", [-Math.PI / 2, 0]],
  ["+z axis", [0, -Math.PI / 2]],
  ["-z axis", [0, Math.PI / 2]],
]);
/** What RViz writes for all other directions. */
export const ANY_DIRECTION = "arbitrary";
const DIRECTION_TOLERANCE = 1e-3;

export class LookControls {
  enabled = false;
  /** Whether the user cannot move the camera, which keeps its pose relative to its frame. */
  locked = false;
  readonly position = new THREE.Vector3();
  /** Radians; a positive pitch looks down, as in RViz. */
  yaw = 0;
  pitch = 0;
  roll = 0;
  /** The pose to which position and angles are relative. */
  readonly base = { position: new THREE.Vector3(), quaternion: new THREE.Quaternion() };
  private buttons = 0;

  constructor(
    private readonly camera: THREE.PerspectiveCamera,
    canvas: HTMLElement,
    private readonly onChange: () => void,
  ) {
    canvas.addEventListener("pointerdown", (event) => (this.buttons = event.buttons));
    canvas.addEventListener("pointerup", (event) => (this.buttons = event.buttons));
    canvas.addEventListener("pointermove", (event) => this.drag(event));
    canvas.addEventListener("wheel", (event) => this.move(-event.deltaY * METERS_PER_WHEEL, 0, 0), { passive: true });
  }

  /** Places the camera. */
  update(): void {
    const { camera, base } = this;
    camera.position.copy(this.position).applyQuaternion(base.quaternion).add(base.position);
    // RViz's camera looks along x; that of three.js along -z, with y up.
    const look = new THREE.Quaternion().setFromRotationMatrix(
      new THREE.Matrix4().makeBasis(
        new THREE.Vector3(0, -1, 0),
        new THREE.Vector3(0, 0, 1),
        new THREE.Vector3(-1, 0, 0),
      ),
    );
    camera.quaternion.copy(base.quaternion).multiply(this.orientation()).multiply(look);
    camera.updateMatrixWorld();
  }

  /** A point in front of the camera. */
  pointInFront(): THREE.Vector3 {
    const ahead = new THREE.Vector3(1, 0, 0).applyQuaternion(this.orientation()).applyQuaternion(this.base.quaternion);
    return this.camera.position.clone().add(ahead);
  }

  /** The axis along which the camera looks, as RViz writes it. */
  get direction(): string {
    const ahead = aheadOf(this.yaw, this.pitch);
    for (const [name, [yaw, pitch]] of DIRECTIONS)
      if (ahead.distanceTo(aheadOf(yaw, pitch)) < DIRECTION_TOLERANCE) return name;
    return ANY_DIRECTION;
  }

  /** Turns to a point in the scene. */
  lookAt(point: THREE.Vector3): void {
    const ahead = point.clone().sub(this.camera.position).applyQuaternion(this.base.quaternion.clone().invert());
    if (ahead.lengthSq() === 0) return;
    this.turn(Math.atan2(ahead.y, ahead.x) - this.yaw, Math.atan2(-ahead.z, Math.hypot(ahead.x, ahead.y)) - this.pitch);
  }

  /** Turns by radians. */
  turn(yaw: number, pitch: number): void {
    if (!this.enabled || this.locked) return;
    this.yaw += yaw;
    this.pitch = Math.max(-MAX_PITCH, Math.min(MAX_PITCH, this.pitch + pitch));
    this.update();
    this.onChange();
  }

  private orientation(): THREE.Quaternion {
    return new THREE.Quaternion().setFromEuler(new THREE.Euler(this.roll, this.pitch, this.yaw, "ZYX"));
  }

  private drag(event: PointerEvent): void {
    if (!this.enabled || !event.buttons || !this.buttons) return;
    if (event.buttons & 1 && !event.shiftKey)
      this.turn(-event.movementX * RADIANS_PER_PX, event.movementY * RADIANS_PER_PX);
    else if (event.buttons & 2) this.move(-event.movementY * 4 * METERS_PER_PX, 0, 0);
    else this.move(0, event.movementX * METERS_PER_PX, event.movementY * METERS_PER_PX);
  }

  /** Moves forward, to the left and up, in meters. */
  move(forward: number, left: number, up: number): void {
    if (!this.enabled || this.locked) return;
    this.position.add(new THREE.Vector3(forward, left, up).applyQuaternion(this.orientation()));
    this.update();
    this.onChange();
  }
}

/** The unit vector in the direction of two angles. */
function aheadOf(yaw: number, pitch: number): THREE.Vector3 {
  const flat = Math.cos(pitch);
  return new THREE.Vector3(Math.cos(yaw) * flat, Math.sin(yaw) * flat, -Math.sin(pitch));
}
