// SPDX-License-Identifier: Apache-2.0
/** The camera: the view controllers of RViz, and following a frame. */

import * as THREE from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Json, JsonObject, Vector } from "../protocol/messages";
import { DIRECTIONS, LookControls } from "./look_controls";

/** How the camera is moved: around a point, from above, or by looking around. */
export type CameraMode = "orbit" | "top" | "look";

/** The view controllers of RViz by their class names, and how they move the camera. */
const CONTROLLERS: Readonly<Record<string, CameraMode>> = {
  FPS: "look",
  FrameAligned: "look",
  Orbit: "orbit",
  ThirdPersonFollower: "orbit",
  TopDownOrtho: "top",
  XYOrbit: "orbit",
};
const DEFAULT_CONTROLLERS: Readonly<Record<CameraMode, string>> = { orbit: "Orbit", top: "TopDownOrtho", look: "FPS" };

/** Which mouse button does what: as in RViz, or with the right button to move, as in many other programs. */
export type MouseButtons = "rviz" | "right-moves";

const FIELD_OF_VIEW = 45;
const NEAR_PLANE_M = 0.02;
/** Just below 90 degrees, where yaw is still defined. */
const MAX_PITCH = 1.55;
const UP = new THREE.Vector3(0, 0, 1);

export interface View {
  class: string;
  options: JsonObject;
}

/** The pose of the frame that the camera follows, or of the fixed frame. */
export interface Reference {
  position: THREE.Vector3;
  quaternion: THREE.Quaternion;
}

