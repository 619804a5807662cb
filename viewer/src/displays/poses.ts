// SPDX-License-Identifier: Apache-2.0
/** The Pose, PoseArray, PoseWithCovariance and Odometry displays: arrows or axes; Odometry has a trail. */

import * as THREE from "three";
import { slice, type Shapes } from "../protocol/messages";
import { arrowGeometry, flatArrowGeometry, instances, poseAxes } from "./arrows";
import { covarianceShapes } from "./covariance";
import { MessageDisplay } from "./display";

type ShapeNumber =
  "Alpha" | "Axes Length" | "Axes Radius" | "Head Length" | "Head Radius" | "Shaft Length" | "Shaft Radius";

export class PosesDisplay extends MessageDisplay<Shapes, "Pose" | "PoseArray" | "PoseWithCovariance" | "Odometry"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "poses" && description.kind !== "odometry") return group;
    const poses = slice(payload, description.poses, 7);
    const count = Math.floor(poses.length / 7);
    if (count === 0) return group;
    const newest = poses.subarray((count - 1) * 7);
    if (description.covariance && (this.kind === "PoseWithCovariance" || this.kind === "Odometry"))
      group.add(covarianceShapes(newest, description.covariance, this.options));
    if (description.kind === "poses") {
      group.add(this.shape(poses, 1));
      return group;
    }
    group.add(this.shape(newest, 1));
    if (count > 1) group.add(makeTrail(poses, this.color));
    return group;
  }

  /** Returns the corners of the bounding box. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const box = new THREE.Box3().setFromObject(object);
    return { min: this.toFixedFrame(box.min), max: this.toFixedFrame(box.max) };
  }

  /** RViz nests the options of the shape in files of Odometry displays. */
  private get isNested(): boolean {
    return this.kind === "Odometry";
  }

  private get color(): string {
    return this.options.color(this.isNested ? "Shape/Color" : "Color");
  }

  private shape(poses: Float32Array, scale: number): THREE.Object3D {
    const number = (key: ShapeNumber): number =>
      this.isNested ? this.options.number(`Shape/${key}`) : this.options.number(key);
    const shape = this.options.choice(this.isNested ? "Shape/Value" : "Shape");
    if (shape === "Axes") return poseAxes(poses, this.context.palette(), number("Axes Length"), number("Axes Radius"));
    const alpha = number("Alpha");
    const look = { color: this.color, transparent: alpha < 1, opacity: alpha };
    if (shape === "Arrow (Flat)") {
      const flat = new THREE.MeshBasicMaterial({ ...look, side: THREE.DoubleSide });
      return instances(flatArrowGeometry(), flat, poses, scale * this.options.number("Arrow Length"));
    }
    const geometry = arrowGeometry({
      shaftLength: number("Shaft Length"),
      shaftRadius: number("Shaft Radius"),
      headLength: number("Head Length"),
      headRadius: number("Head Radius"),
    });
    return instances(geometry, new THREE.MeshLambertMaterial(look), poses, scale);
  }
}

/** The trail of past poses: a line that fades with age. */
function makeTrail(poses: Float32Array, color: string): THREE.Line {
  const count = Math.floor(poses.length / 7);
  const points = new Float32Array(count * 3);
  const colors = new Float32Array(count * 4);
  const { r, g, b } = new THREE.Color(color);
  for (let i = 0; i < count; i++) {
    points.set(poses.subarray(i * 7, i * 7 + 3), i * 3);
    colors.set([r, g, b, (i + 1) / count], i * 4);
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(points, 3));
  geometry.setAttribute("color", new THREE.BufferAttribute(colors, 4));
  const line = new THREE.Line(geometry, new THREE.LineBasicMaterial({ vertexColors: true, transparent: true }));
  line.frustumCulled = false;
  return line;
}
