// SPDX-License-Identifier: Apache-2.0
/** The Axes display: the axes of one frame. */

import * as THREE from "three";
import { axesGeometry } from "../scene/frames";
import type { FramePoses } from "../scene/frame_poses";
import { FIXED_FRAME } from "../generated/displays";
import type { FrameUpdate } from "../protocol/messages";
import { Display, release, moveToFrame } from "./display";

export class AxesDisplay extends Display<"Axes"> {
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

  override setPoses(framePoses: FramePoses, _update: FrameUpdate): void {
    if (!this.mesh) this.restyle();
    const reference = this.options.text("Reference Frame");
    const frame = reference === FIXED_FRAME || reference === "" ? this.context.model.fixed : reference;
    const known = moveToFrame(this.object, frame, framePoses, this.context.model);
    this.status = known ? { state: "ok", text: "" } : { state: "error", text: `No frame named “${frame}”.` };
    this.object.visible = known && this.config.enabled;
  }
}

/** A material for sRGB vertex colors, which it writes unchanged; three.js would convert them from linear colors. */
export function axesMaterial(alpha: number): THREE.ShaderMaterial {
  return new THREE.ShaderMaterial({
    vertexColors: true,
    transparent: alpha < 1,
    uniforms: { alpha: { value: alpha } },
    vertexShader: `
      varying vec3 shaded;
      void main() {
        vec3 n = normalize(normalMatrix * normal);
        shaded = color * (0.72 + 0.28 * abs(n.z));
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
      }`,
    fragmentShader: `
      uniform float alpha;
      varying vec3 shaded;
      void main() { gl_FragColor = vec4(shaded, alpha); }`,
  });
}
