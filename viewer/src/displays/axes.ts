// SPDX-License-Identifier: Apache-2.0
/** Axes: one frame, drawn large. */

import * as THREE from "three";
import { axesGeometry } from "../scene/frames";
import type { Placement } from "../scene/frame_poses";
import type { Tick } from "../protocol/messages";
import { Display, release, toFrame } from "./display";
import { FIXED_FRAME, type OptionSpec } from "./options";

export const AXES_SPECS: readonly OptionSpec[] = [
  { key: "Length", kind: "number", value: 1, min: 0.001, max: 10000, step: 0.1, unit: "m" },
  { key: "Radius", kind: "number", value: 0.1, min: 0.0001, max: 1000, step: 0.01, unit: "m" },
  { key: "Alpha", kind: "number", value: 1, min: 0, max: 1, step: 0.05 },
  { key: "Reference Frame", kind: "frame", value: FIXED_FRAME },
];

export class Axes extends Display {
  private mesh: THREE.Mesh | null = null;

  override restyle(): void {
    if (this.mesh) {
      release(this.mesh);
      this.mesh.removeFromParent();
    }
    const length = this.options.number("Length");
    const geometry = axesGeometry(this.context.palette(), this.options.number("Radius") / length);
    this.mesh = new THREE.Mesh(geometry, axesMaterial(this.options.number("Alpha")));
    this.mesh.scale.setScalar(length);
    this.object.add(this.mesh);
  }

  override place(placement: Placement, _tick: Tick): void {
    if (!this.mesh) this.restyle();
    const wanted = this.options.text("Reference Frame");
    const frame = wanted === FIXED_FRAME || wanted === "" ? this.context.model.fixed : wanted;
    const known = toFrame(this.object, frame, placement, this.context.model);
    this.status = known ? { state: "ok", text: "" } : { state: "error", text: `There is no frame “${frame}” to draw.` };
    this.object.visible = known && this.config.enabled;
  }
}

/** The geometry's colours are as on the screen; three.js reckons in linear light. */
export function axesMaterial(alpha: number): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexColors: true,
    transparent: alpha < 1,
    uniforms: { alpha: { value: alpha } },
    vertexShader: `
      varying vec3 shown;
      void main() {
        vec3 n = normalize(normalMatrix * normal);
        shown = color * (0.72 + 0.28 * abs(n.z));
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform float alpha;
      varying vec3 shown;
      void main() { gl_FragColor = vec4(shown, alpha); }`,
  });
}
