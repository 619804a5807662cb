// SPDX-License-Identifier: Apache-2.0
/** The Path display: a line through poses, with optional axes or arrows at each pose. */

import * as THREE from "three";
import { LineMaterial } from "three/examples/jsm/lines/LineMaterial.js";
import { Line2 } from "three/examples/jsm/lines/Line2.js";
import { LineGeometry } from "three/examples/jsm/lines/LineGeometry.js";
import { slice, type Shapes } from "../protocol/messages";
import { arrowGeometry, instances, poseAxes } from "./arrows";
import { MessageDisplay } from "./display";

export class PathDisplay extends MessageDisplay<Shapes, "Path"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "path") return group;
    const poses = slice(payload, description.poses, 7);
    const points: number[] = [];
    for (let i = 0; i + 7 <= poses.length; i += 7) {
      const row = poses.subarray(i, i + 3);
      if (row.every(Number.isFinite)) points.push(...row);
    }
    if (points.length >= 6) group.add(this.line(points));
    const { options } = this;
    const style = options.choice("Pose Style");
    if (style === "Axes")
      group.add(poseAxes(poses, this.context.palette(), options.number("Length"), options.number("Radius")));
    if (style === "Arrows") {
      const geometry = arrowGeometry({
        shaftLength: options.number("Shaft Length"),
        shaftRadius: options.number("Shaft Diameter") / 2,
        headLength: options.number("Head Length"),
        headRadius: options.number("Head Diameter") / 2,
      });
      group.add(instances(geometry, new THREE.MeshLambertMaterial({ color: options.color("Pose Color") }), poses));
    }
    return new THREE.Group().add(group);
  }

  /** Moves the path by the offset, which is expressed in the fixed frame. */
  protected override onPose(object: THREE.Object3D): void {
    const [x, y, z] = (["Offset/X", "Offset/Y", "Offset/Z"] as const).map((key) => this.options.number(key));
    object.children[0]?.position.set(x ?? 0, y ?? 0, z ?? 0).applyQuaternion(object.quaternion.clone().invert());
  }

  /** Returns the corners of the bounding box. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const box = new THREE.Box3().setFromObject(object);
    return { min: this.toFixedFrame(box.min), max: this.toFixedFrame(box.max) };
  }

  private line(points: number[]): THREE.Object3D {
    const alpha = this.options.number("Alpha");
    const wide = this.options.choice("Line Style") === "Billboards";
    const line = new Line2(
      new LineGeometry().setPositions(points),
      new LineMaterial({
        color: this.options.color("Color"),
        transparent: alpha < 1,
        opacity: alpha,
        worldUnits: wide,
        linewidth: wide ? this.options.number("Line Width") : 2,
      }),
    );
    line.frustumCulled = false;
    return line;
  }
}
