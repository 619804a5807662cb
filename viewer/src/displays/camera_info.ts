// SPDX-License-Identifier: Apache-2.0
/** Camera: what a camera sees, as a pyramid from its optical frame, from the intrinsics in CameraInfo. */

import * as THREE from "three";
import type { Shapes } from "../protocol/messages";
import { MessageDisplay } from "./display";
import type { OptionSpec } from "./options";

export const CAMERA_SPECS: readonly OptionSpec[] = [
  { key: "Far Clip", label: "Length", kind: "number", value: 0.5, min: 0.01, max: 1000, step: 0.1, unit: "m" },
  { key: "Color", label: "Colour", kind: "colour", value: "#f5d90a" },
  { key: "Alpha", kind: "number", value: 0.15, min: 0, max: 1, step: 0.05 },
];

export class CameraDisplay extends MessageDisplay<Shapes> {
  protected build({ head }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (head.kind !== "camera") return group;
    const [fx, fy, cx, cy] = [head.k[0] ?? 0, head.k[4] ?? 0, head.k[2] ?? 0, head.k[5] ?? 0];
    if (!(fx > 0 && fy > 0 && head.width > 0 && head.height > 0)) {
      this.status = { state: "error", text: "The CameraInfo holds no calibration: its K matrix is zero." };
      return group;
    }
    const depth = this.options.number("Far Clip");
    const corner = (u: number, v: number): THREE.Vector3 =>
      new THREE.Vector3(((u - cx) / fx) * depth, ((v - cy) / fy) * depth, depth);
    const corners = [corner(0, 0), corner(head.width, 0), corner(head.width, head.height), corner(0, head.height)];
    const eye = new THREE.Vector3();
    const edges = corners.flatMap((at, i) => [eye, at, at, corners[(i + 1) % 4] as THREE.Vector3]);
    const sides = corners.flatMap((at, i) => [eye, at, corners[(i + 1) % 4] as THREE.Vector3]);
    const colour = this.options.colour("Color");
    group.add(
      new THREE.LineSegments(
        new THREE.BufferGeometry().setFromPoints(edges),
        new THREE.LineBasicMaterial({ color: colour }),
      ),
      new THREE.Mesh(
        new THREE.BufferGeometry().setFromPoints(sides),
        new THREE.MeshBasicMaterial({
          color: colour,
          transparent: true,
          opacity: this.options.number("Alpha"),
          side: THREE.DoubleSide,
          depthWrite: false,
        }),
      ),
    );
    return group;
  }
}
