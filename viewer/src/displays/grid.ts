// SPDX-License-Identifier: Apache-2.0
/** The Grid display: lines in a plane. */

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { LineSegments2 } from "three/examples/jsm/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/examples/jsm/lines/LineSegmentsGeometry.js";
import type { FramePoses } from "../scene/frame_poses";
import { FIXED_FRAME } from "../generated/displays";
import type { FrameUpdate } from "../protocol/messages";
import { Display, release, moveToFrame } from "./display";

/** Cells per side up to which the lines between layers are drawn. */
const MAX_POSTS = 200;

export class GridDisplay extends Display<"Grid"> {
  private lines: THREE.Object3D | null = null;

  override restyle(): void {
    if (this.lines) {
      release(this.lines);
      this.lines.removeFromParent();
    }
    const color = this.options.color("Color") || this.context.palette().grid;
    const { options } = this;
    const points = gridPoints(
      Math.round(options.number("Plane Cell Count")),
      Math.round(options.number("Normal Cell Count")),
      options.number("Cell Size"),
    );
    const alpha = this.config.options["Alpha"] === undefined ? 1 : options.number("Alpha");
    const look = { color, transparent: alpha < 1, opacity: alpha };
    if (options.choice("Line Style/Value") === "Billboards") {
      const linewidth = options.number("Line Style/Line Width");
      const material = new LineMaterial({ ...look, worldUnits: true, linewidth });
      this.lines = new LineSegments2(new LineSegmentsGeometry().setPositions(points), material);
      this.lines.frustumCulled = false;
    } else {
      const geometry = new THREE.BufferGeometry();
      geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
      this.lines = new THREE.LineSegments(geometry, new THREE.LineBasicMaterial(look));
    }
    this.lines.position.set(options.number("Offset/X"), options.number("Offset/Y"), options.number("Offset/Z"));
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

/** The ends of all lines: layers of squares, and lines between the layers. */
function gridPoints(count: number, layers: number, cell: number): number[] {
  const half = (count * cell) / 2;
  const top = (layers * cell) / 2;
  const points: number[] = [];
  for (let layer = 0; layer <= layers; layer++) {
    const z = layer * cell - top;
    for (let k = 0; k <= count; k++) {
      const at = k * cell - half;
      points.push(-half, at, z, half, at, z, at, -half, z, at, half, z);
    }
  }
  // A grid of many cells is drawn without the lines between its layers, as their number grows with the square.
  if (layers > 0 && count <= MAX_POSTS)
    for (let i = 0; i <= count; i++)
      for (let k = 0; k <= count; k++) {
        const [x, y] = [i * cell - half, k * cell - half];
        points.push(x, y, -top, x, y, top);
      }
  return points;
}
