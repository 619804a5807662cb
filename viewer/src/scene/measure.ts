// SPDX-License-Identifier: Apache-2.0
/** Measures the distance between two frames or points that the user clicks. */

import * as THREE from "three";
import { shorten } from "../util/dom";
import * as format from "../util/format";
import type { Label } from "./labels";
import type { Vector } from "../protocol/messages";
import type { Palette } from "../util/theme";

/** A frame, which may move, or a point that is expressed in the fixed frame. */
export type MeasuredEnd = string | Vector;

export class Measure {
  active = false;
  readonly object: THREE.Line;
  chosen: MeasuredEnd[] = [];
  private readonly endPoints = [new THREE.Vector3(), new THREE.Vector3()] as const;
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
    this.chosen = [];
  }

  /** Starts again if an end is a point, whose coordinates belong to another fixed frame. Frames stay. */
  forgetPoints(): void {
    if (this.chosen.some((end) => typeof end !== "string")) this.chosen = [];
  }

  /** Adds a frame or a point; the third one starts a new measurement. */
  add(end: MeasuredEnd): void {
    if (this.chosen.length >= 2) this.chosen = [];
    if (typeof end !== "string" || this.chosen[0] !== end) this.chosen.push(end);
  }

  update(position: (end: MeasuredEnd) => THREE.Vector3 | null): void {
    const found = this.active ? this.chosen.map(position) : [];
    this.object.visible = found.length === 2 && found.every(Boolean);
    if (!this.object.visible) return;
    found.forEach((point, k) => this.endPoints[k as 0 | 1].copy(point as THREE.Vector3));
    const attribute = this.object.geometry.getAttribute("position");
    this.endPoints.forEach((end, k) => attribute.setXYZ(k, end.x, end.y, end.z));
    attribute.needsUpdate = true;
    const length = this.endPoints[0].distanceTo(this.endPoints[1]);
    this.material.dashSize = Math.max(1e-4, length / 40);
    this.material.gapSize = this.material.dashSize * 0.7;
    this.object.computeLineDistances();
  }

  /** The next step for the user, or the result along the axes of the fixed frame. */
  text(): string {
    const [first] = this.chosen;
    if (first === undefined) return "Measure: click the first frame or point";
    if (this.chosen.length === 1) return `From ${nameOf(first)}: click the second frame or point`;
    if (!this.object.visible) return "One of the two frames is not visible";
    const [a, b] = this.endPoints;
    const along = (["x", "y", "z"] as const).map((k) => `Δ${k} ${format.formatFixed(b[k] - a[k], 3)}`).join("  ");
    return `${format.meters(a.distanceTo(b))}   ${along}`;
  }

  label(): Label | null {
    if (!this.object.visible) return null;
    const [a, b] = this.endPoints;
    return {
      key: "measured",
      text: format.meters(a.distanceTo(b)),
      position: a.clone().lerp(b, 0.5),
      priority: -5,
      className: "measure",
    };
  }
}

function nameOf(end: MeasuredEnd): string {
  return typeof end === "string" ? shorten(end, 40) : `(${end.map((part) => format.formatFixed(part, 3)).join(", ")})`;
}
