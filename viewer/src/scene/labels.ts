// SPDX-License-Identifier: Apache-2.0
/** Names beside frames: real elements, few of them, never one over another. */

import * as THREE from "three";
import { h, setText, shorten } from "../util/dom";

const MOST = 120;
const ROW_PX = 15;
const CHARACTER_PX = 6.7;
const LONGEST = 32;
/** Where a label may go when its own place is taken, in rows. */
const NUDGES = [0, 1, -1, 2, -2, 3];

export interface Label {
  key: string;
  text: string;
  position: THREE.Vector3;
  /** Lower is placed first. */
  priority: number;
  className: string;
}

export class LabelLayer {
  private readonly pool = new Map<string, HTMLElement>();
  private readonly projected = new THREE.Vector3();

  constructor(private readonly parent: HTMLElement) {}

  /** Places what fits; the rest is left out rather than drawn over. */
  draw(labels: Label[], camera: THREE.Camera, width: number, height: number): void {
    const seen: { label: Label; x: number; y: number; rank: number }[] = [];
    for (const label of labels) {
      const p = this.projected.copy(label.position).project(camera);
      if (p.z < -1 || p.z > 1 || Math.abs(p.x) > 1 || Math.abs(p.y) > 1) continue;
      seen.push({
        label,
        x: ((p.x + 1) / 2) * width,
        y: ((1 - p.y) / 2) * height,
        rank: label.priority + p.z,
      });
    }
    seen.sort((a, b) => a.rank - b.rank);
    const taken: number[][] = [];
    const used = new Set<string>();
    for (const { label, x, y } of seen) {
      if (used.size >= MOST) break;
      const row = free(taken, x, y, Math.min(label.text.length, LONGEST) * CHARACTER_PX + 12);
      if (row === null) continue;
      this.place(label, x, row);
      used.add(label.key);
    }
    for (const [key, element] of this.pool)
      if (!used.has(key)) {
        element.remove();
        this.pool.delete(key);
      }
  }

  private place(label: Label, x: number, y: number): void {
    let element = this.pool.get(label.key);
    if (!element) {
      element = h("div", { data: { frame: label.key } });
      this.pool.set(label.key, element);
      this.parent.append(element);
    }
    const className = `label ${label.className}`;
    if (element.className !== className) element.className = className;
    setText(element, shorten(label.text, LONGEST));
    element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }
}

/** The first free place near (x, y) for a text of this width: its y, and the place is then taken. */
function free(taken: number[][], x: number, y: number, width: number): number | null {
  for (const nudge of NUDGES) {
    const top = y + nudge * ROW_PX;
    const row = Math.round(top / ROW_PX);
    const rows = [row - 1, row, row + 1].filter((r) => r >= 0);
    const collides = rows.some((r) => {
      const spans = taken[r];
      if (!spans) return false;
      for (let k = 0; k < spans.length; k += 3)
        if (
          Math.abs((spans[k + 2] as number) - top) < ROW_PX - 1 &&
          x < (spans[k + 1] as number) &&
          x + width > (spans[k] as number)
        )
          return true;
      return false;
    });
    if (collides) continue;
    if (row >= 0) (taken[row] ??= []).push(x, x + width, top);
    return top;
  }
  return null;
}
