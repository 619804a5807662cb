// SPDX-License-Identifier: Apache-2.0
/** Finds what the user clicks or encloses with a rectangle: parts of displays, and frames. */

import * as THREE from "three";
import { DISPLAYS } from "../generated/displays";
import type { Model } from "../model/model";
import type { PickedGroup, PickedPart } from "../model/picked";
import type { PixelBox } from "../scene/tools";
import type { View } from "../scene/view";
import { MAX_LISTED_PARTS, type Display } from "./display";
import type { Displays } from "./manager";

export class Selector {
  private groups: readonly PickedGroup[] = [];

  constructor(
    private readonly model: Model,
    private readonly view: View,
    private readonly displays: Displays,
  ) {
    view.onMiss((event) => this.selectAt(event));
    view.tools.onBox((event, box) => {
      if (box) this.selectInside(box);
      else if (!this.selectAt(event)) model.select(view.frameAt(event));
    });
    model.on("parts", (groups) => {
      this.groups = groups;
      view.highlight.set(groups.flatMap(({ parts }) => parts.map(({ position }) => position)));
      view.refresh();
    });
    model.on("selection", ({ frame }) => frame !== null && this.clear());
    // The positions are expressed in the previous fixed frame.
    model.on("fixed", () => this.clear());
    model.on("hello", () => this.clear());
  }

  clear(): void {
    if (this.groups.length > 0) this.model.emit("parts", []);
  }

  private get selectableDisplays(): Display[] {
    return this.displays.list.filter(({ config, kind }) => config.enabled && DISPLAYS[kind].surfaces);
  }

  /** Selects the part under the pointer. Returns whether there is one. */
  private selectAt(event: PointerEvent): boolean {
    const displays = this.selectableDisplays;
    const roots = displays.map(({ object }) => object);
    const hit = this.view.findHit(event, roots, true);
    const part = hit && displays.map((display) => display.pick(hit)).find((found) => found !== null);
    if (!part) {
      this.clear();
      return false;
    }
    this.model.select(null);
    this.model.emit("parts", [{ display: part.display, count: 1, parts: [part] }]);
    return true;
  }

  private selectInside(box: PixelBox): void {
    const inside = this.view.insideBox(box);
    const groups = [...this.selectableDisplays.map((display) => display.pickAll(inside)), this.framesInside(inside)];
    this.model.select(null);
    this.model.emit(
      "parts",
      groups.filter(({ count }) => count > 0),
    );
  }

  private framesInside(inside: (point: THREE.Vector3) => boolean): PickedGroup {
    const { framePoses } = this.view;
    const group: PickedGroup = { display: "Frames", count: 0, parts: [] };
    const point = new THREE.Vector3();
    for (let i = 0; i < framePoses.count; i++) {
      if (!framePoses.drawn[i] || !inside(point.fromArray(framePoses.positions, i * 3))) continue;
      group.count++;
      if (group.parts.length < MAX_LISTED_PARTS) group.parts.push(this.frame(this.model.forest.name(i), point));
    }
    return group;
  }

  private frame(name: string, point: THREE.Vector3): PickedPart {
    return {
      title: `Frame ${name}`,
      display: "Frames",
      topic: null,
      frame: name,
      stamp: null,
      position: this.view.inFixedFrame(point),
      rows: [],
      source: null,
    };
  }
}
