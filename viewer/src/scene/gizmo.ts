// SPDX-License-Identifier: Apache-2.0
/** The gizmo: arrows and rings at a static transform, which the user drags to adjust it. */

import * as THREE from "three";
import { TransformControls } from "three/examples/jsm/controls/TransformControls.js";
import type { Pose, Quaternion, Vector } from "../util/math";
import type { Camera } from "./camera";
import type { FramePoses } from "./frame_poses";

export type GizmoMode = "translate" | "rotate";

export class Gizmo {
  private readonly controls: TransformControls;
  /** At the parent frame, so that the handle's own position and rotation are the transform. */
  private readonly parent = new THREE.Group();
  private readonly handle = new THREE.Group();

  constructor(
    scene: THREE.Scene,
    private readonly camera: Camera,
    canvas: HTMLCanvasElement,
    onChange: (pose: Pose) => void,
    redraw: () => void,
  ) {
    this.parent.add(this.handle);
    this.controls = new TransformControls(camera.current, canvas);
    this.controls.setSpace("local");
    this.controls.setSize(0.8);
    this.controls.attach(this.handle);
    scene.add(this.parent, this.controls.getHelper());
    this.controls.addEventListener("change", redraw);
    this.controls.addEventListener("dragging-changed", ({ value }) => camera.setEnabled(!value));
    this.controls.addEventListener("objectChange", () =>
      onChange({
        position: this.handle.position.toArray() as Vector,
        quaternion: this.handle.quaternion.toArray() as Quaternion,
      }),
    );
  }

  /** Whether the pointer is on the gizmo, so that a click does not select another frame. */
  get isHovered(): boolean {
    return this.controls.axis !== null;
  }

  setMode(mode: GizmoMode): void {
    this.controls.setMode(mode);
  }

  /** Moves the gizmo to a transform between two frames. */
  place(framePoses: FramePoses, parent: number, pose: Pose): void {
    this.parent.position.fromArray(framePoses.positions, parent * 3);
    this.parent.quaternion.fromArray(framePoses.quaternions, parent * 4);
    if (!this.controls.dragging) {
      this.handle.position.set(...pose.position);
      this.handle.quaternion.set(...pose.quaternion);
    }
    this.parent.updateMatrixWorld(true);
    this.controls.camera = this.camera.current;
  }

  dispose(): void {
    this.camera.setEnabled(true);
    this.controls.detach();
    this.controls.getHelper().removeFromParent();
    this.controls.dispose();
    this.parent.removeFromParent();
  }
}
