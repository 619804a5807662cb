// SPDX-License-Identifier: Apache-2.0
/** The Pose, PoseArray, PoseWithCovariance and Odometry displays: arrows or axes; Odometry has a trail. */

import * as THREE from "three";
import { slice, type Shapes, type DisplayOptions } from "../protocol/messages";
import { arrowGeometry, instances, poseAxes } from "./arrows";
import { COVARIANCE_SPECS, covarianceShapes } from "./covariance";
import { MessageDisplay } from "./display";
import type { OptionSpec } from "./options";

export const POSE_SPECS: readonly OptionSpec[] = [
  { key: "Shape", kind: "choice", value: "Arrow", choices: ["Arrow", "Axes"] },
  { key: "Color", kind: "colour", value: "#ff8a1f" },
  { key: "Alpha", kind: "number", value: 1, min: 0, max: 1, step: 0.05 },
  { key: "Shaft Length", kind: "number", value: 0.35, min: 0.001, max: 100, step: 0.05, unit: "m" },
  { key: "Shaft Radius", kind: "number", value: 0.02, min: 0.0005, max: 10, step: 0.005, unit: "m" },
  { key: "Head Length", kind: "number", value: 0.12, min: 0.001, max: 100, step: 0.01, unit: "m" },
  { key: "Head Radius", kind: "number", value: 0.045, min: 0.001, max: 10, step: 0.005, unit: "m" },
  { key: "Axes Length", kind: "number", value: 0.3, min: 0.001, max: 100, step: 0.05, unit: "m" },
  { key: "Axes Radius", kind: "number", value: 0.02, min: 0.0005, max: 10, step: 0.005, unit: "m" },
];

export const COVARIANT_POSE_SPECS: readonly OptionSpec[] = [...POSE_SPECS, ...COVARIANCE_SPECS];

export const ODOMETRY_SPECS: readonly OptionSpec[] = [
  ...POSE_SPECS,
  { key: "Keep", kind: "number", value: 100, min: 1, max: 1000, step: 10 },
  ...COVARIANCE_SPECS,
];

export class PosesDisplay extends MessageDisplay<Shapes> {
  override subscription(): DisplayOptions {
    return this.specs === ODOMETRY_SPECS ? { keep: Math.round(this.options.number("Keep")) } : {};
  }

  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "poses" && description.kind !== "odometry") return group;
    const poses = slice(payload, description.poses, 7);
    const count = Math.floor(poses.length / 7);
    if (count === 0) return group;
    const newest = poses.subarray((count - 1) * 7);
    if (description.covariance && this.specs !== POSE_SPECS)
      group.add(covarianceShapes(newest, description.covariance, this.options));
    if (description.kind === "poses") {
      group.add(this.shape(poses, 1));
      return group;
    }
    group.add(this.shape(newest, 1));
    if (count > 1) group.add(trail(poses, this.options.colour("Color")));
    return group;
  }

  /** Returns the corners of the bounding box. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const box = new THREE.Box3().setFromObject(object);
    return { min: this.inFixed(box.min), max: this.inFixed(box.max) };
  }

  private shape(poses: Float32Array, scale: number): THREE.Object3D {
    const o = this.options;
    if (o.choice("Shape") === "Axes")
      return poseAxes(poses, this.context.palette(), o.number("Axes Length"), o.number("Axes Radius"));
    const geometry = arrowGeometry({
      shaftLength: o.number("Shaft Length"),
      shaftRadius: o.number("Shaft Radius"),
      headLength: o.number("Head Length"),
      headRadius: o.number("Head Radius"),
    });
    const alpha = o.number("Alpha");
    const material = new THREE.MeshLambertMaterial({
      color: o.colour("Color"),
      transparent: alpha < 1,
      opacity: alpha,
    });
    return instances(geometry, material, poses, scale);
  }
}

/** The trail of past poses: a line that fades with age. */
function trail(poses: Float32Array, colour: string): THREE.Line {
  const count = Math.floor(poses.length / 7);
  const points = new Float32Array(count * 3);
  const colours = new Float32Array(count * 4);
  const { r, g, b } = new THREE.Color(colour);
  for (let i = 0; i < count; i++) {
    points.set(poses.subarray(i * 7, i * 7 + 3), i * 3);
    colours.set([r, g, b, (i + 1) / count], i * 4);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colours, 4));
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ vertexColors: true, transparent: true }));
  line.frustumCulled = false;
  return line;
}
