// SPDX-License-Identifier: Apache-2.0
/** Rings around the selected points of the scene, in front of everything. */

import * as THREE from "three";
import type { Vector } from "../protocol/messages";
import type { Palette } from "../util/theme";

const SIZE_PX = 18;
const TEXTURE_PX = 64;

export class Highlight {
  readonly object: THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial>;
  private points: readonly Vector[] = [];

  constructor(palette: Palette) {
    const material = new THREE.PointsMaterial({
      size: SIZE_PX * devicePixelRatio,
      sizeAttenuation: false,
      map: ring(),
      transparent: true,
      depthTest: false,
      depthWrite: false,
    });
    this.object = new THREE.Points(new THREE.BufferGeometry(), material);
    Object.assign(this.object, { frustumCulled: false, renderOrder: 13, visible: false });
    this.setPalette(palette);
  }

  /** Marks points that are expressed in the fixed frame. */
  set(points: readonly Vector[]): void {
    this.points = points;
    this.object.visible = points.length > 0;
  }

  /** Places the rings in a scene whose origin is at a point of the fixed frame. */
  place(origin: Readonly<Vector>): void {
    if (!this.object.visible) return;
    const positions = this.points.flatMap((point) => point.map((value, k) => value - (origin[k] as number)));
    this.object.geometry.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  }

  setPalette({ measure }: Palette): void {
    this.object.material.color.set(measure);
  }
}

function ring(): THREE.Texture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = TEXTURE_PX;
  const context = canvas.getContext("2d");
  const half = TEXTURE_PX / 2;
  if (context)
    for (const [width, color] of [
      [14, "#0008"],
      [8, "#fff"],
    ] as const) {
      context.lineWidth = width;
      context.strokeStyle = color;
      context.beginPath();
      context.arc(half, half, half - 8, 0, 2 * Math.PI);
      context.stroke();
    }
  return new THREE.CanvasTexture(canvas);
}
