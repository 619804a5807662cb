// SPDX-License-Identifier: Apache-2.0
/** The Range display: the measured cone of an ultrasound or infrared sensor. */

import * as THREE from "three";
import type { Shapes } from "../protocol/messages";
import { MessageDisplay } from "./display";

export class RangeDisplay extends MessageDisplay<Shapes, "Range"> {
  protected build({ description }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "range" || description.range === null || !(description.range > 0)) return group;
    const half = Math.max(0.005, Math.min(1.5, (description.field_of_view ?? 0) / 2));
    const radius = description.range * Math.tan(half);
    const cone = new THREE.ConeGeometry(radius, description.range, 32, 1, true);
    // The tip is at the sensor; the cone opens along +x.
    cone.translate(0, -description.range / 2, 0);
    cone.rotateZ(Math.PI / 2);
    const material = new THREE.MeshBasicMaterial({
      color: this.options.color("Color"),
      transparent: true,
      opacity: this.options.number("Alpha"),
      side: THREE.DoubleSide,
      depthWrite: false,
    });
    group.add(new THREE.Mesh(cone, material));
    return group;
  }
}
