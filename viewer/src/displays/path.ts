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
    const style = this.options.choice("Pose Style");
    const length = this.options.number("Length");
    if (style === "Axes") group.add(poseAxes(poses, this.context.palette(), length, this.options.number("Radius")));
    if (style === "Arrows") {
      const geometry = arrowGeometry({
        shaftLength: length * 0.75,
        shaftRadius: length * 0.04,
        headLength: length * 0.25,
        headRadius: length * 0.1,
      });
      group.add(instances(geometry, new THREE.MeshLambertMaterial({ color: this.options.color("Color") }), poses));
    }
    return group;
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
