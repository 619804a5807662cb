// SPDX-License-Identifier: Apache-2.0
/** Measures the distance between two frames that the user clicks. */

import * as THREE from "three";
import { shorten } from "../util/dom";
import * as format from "../util/format";
import type { Label } from "./labels";
import type { Palette } from "../util/theme";

export class Measure {
  active = false;
  readonly object: THREE.Line;
  frames: string[] = [];
  private readonly ends = [new THREE.Vector3(), new THREE.Vector3()] as const;
  private readonly material: THREE.LineDashedMaterial;

  constructor(palette: Palette) {
    this.material = new THREE.LineDashedMaterial({
      depthTest: false,
      transparent: true,
      dashSize: 0.05,
      gapSize: 0.03,
    });
    this.object = new THREE.Line(new THREE.BufferGeometry(), this.material);
    this.object.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(6), 3));
    this.object.frustumCulled = false;
    this.object.renderOrder = 11;
    this.object.visible = false;
    this.setPalette(palette);
  }

  setPalette(palette: Palette): void {
    this.material.color.set(palette.measure);
  }

  setActive(active: boolean): void {
    this.active = active;
    this.frames = [];
  }

  /** Adds a frame; the third one starts a new measurement. */
  add(frame: string): void {
    if (this.frames.length >= 2) this.frames = [];
    if (this.frames[0] !== frame) this.frames.push(frame);
  }

  update(position: (frame: string) => THREE.Vector3 | null): void {
    const found = this.active ? this.frames.map(position) : [];
    this.object.visible = found.length === 2 && found.every(Boolean);
    if (!this.object.visible) return;
    found.forEach((point, k) => this.ends[k as 0 | 1].copy(point as THREE.Vector3));
    const attribute = this.object.geometry.getAttribute("position");
    this.ends.forEach((end, k) => attribute.setXYZ(k, end.x, end.y, end.z));
    attribute.needsUpdate = true;
    const length = this.ends[0].distanceTo(this.ends[1]);
    this.material.dashSize = Math.max(1e-4, length / 40);
    this.material.gapSize = this.material.dashSize * 0.7;
    this.object.computeLineDistances();
  }

  /** The next step for the user, or the result along the axes of the fixed frame. */
  text(): string {
    if (this.frames.length === 0) return "Measure: click the first frame";
    if (this.frames.length === 1) return `From ${shorten(this.frames[0] ?? "", 40)}: click the second frame`;
    if (!this.object.visible) return "One of the two frames is not visible";
    const [a, b] = this.ends;
    const along = (["x", "y", "z"] as const).map((k) => `Δ${k} ${format.fixed(b[k] - a[k], 3)}`).join("  ");
    return `${format.metres(a.distanceTo(b))}   ${along}`;
  }

  label(): Label | null {
    if (!this.object.visible) return null;
    const [a, b] = this.ends;
    return {
      key: "measured",
      text: format.metres(a.distanceTo(b)),
      position: a.clone().lerp(b, 0.5),
      priority: -5,
      className: "measure",
    };
  }
}
