// SPDX-License-Identifier: Apache-2.0
/** The Polygon and PointStamped displays. */

import * as THREE from "three";
import { slice, type Shapes } from "../protocol/messages";
import { MessageDisplay } from "./display";
import { makeSolidMaterial } from "./vectors";

export class PolygonDisplay extends MessageDisplay<Shapes, "Polygon"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "polygon") return group;
    const points = slice(payload, description.points, 3);
    if (points.length < 6 || !points.every(Number.isFinite)) return group;
    const geometry = new THREE.BufferGeometry().setAttribute("position", new THREE.BufferAttribute(points, 3));
    const alpha = this.options.number("Alpha");
    const material = new THREE.LineBasicMaterial({
      color: this.options.color("Color"),
      transparent: alpha < 1,
      opacity: alpha,
    });
    const line = new THREE.LineLoop(geometry, material);
    line.frustumCulled = false;
    group.add(line);
    return group;
  }

  protected override describe({ description, payload }: Shapes): Record<string, unknown> {
    return { corners: description.kind === "polygon" ? Array.from(slice(payload, description.points, 3)) : [] };
  }
}

export class PointDisplay extends MessageDisplay<Shapes, "PointStamped"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "point") return group;
    const at = slice(payload, description.points, 3);
    if (at.length < 3 || !at.every(Number.isFinite)) return group;
    const sphere = new THREE.SphereGeometry(this.options.number("Radius"), 24, 16);
    const mesh = new THREE.Mesh(sphere, makeSolidMaterial(this.options.color("Color"), this.options.number("Alpha")));
    mesh.position.fromArray(at);
    group.add(mesh);
    return group;
  }

  /** Returns the corners of the bounding box. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const box = new THREE.Box3().setFromObject(object);
    return { min: this.toFixedFrame(box.min), max: this.toFixedFrame(box.max) };
  }
}
