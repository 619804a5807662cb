// SPDX-License-Identifier: Apache-2.0
/** Range: the cone that an ultrasound or infrared sensor looks into, as far as it sees. */

import * as THREE from "three";
import type { Shapes } from "../protocol/messages";
import { MessageDisplay } from "./display";
import type { OptionSpec } from "./options";

export const RANGE_SPECS: readonly OptionSpec[] = [
  { key: "Color", label: "Colour", kind: "colour", value: "#ffffff" },
  { key: "Alpha", kind: "number", value: 0.5, min: 0, max: 1, step: 0.05 },
];

export class RangeDisplay extends MessageDisplay<Shapes> {
  protected build({ head }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (head.kind !== "range" || head.range === null || !(head.range > 0)) return group;
    const half = Math.max(0.005, Math.min(1.5, (head.field_of_view ?? 0) / 2));
    const radius = head.range * Math.tan(half);
    const cone = new THREE.ConeGeometry(radius, head.range, 32, 1, true);
    // The tip at the sensor, opening along +x.
    cone.translate(0, -head.range / 2, 0);
    cone.rotateZ(Math.PI / 2);
    const material = new THREE.MeshBasicMaterial({
      color: this.options.colour("Color"),
      transparent: true,
      opacity: this.options.number("Alpha"),
      side: THREE.DoubleSide,
      depthWrite: false,
    });
    group.add(new THREE.Mesh(cone, material));
    return group;
  }
}
