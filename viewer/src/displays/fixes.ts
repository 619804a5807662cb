// SPDX-License-Identifier: Apache-2.0
/** The NavSatFix display: positions in meters from the first one, and the covariance of the newest. */

import * as THREE from "three";
import { slice, type Shapes } from "../protocol/messages";
import { principalAxes } from "../util/math";
import { MessageDisplay } from "./display";
import { makeSolidMaterial } from "./vectors";

const COVARIANCE_ALPHA = 0.25;

export class FixDisplay extends MessageDisplay<Shapes, "NavSatFix"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "fix") return group;
    const points = slice(payload, description.points, 3);
    if (points.length < 3 || !points.every(Number.isFinite)) return group;
    const color = this.options.color("Color");
    const alpha = this.options.number("Alpha");
    const newest = new THREE.Mesh(
      new THREE.SphereGeometry(this.options.number("Radius"), 24, 16),
      makeSolidMaterial(color, alpha),
    );
    newest.position.fromArray(points, points.length - 3);
    const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(points, 3));
    const line = new THREE.Line(
      geometry,
      new THREE.LineBasicMaterial({ color, transparent: alpha < 1, opacity: alpha }),
    );
    line.frustumCulled = false;
    group.add(newest, line);
    const variances = description.covariance;
    if (variances?.every((value) => value !== null) && this.options.flag("Covariance")) {
      const axes = principalAxes(variances);
      const ellipsoid = new THREE.Mesh(
        new THREE.SphereGeometry(1, 24, 16),
        makeSolidMaterial(color, alpha * COVARIANCE_ALPHA),
      );
      ellipsoid.scale.fromArray(axes.variances.map((variance) => Math.max(1e-6, Math.sqrt(Math.max(0, variance)))));
      ellipsoid.quaternion.fromArray(axes.quaternion);
      ellipsoid.position.copy(newest.position);
      group.add(ellipsoid);
    }
    return group;
  }

  protected override describe({ description, payload }: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const points = description.kind === "fix" ? Array.from(slice(payload, description.points, 3)) : [];
    return { points, parts: object.children.length };
  }
}
