// SPDX-License-Identifier: Apache-2.0
/** The cameras of additional views: from above, from the sides, around a frame, and out of a frame. */

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Pose, Vector } from "../util/math";

export type PaneKind = "top" | "front" | "side" | "orbit" | "first";

/** The direction from the target to the camera, and what is up in the view. */
const DIRECTIONS: Record<Exclude<PaneKind, "first">, { away: Vector; up: Vector }> = {
  top: { away: [0, 0, 1], up: [0, 1, 0] },
  front: { away: [1, 0, 0], up: [0, 0, 1] },
  side: { away: [0, -1, 0], up: [0, 0, 1] },
  orbit: { away: [-0.7, -0.7, 0.5], up: [0, 0, 1] },
};
const FIELD_OF_VIEW = 60;
const FLAT_DISTANCE_M = 1000;
const NEAR_M = 0.02;
const FAR_M = 5000;
/** The rotation of a camera of three.js, which looks along -z with y up, in a frame that looks along x with z up. */
const ALONG_X = new THREE.Quaternion(0.5, -0.5, -0.5, 0.5);
/** The same for an optical frame, which looks along z with -y up (REP 103). */
const ALONG_Z = new THREE.Quaternion(1, 0, 0, 0);

export class PaneCamera {
  readonly camera: THREE.PerspectiveCamera | THREE.OrthographicCamera;
  readonly controls: OrbitControls | null;
  private followedPosition: THREE.Vector3 | null = null;

  constructor(
    readonly kind: PaneKind,
    area: HTMLElement,
    onChange: () => void,
  ) {
    const flat = kind === "top" || kind === "front" || kind === "side";
    this.camera = flat
      ? new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 2 * FLAT_DISTANCE_M)
      : new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, NEAR_M, FAR_M);
    if (kind === "first") {
      this.controls = null;
      return;
    }
    const { away, up } = DIRECTIONS[kind];
    this.camera.up.set(...up);
    this.camera.position.set(...away).multiplyScalar(flat ? FLAT_DISTANCE_M : 4);
    this.controls = new OrbitControls(this.camera, area);
    this.controls.enableRotate = !flat;
    this.controls.zoomToCursor = flat;
    this.controls.minDistance = 0.05;
    if (flat) this.controls.mouseButtons.LEFT = THREE.MOUSE.PAN;
    this.controls.addEventListener("change", onChange);
    this.controls.update();
  }

  resize(width: number, height: number): void {
    const { camera } = this;
    if (camera instanceof THREE.PerspectiveCamera) camera.aspect = width / height;
    else Object.assign(camera, { left: -width / 2, right: width / 2, top: height / 2, bottom: -height / 2 });
    camera.updateProjectionMatrix();
  }

  /** Makes a box visible in an area of this size in pixels. */
  fit(box: THREE.Box3, width: number, height: number): void {
    const { camera, controls } = this;
    if (!controls || box.isEmpty()) return;
    const radius = Math.max(0.35, box.getSize(new THREE.Vector3()).length() / 2);
    const away = camera.position.clone().sub(controls.target);
    controls.target.copy(box.getCenter(new THREE.Vector3()));
    if (camera instanceof THREE.OrthographicCamera) camera.zoom = Math.min(width, height) / (2.2 * radius);
    else away.setLength((1.1 * radius * Math.max(1, height / width)) / Math.sin((FIELD_OF_VIEW * Math.PI) / 360));
    camera.position.copy(controls.target).add(away);
    camera.updateProjectionMatrix();
    controls.update();
  }

  /** Moves with the scene, whose contents moved by -delta. */
  shift(delta: Vector): void {
    const move = new THREE.Vector3(...delta).negate();
    this.camera.position.add(move);
    this.controls?.target.add(move);
    this.controls?.update();
    this.followedPosition?.add(move);
  }

  /** Looks out of a frame, or keeps the distance to it; null stops following. */
  follow(pose: Pose | null, optical: boolean): void {
    if (!pose) {
      this.followedPosition = null;
      return;
    }
    const position = new THREE.Vector3(...pose.position);
    if (!this.controls) {
      this.camera.position.copy(position);
      this.camera.quaternion.set(...pose.quaternion).multiply(optical ? ALONG_Z : ALONG_X);
      return;
    }
    const delta = position.clone().sub(this.followedPosition ?? this.controls.target);
    this.followedPosition = position;
    if (delta.lengthSq() === 0 || !Number.isFinite(delta.lengthSq())) return;
    this.camera.position.add(delta);
    this.controls.target.add(delta);
    this.controls.update();
  }

  dispose(): void {
    this.controls?.dispose();
  }
}
