// SPDX-License-Identifier: Apache-2.0
/** The names of frames: a limited number of HTML elements that do not overlap. */

import * as THREE from "three";
import { h, setText, shorten } from "../util/dom";

const MAX_LABELS = 120;
const ROW_PX = 15;
const CHARACTER_PX = 6.7;
const MAX_CHARACTERS = 32;
/** Offsets in rows that are tried if the position of a label is occupied. */
const ROW_OFFSETS = [0, 1, -1, 2, -2, 3];

export interface Label {
  key: string;
  text: string;
  position: THREE.Vector3;
  /** Labels with lower values are placed first. */
  priority: number;
  className: string;
}

export class LabelLayer {
  private readonly pool = new Map<string, HTMLElement>();
  private readonly projectedPoint = new THREE.Vector3();

  constructor(private readonly parent: HTMLElement) {}

  /** Places the labels that fit; labels that would overlap others are omitted. */
  draw(labels: Label[], camera: THREE.Camera, width: number, height: number): void {
    const visible: { label: Label; x: number; y: number; rank: number }[] = [];
    for (const label of labels) {
      const p = this.projectedPoint.copy(label.position).project(camera);
      if (p.z < -1 || p.z > 1 || Math.abs(p.x) > 1 || Math.abs(p.y) > 1) continue;
      visible.push({
        label,
        x: ((p.x + 1) / 2) * width,
        y: ((1 - p.y) / 2) * height,
        rank: label.priority + p.z,
      });
    }
    visible.sort((a, b) => a.rank - b.rank);
    const occupied: number[][] = [];
    const used = new Set<string>();
    for (const { label, x, y } of visible) {
      if (used.size >= MAX_LABELS) break;
      const length = Math.min(label.text.length, MAX_CHARACTERS) * CHARACTER_PX + 12;
      const left = labelLeft(x, length, width);
      const row = reserveRow(occupied, left, y, length);
      if (row === null) continue;
      this.place(label, left, row);
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
    setText(element, shorten(label.text, MAX_CHARACTERS));
    element.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
  }
}

/** The left end of a label: right of its frame, or left of it where the view ends too early. */
export function labelLeft(x: number, length: number, width: number): number {
  return x + length <= width ? x : Math.max(0, x - length);
}

/** Reserves a free row near (x, y) for a text of this width. Returns its y, or null if all rows are occupied. */
function reserveRow(occupiedRows: number[][], x: number, y: number, width: number): number | null {
  for (const offset of ROW_OFFSETS) {
    const top = y + offset * ROW_PX;
    const row = Math.round(top / ROW_PX);
    const rows = [row - 1, row, row + 1].filter((r) => r >= 0);
    const collides = rows.some((r) => {
      const spans = occupiedRows[r];
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
    if (row >= 0) (occupiedRows[row] ??= []).push(x, x + width, top);
    return top;
  }
  return null;
}
