// SPDX-License-Identifier: Apache-2.0
/** The ParticleCloud display: arrows whose length shows the weight of a particle. */

import * as THREE from "three";
import { axesGeometry } from "../scene/frames";
import { slice, type Shapes } from "../protocol/messages";
import { arrowGeometry, flatArrowGeometry, instances } from "./arrows";
import { axesMaterial } from "./axes";
import { MessageDisplay } from "./display";

export class ParticlesDisplay extends MessageDisplay<Shapes, "ParticleCloud"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "particles") return group;
    const poses = slice(payload, description.poses, 7);
    const weights = slice(payload, description.weights, 1);
    const { options } = this;
    const [shortest, longest] = [options.number("Min Arrow Length"), options.number("Max Arrow Length")];
    const length = (i: number): number => shortest + (longest - shortest) * (weights[i] ?? 0);
    const shape = options.choice("Shape");
    if (shape === "Axes") {
      const material = axesMaterial(options.number("Alpha"));
      material.vertexShader = material.vertexShader
        .replace("normalMatrix * normal", "normalMatrix * mat3(instanceMatrix) * normal")
        .replace("modelViewMatrix *", "modelViewMatrix * instanceMatrix *");
      group.add(instances(axesGeometry(this.context.palette(), 0.08), material, poses, length));
      return group;
    }
    const alpha = options.number("Alpha");
    const look = { color: options.color("Color"), transparent: alpha < 1, opacity: alpha, side: THREE.DoubleSide };
    if (shape === "Arrow (Flat)")
      group.add(instances(flatArrowGeometry(), new THREE.MeshBasicMaterial(look), poses, length));
    else {
      const arrow = { shaftLength: 0.77, shaftRadius: 0.05, headLength: 0.23, headRadius: 0.1 };
      group.add(instances(arrowGeometry(arrow), new THREE.MeshLambertMaterial(look), poses, length));
    }
    return group;
  }

  /** Returns the number of particles, and the corners of the bounding box. */
  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const box = new THREE.Box3().setFromObject(object);
    const mesh = object.children[0] as THREE.InstancedMesh | undefined;
    return { particles: mesh?.count ?? 0, min: this.toFixedFrame(box.min), max: this.toFixedFrame(box.max) };
  }
}