export class Camera {
  mode: CameraMode = "orbit";
  private readonly perspective = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, NEAR_PLANE_M, 5000);
  private readonly orthographicCamera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0.1, 5000);
  private readonly controls: { orbit: OrbitControls; top: OrbitControls; look: LookControls };
  private followedPosition: THREE.Vector3 | null = null;
  /** The class of RViz's view controller, without its package. */
  private controller = "Orbit";
  /** The yaw of the followed frame, with which a ThirdPersonFollower turns. */
  private followedYaw = 0;
  /** The rotation of the top-down view in radians. */
  private angle = 0;
  private width = 1;
  private height = 1;

  constructor(canvas: HTMLCanvasElement, onChange: () => void) {
    this.perspective.up.set(0, 0, 1);
    this.orthographicCamera.up.set(0, 1, 0);
    this.perspective.position.set(2.6, -2.6, 1.9);
    this.orthographicCamera.position.set(0, 0, 1000);
    this.controls = {
      orbit: new OrbitControls(this.perspective, canvas),
      top: new OrbitControls(this.orthographicCamera, canvas),
      look: new LookControls(this.perspective, canvas, onChange),
    };
    for (const controls of [this.controls.orbit, this.controls.top]) {
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
    this.orthographicCamera.zoom = 80;
  }

  get current(): THREE.PerspectiveCamera | THREE.OrthographicCamera {
    return this.mode === "top" ? this.orthographicCamera : this.perspective;
  }

  get target(): THREE.Vector3 {
    const { mode, controls } = this;
    return mode === "look" ? controls.look.pointInFront() : controls[mode].target;
  }

  setMode(mode: CameraMode): void {
    if (mode === this.mode) return;
    const target = this.target.clone();
    const height = this.visibleHeight();
    this.setController(DEFAULT_CONTROLLERS[mode]);
    if (mode !== "look") this.moveTo(target, height);
  }

  /** Uses another view controller, without moving the camera. */
  private setController(controller: string): void {
    this.controls[this.mode].enabled = false;
    this.controller = controller;
    this.mode = CONTROLLERS[controller] as CameraMode;
    if (controller !== "FrameAligned") this.controls.look.locked = false;
    this.controls[this.mode].enabled = true;
    if (this.mode !== "top") this.perspective.up.set(0, 0, 1);
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
    Object.assign(this.orthographicCamera, {
      left: -width / 2,
      right: width / 2,
      top: height / 2,
      bottom: -height / 2,
    });
    this.orthographicCamera.updateProjectionMatrix();
  }

  /** Moves the camera with the scene, whose contents moved by -delta because its origin changed. */
  shift(delta: Vector): void {
    const move = new THREE.Vector3(...delta).negate();
    this.perspective.position.add(move);
    this.orthographicCamera.position.add(move);
    for (const controls of [this.controls.orbit, this.controls.top]) controls.target.add(move);
    this.controls.look.base.position.add(move);
    this.controls[this.mode].update();
    this.followedPosition?.add(move);
  }

  /** Keeps the position relative to a moving frame; null stops following. The frame is centered first. */
  follow(reference: Reference | null): void {
    if (!reference) {
      this.followedPosition = null;
      this.followedYaw = 0;
      return;
    }
    const { position } = reference;
    if (![...position.toArray(), ...reference.quaternion.toArray()].every(Number.isFinite)) return;
    if (this.mode === "look") {
      this.followedPosition = position.clone();
      this.attach(reference);
      return;
    }
    const delta = this.followedPosition
      ? position.clone().sub(this.followedPosition)
      : position.clone().sub(this.target);
    const turn =
      this.followedPosition && this.controller === "ThirdPersonFollower" ? yawOf(reference) - this.followedYaw : 0;
    this.followedPosition = position.clone();
    this.followedYaw = yawOf(reference);
    if (delta.lengthSq() === 0 && turn === 0) return;
    this.current.position.add(delta);
    const { target } = this;
    target.add(delta);
    if (turn !== 0) {
      const around = this.current.position.clone().sub(position).applyAxisAngle(UP, turn);
      this.current.position.copy(position).add(around);
      target.copy(target.clone().sub(position).applyAxisAngle(UP, turn).add(position));
    }
    this.controls[this.mode].update();
  }

  /** The left button rotates, with Shift it moves. The others move and zoom. */
  setMouse(buttons: MouseButtons): void {
    const [MIDDLE, RIGHT] =
      buttons === "rviz" ? [THREE.MOUSE.PAN, THREE.MOUSE.DOLLY] : [THREE.MOUSE.DOLLY, THREE.MOUSE.PAN];
    const { orbit, top } = this.controls;
    for (const controls of [orbit, top]) Object.assign(controls.mouseButtons, { MIDDLE, RIGHT });
  }

  /** Looks at a point from where the camera is, so that it rotates around this point, as RViz's Focus Camera. */
  lookAt(point: THREE.Vector3): void {
    if (this.mode === "look") {
      this.controls.look.lookAt(point);
      return;
    }
    if (this.mode === "top") this.orthographicCamera.position.set(point.x, point.y, this.orthographicCamera.position.z);
    this.target.copy(point);
    this.controls[this.mode].update();
  }

  /** Rotates the camera around its target, by radians; the top-down view does not rotate. */
  turn(yaw: number, pitch: number): void {
    if (this.mode === "look") this.controls.look.turn(yaw, -pitch);
    if (this.mode !== "orbit") return;
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
    if (this.mode === "look") {
      this.controls.look.move(0, -right * height, up * height);
      return;
    }
    const step = new THREE.Vector3()
      .addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0), right * height)
      .addScaledVector(new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1), up * height);
    camera.position.add(step);
    this.target.add(step);
    this.controls[this.mode].update();
  }

  /** Changes the visible height by a factor; factors below 1 zoom in. */
  zoom(factor: number): void {
    if (this.mode === "look") this.controls.look.move(1 - factor, 0, 0);
    else this.moveTo(this.target.clone(), this.visibleHeight() * factor);
  }

  /** Moves a view that looks around with a frame: FrameAligned turns with it, FPS does not. */
  private attach({ position, quaternion }: Reference): void {
    const { look } = this.controls;
    look.base.position.copy(position);
    if (this.controller === "FrameAligned") look.base.quaternion.copy(quaternion);
    else look.base.quaternion.identity();
    look.update();
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
    if (this.mode === "look") this.setController("Orbit");
    const controls = this.controls[this.mode === "top" ? "top" : "orbit"];
    if (this.mode === "orbit") {
      const direction = this.perspective.position.clone().sub(controls.target).normalize();
      const distance = visibleHeight / (2 * Math.tan(((FIELD_OF_VIEW / 2) * Math.PI) / 180));
      this.perspective.position.copy(target).addScaledVector(direction, Math.min(2500, distance));
    } else {
      this.orthographicCamera.position.set(target.x, target.y, target.z + 1000);
      this.orthographicCamera.zoom = this.height / Math.max(visibleHeight, 1e-3);
      this.orthographicCamera.updateProjectionMatrix();
    }
    controls.target.copy(target);
    controls.update();
  }

  private visibleHeight(): number {
    if (this.mode === "top") return this.height / this.orthographicCamera.zoom;
    const distance = this.perspective.position.distanceTo(this.target);
    return 2 * distance * Math.tan(((FIELD_OF_VIEW / 2) * Math.PI) / 180);
  }

  /**
   * Applies a view of an .rviz file.
   *
   * @param view The view.
   * @param reference The pose of its target frame, or of the fixed frame, to which its positions are relative.
   * @returns Whether the view controller is supported.
   */
  apply(view: View, reference: Reference): boolean {
    const name = view.class.replace(/^.*\//, "");
    if (!Object.hasOwn(CONTROLLERS, name)) return false;
    const number = (value: Json | undefined, fallback: number): number =>
      typeof value === "number" && Number.isFinite(value) ? value : fallback;
    const option = (key: string, fallback: number): number => number(view.options[key], fallback);
    const point = (key: string): THREE.Vector3 => {
      const value = view.options[key];
      const parts = value && typeof value === "object" && !Array.isArray(value) ? value : {};
      return new THREE.Vector3(number(parts["X"], 0), number(parts["Y"], 0), number(parts["Z"], 0));
    };
    this.setController(name);
    this.followedPosition = reference.position.clone();
    this.followedYaw = yawOf(reference);
    if (this.mode === "top") {
      this.angle = option("Angle", 0);
      this.orthographicCamera.up.set(-Math.sin(this.angle), Math.cos(this.angle), 0);
      const target = new THREE.Vector3(option("X", 0), option("Y", 0), 0).add(reference.position);
      this.moveTo(target, this.height / Math.max(1e-3, option("Scale", 80)));
    } else if (this.mode === "look") {
      const { look } = this.controls;
      const isAligned = name === "FrameAligned";
      const [yaw, pitch] = DIRECTIONS.get(isAligned ? String(view.options["Point towards"]) : "") ?? [0, 0];
      look.position.copy(point("Position"));
      look.yaw = option("Yaw", yaw);
      look.pitch = option("Pitch", pitch);
      look.roll = option("Roll", 0);
      look.locked = isAligned && view.options["Lock Camera"] === true;
      this.attach(reference);
    } else {
      const turn = name === "ThirdPersonFollower" ? this.followedYaw : 0;
      const target = point("Focal Point").applyAxisAngle(UP, turn).add(reference.position);
      const distance = Math.max(0.05, Math.min(2500, option("Distance", 5)));
      const pitch = Math.max(-MAX_PITCH, Math.min(MAX_PITCH, option("Pitch", 0.785)));
      const yaw = option("Yaw", 0.785) + turn;
      const away = new THREE.Vector3(Math.cos(yaw) * Math.cos(pitch), Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch));
      this.controls.orbit.target.copy(target);
      this.perspective.position.copy(target).addScaledVector(away, distance);
      this.controls.orbit.update();
    }
    return true;
  }

  /** The view in the format of .rviz files; positions are relative to the target frame, or to the fixed frame. */
  describe(targetFrame: string | null, reference: Reference): View {
    const name = `rviz_default_plugins/${this.controller}`;
    const frame = { "Target Frame": targetFrame ?? "<Fixed Frame>" };
    const target = this.target.clone().sub(reference.position);
    const { look } = this.controls;
    if (this.mode === "top")
      return {
        class: name,
        options: { Angle: this.angle, Scale: this.orthographicCamera.zoom, ...frame, X: target.x, Y: target.y },
      };
    if (this.mode === "look") {
      const angles = { Pitch: look.pitch, Yaw: normalizeAngle(look.yaw), ...(look.roll ? { Roll: look.roll } : {}) };
      const aligned = { "Lock Camera": look.locked, "Point towards": look.direction };
      const own = this.controller === "FrameAligned" ? aligned : {};
      return { class: name, options: { ...own, ...angles, Position: xyz(look.position), ...frame } };
    }
    const turn = this.controller === "ThirdPersonFollower" ? this.followedYaw : 0;
    const away = this.perspective.position.clone().sub(this.target);
    const distance = away.length();
    return {
      class: name,
      options: {
        Distance: distance,
        "Focal Point": xyz(target.applyAxisAngle(UP, -turn)),
        Pitch: Math.asin(Math.max(-1, Math.min(1, away.z / distance))),
        ...frame,
        Yaw: normalizeAngle(Math.atan2(away.y, away.x) - turn),
      },
    };
  }
}

/** The rotation of a pose around z in radians. */
function yawOf({ quaternion: { x, y, z, w } }: Reference): number {
  return Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

function xyz(point: THREE.Vector3): JsonObject {
  return { X: point.x, Y: point.y, Z: point.z };
}

/** An angle from 0 to 2 pi, as RViz writes it. */
function normalizeAngle(angle: number): number {
  return ((angle % (2 * Math.PI)) + 2 * Math.PI) % (2 * Math.PI);
}
