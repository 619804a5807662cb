// SPDX-License-Identifier: Apache-2.0
/** The camera: orbit view, top-down view, and following a frame. */

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { JsonObject, Vector } from "../protocol/messages";

export type CameraMode = "orbit" | "top";

/** Which mouse button does what: as in RViz, or with the right button to move, as in many other programs. */
export type MouseButtons = "rviz" | "right-moves";

const MAX_PITCH = 1.55;

const FIELD_OF_VIEW = 45;
const NEAR_PLANE_M = 0.02;

export interface View {
  class: string;
  options: JsonObject;
}

export class Camera {
  mode: CameraMode = "orbit";
  private readonly perspective = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, NEAR_PLANE_M, 5000);
  private readonly flat = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 5000);
  private readonly controls: Record<CameraMode, OrbitControls>;
  private followed: THREE.Vector3 | null = null;
  private width = 1;
  private height = 1;

  constructor(canvas: HTMLCanvasElement, onChange: () => void) {
    this.perspective.up.set(0, 0, 1);
    this.flat.up.set(0, 1, 0);
    this.perspective.position.set(2.6, -2.6, 1.9);
    this.flat.position.set(0, 0, 1000);
    this.controls = { orbit: new OrbitControls(this.perspective, canvas), top: new OrbitControls(this.flat, canvas) };
    for (const controls of Object.values(this.controls)) {
      controls.zoomToCursor = true;
      controls.minDistance = 0.05;
      controls.maxDistance = 3000;
      controls.addEventListener("change", onChange);
    }
    const { top } = this.controls;
    this.setMouse("rviz");
    top.enableRotate = false;
    top.mouseButtons.LEFT = THREE.MOUSE.PAN;
    top.touches.ONE = THREE.TOUCH.PAN;
    top.touches.TWO = THREE.TOUCH.DOLLY_PAN;
    top.enabled = false;
    this.flat.zoom = 80;
  }

  get current(): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    return this.mode === "orbit" ? this.perspective : this.flat;
  }

  get target(): THREE.Vector3 {
    return this.controls[this.mode].target;
  }

  setMode(mode: CameraMode): void {
    if (mode === this.mode) return;
    const target = this.target.clone();
    const height = this.visibleHeight();
    this.controls[this.mode].enabled = false;
    this.mode = mode;
    this.controls[mode].enabled = true;
    this.moveTo(target, height);
  }

  /** Enables or disables the control of the camera by the pointer. */
  setEnabled(enabled: boolean): void {
    this.controls[this.mode].enabled = enabled;
  }

  resize(width: number, height: number): void {
    this.width = Math.max(1, width);
    this.height = Math.max(1, height);
    this.perspective.aspect = this.width / this.height;
    this.perspective.updateProjectionMatrix();
    // With one unit per pixel, the zoom is the number of pixels per meter, as RViz's Scale.
    Object.assign(this.flat, { left: -width / 2, right: width / 2, top: height / 2, bottom: -height / 2 });
    this.flat.updateProjectionMatrix();
  }

  /** Moves the camera with the scene, whose contents moved by -delta because its origin changed. */
  shift(delta: Vector): void {
    const move = new THREE.Vector3(...delta).negate();
    this.perspective.position.add(move);
    this.flat.position.add(move);
    for (const controls of Object.values(this.controls)) {
      controls.target.add(move);
      controls.update();
    }
    this.followed?.add(move);
  }

  /** Keeps the distance to a moving frame; null stops following. */
  follow(position: THREE.Vector3 | null): void {
    if (!position) {
      this.followed = null;
      return;
    }
    const delta = this.followed ? position.clone().sub(this.followed) : position.clone().sub(this.target);
    this.followed = position.clone();
    if (delta.lengthSq() === 0 || !Number.isFinite(delta.lengthSq())) return;
    this.current.position.add(delta);
    this.target.add(delta);
    this.controls[this.mode].update();
  }

  /** The left button rotates, with Shift it moves. The others move and zoom. */
  setMouse(buttons: MouseButtons): void {
    const [MIDDLE, RIGHT] =
      buttons === "rviz" ? [THREE.MOUSE.PAN, THREE.MOUSE.DOLLY] : [THREE.MOUSE.DOLLY, THREE.MOUSE.PAN];
    for (const controls of Object.values(this.controls)) Object.assign(controls.mouseButtons, { MIDDLE, RIGHT });
  }

  /** Looks at a point from where the camera is, so that it rotates around this point, as RViz's Focus Camera. */
  lookAt(point: THREE.Vector3): void {
    if (this.mode === "top") this.flat.position.set(point.x, point.y, this.flat.position.z);
    this.target.copy(point);
    this.controls[this.mode].update();
  }

  /** Rotates the camera around its target, by radians; the top-down view does not rotate. */
  turn(yaw: number, pitch: number): void {
    if (this.mode === "top") return;
    const target = this.controls.orbit.target;
    const away = this.perspective.position.clone().sub(target);
    const distance = away.length();
    const angle = Math.atan2(away.y, away.x) + yaw;
    const height = Math.max(-MAX_PITCH, Math.min(MAX_PITCH, Math.asin(away.z / distance) + pitch));
    away.set(Math.cos(angle) * Math.cos(height), Math.sin(angle) * Math.cos(height), Math.sin(height));
    this.perspective.position.copy(target).addScaledVector(away, distance);
    this.controls.orbit.update();
  }

  /** Moves the camera and its target by shares of the visible height. */
  move(right: number, up: number): void {
    const camera = this.current;
    camera.updateMatrixWorld();
    const height = this.visibleHeight();
    const step = new THREE.Vector3()
      .addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0), right * height)
      .addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1), up * height);
    camera.position.add(step);
    this.target.add(step);
    this.controls[this.mode].update();
  }

  /** Changes the visible height by a factor; factors below 1 zoom in. */
  zoom(factor: number): void {
    this.moveTo(this.target.clone(), this.visibleHeight() * factor);
  }

  fit(box: THREE.Box3): void {
    if (box.isEmpty()) return;
    const center = box.getCenter(new THREE.Vector3());
    const radius = Math.max(0.35, box.getSize(new THREE.Vector3()).length() / 2);
    const narrow = Math.min(1, this.width / this.height);
    this.moveTo(center, (2.5 * radius) / narrow);
  }

  /** Moves the camera so that the given height in meters around the target fills the view. */
  private moveTo(target: THREE.Vector3, visibleHeight: number): void {
    const controls = this.controls[this.mode];
    if (this.mode === "orbit") {
      const direction = this.perspective.position.clone().sub(controls.target).normalize();
      const distance = visibleHeight / (2 * Math.tan(((FIELD_OF_VIEW / 2) * Math.PI) / 180));
      this.perspective.position.copy(target).addScaledVector(direction, Math.min(2500, distance));
    } else {
      this.flat.position.set(target.x, target.y, target.z + 1000);
      this.flat.zoom = this.height / Math.max(visibleHeight, 1e-3);
      this.flat.updateProjectionMatrix();
    }
    controls.target.copy(target);
    controls.update();
  }

  private visibleHeight(): number {
    if (this.mode === "top") return this.height / this.flat.zoom;
    const distance = this.perspective.position.distanceTo(this.controls.orbit.target);
    return 2 * distance * Math.tan(((FIELD_OF_VIEW / 2) * Math.PI) / 180);
  }

  /** Applies the options of RViz's Orbit or TopDownOrtho view. Returns whether the view is supported. */
  apply(view: View): boolean {
    const name = view.class.replace(/^.*\//, "");
    const number = (key: string, fallback: number): number => {
      const value = view.options[key];
      return typeof value === "number" && Number.isFinite(value) ? value : fallback;
    };
    if (name === "TopDownOrtho") {
      this.setMode("top");
      const target = new THREE.Vector3(number("X", 0), number("Y", 0), 0);
      this.moveTo(target, this.height / Math.max(1e-3, number("Scale", 80)));
      return true;
    }
    if (!["Orbit", "XYOrbit", "ThirdPersonFollower"].includes(name)) return false;
    this.setMode("orbit");
    const focal = view.options["Focal Point"];
    const part = (key: string): number => {
      const value = focal && typeof focal === "object" && !Array.isArray(focal) ? focal[key] : 0;
      return typeof value === "number" && Number.isFinite(value) ? value : 0;
    };
    const target = new THREE.Vector3(part("X"), part("Y"), part("Z"));
    const distance = Math.max(0.05, Math.min(2500, number("Distance", 5)));
    const pitch = Math.max(-1.55, Math.min(1.55, number("Pitch", 0.785)));
    const yaw = number("Yaw", 0.785);
    const away = new THREE.Vector3(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch));
    this.controls.orbit.target.copy(target);
    this.perspective.position.copy(target).addScaledVector(away, distance);
    this.controls.orbit.update();
    return true;
  }

  describe(targetFrame: string | null): View {
    const target = this.target;
    const frame = targetFrame ?? "<Fixed Frame>";
    if (this.mode === "top")
      return {
        class: "rviz_default_plugins/TopDownOrtho",
        options: { Angle: 0, Scale: this.flat.zoom, "Target Frame": frame, X: target.x, Y: target.y },
      };
    const away = this.perspective.position.clone().sub(target);
    const distance = away.length();
    return {
      class: "rviz_default_plugins/Orbit",
      options: {
        Distance: distance,
        "Focal Point": { X: target.x, Y: target.y, Z: target.z },
        Pitch: Math.asin(Math.max(-1, Math.min(1, away.z / distance))),
        "Target Frame": frame,
        Yaw: (Math.atan2(away.y, away.x) + 2 * Math.PI) % (2 * Math.PI),
      },
    };
  }
}
