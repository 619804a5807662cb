// SPDX-License-Identifier: Apache-2.0
/** The Grid display: lines in a plane. */

import * as THREE from "three";
import type { FramePoses } from "../scene/frame_poses";
import { FIXED_FRAME } from "../generated/displays";
import type { FrameUpdate } from "../protocol/messages";
import { Display, release, moveToFrame } from "./display";

export class GridDisplay extends Display<"Grid"> {
  private lines: THREE.LineSegments | null = null;

  override restyle(): void {
    if (this.lines) {
      release(this.lines);
      this.lines.removeFromParent();
    }
    const color = this.options.color("Color") || this.context.palette().grid;
    const geometry = gridGeometry(
      Math.round(this.options.number("Plane Cell Count")),
      this.options.number("Cell Size"),
    );
    const alpha = this.config.options["Alpha"] === undefined ? 1 : this.options.number("Alpha");
    const material = new THREE.LineBasicMaterial({ color: color, transparent: alpha < 1, opacity: alpha });
    this.lines = new THREE.LineSegments(geometry, material);
    const plane = this.options.choice("Plane");
    if (plane === "XZ") this.lines.rotation.x = Math.PI / 2;
    if (plane === "YZ") this.lines.rotation.y = Math.PI / 2;
    this.object.add(this.lines);
  }

  override setPoses(framePoses: FramePoses, _update: FrameUpdate): void {
    if (!this.lines) this.restyle();
    const frame = this.options.text("Reference Frame");
    const shown = this.config.enabled;
    if (frame !== FIXED_FRAME && frame !== "") {
      const known = moveToFrame(this.object, frame, framePoses, this.context.model);
      this.object.visible = shown && known;
      return;
    }
    // Far from the origin of the fixed frame, the grid moves below the frames by whole cells.
    const cell = this.options.number("Cell Size");
    const [x, y, z] = framePoses.origin;
    const toLine = (value: number): number => -(value - Math.round(value / cell) * cell);
    this.object.visible = shown;
    this.object.quaternion.identity();
    const far = Math.hypot(x, y) > 1000;
    this.object.position.set(far ? toLine(x) : -x, far ? toLine(y) : -y, Math.abs(z) > 50 ? 0 : -z);
  }
}

function gridGeometry(count: number, cell: number): THREE.BufferGeometry {
  const half = (count * cell) / 2;
  const points: number[] = [];
  for (let k = 0; k <= count; k++) {
    const at = k * cell - half;
    points.push(-half, at, 0, half, at, 0, at, -half, 0, at, half, 0);
  }
  return new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
}
