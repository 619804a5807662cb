// SPDX-License-Identifier: Apache-2.0
/** Additional views of the scene next to the main one, each with its own camera. */

import type * as THREE from "three";
import { fillSelect, h, iconButton, select } from "../util/dom";
import * as format from "../util/format";
import type { Pose, Quaternion, Vector } from "../util/math";
import { loadList, storeValue } from "../util/storage";
import type { Model } from "../model/model";
import type { FramePoses } from "./frame_poses";
import { LabelLayer, type Label } from "./labels";
import { PaneCamera, type PaneKind } from "./pane_camera";
import type { SceneRenderer } from "./renderer";

export const MAX_PANES = 3;
/** The key of the settings; "panes" is that of the panels next to the scene. */
const STORED = "scene-panes";
const KINDS: readonly (readonly [PaneKind, string])[] = [
  ["top", "Top"],
  ["front", "Front"],
  ["side", "Side"],
  ["orbit", "Orbit"],
  ["first", "First person"],
];
const NO_FRAME = "";

export interface PaneSettings {
  kind: PaneKind;
  /** The frame that is followed; null for a camera that stands still. */
  frame: string | null;
}

class Pane {
  readonly element: HTMLElement;
  readonly area = h("div", { class: "pane-area" });
  readonly labels: LabelLayer;
  camera: PaneCamera;
  private readonly frames: HTMLSelectElement;
  private hasFitted = false;

  constructor(
    readonly settings: PaneSettings,
    private readonly owner: Panes,
  ) {
    this.frames = select("Followed frame", [], NO_FRAME, (frame) => {
      this.settings.frame = frame || null;
      this.camera.follow(null, false);
      owner.notifyChange();
    });
    const kind = select("Kind of view", KINDS, settings.kind, (value) => this.setKind(value as PaneKind));
    const layer = h("div", { class: "labels", aria: { hidden: "true" } });
    this.area.append(layer);
    this.labels = new LabelLayer(layer);
    this.element = h(
      "section",
      { class: "pane", aria: { label: "Additional view" } },
      h(
        "header",
        {},
        kind,
        this.frames,
        iconButton("close", "Close this view", () => owner.remove(this)),
      ),
      this.area,
    );
    this.camera = new PaneCamera(settings.kind, this.area, owner.redraw);
  }

  fillFrames(names: readonly string[]): void {
    const { frame } = this.settings;
    const all = frame && !names.includes(frame) ? [frame, ...names] : names;
    fillSelect(this.frames, [[NO_FRAME, "No frame"], ...all.map((name) => [name, name] as const)], frame ?? NO_FRAME);
  }

  /** Looks at the frame that it follows, or at everything when there is something for the first time. */
  update(pose: Pose | null, box: () => THREE.Box3): void {
    const { width, height } = this.size;
    this.camera.resize(width, height);
    if (!this.hasFitted) {
      const content = box();
      this.hasFitted = !content.isEmpty();
      this.camera.fit(content, width, height);
    }
    const { frame } = this.settings;
    if (frame) this.camera.follow(pose, /optical(_frame)?$/.test(frame));
  }

  get size(): { width: number; height: number } {
    return { width: Math.max(1, this.area.clientWidth), height: Math.max(1, this.area.clientHeight) };
  }

  private setKind(kind: PaneKind): void {
    this.settings.kind = kind;
    this.camera.dispose();
    this.camera = new PaneCamera(kind, this.area, this.owner.redraw);
    this.hasFitted = false;
    this.owner.notifyChange();
  }
}

export class Panes {
  private list: Pane[] = [];

  constructor(
    private readonly root: HTMLElement,
    private readonly model: Model,
    private readonly renderer: SceneRenderer,
    readonly redraw: () => void,
    private readonly contentBounds: () => THREE.Box3,
  ) {
    model.on("tree", () => this.fillFrames());
    for (const settings of loadList(STORED, isPaneSettings)) this.add(settings);
  }

  get count(): number {
    return this.list.length;
  }

  add(settings: PaneSettings): void {
    if (this.list.length >= MAX_PANES) return;
    const pane = new Pane(settings, this);
    this.list.push(pane);
    this.root.append(pane.element);
    this.fillFrames();
    this.notifyChange();
  }

  remove(pane: Pane): void {
    pane.camera.dispose();
    pane.element.remove();
    this.list = this.list.filter((other) => other !== pane);
    this.notifyChange();
  }

  /** Updates the cameras before the scene is drawn; `moved` is the movement of the scene's origin. */
  update(framePoses: FramePoses, movement: Vector | null): void {
    for (const pane of this.list) {
      if (movement) pane.camera.shift(movement);
      pane.update(this.poseOf(pane.settings.frame, framePoses), this.contentBounds);
    }
  }

  drawLabels(labels: Label[]): void {
    for (const { labels: layer, camera, size } of this.list) layer.draw(labels, camera.camera, size.width, size.height);
  }

  /** The cameras, for tests. */
  probe(): { kind: PaneKind; frame: string | null; position: Vector; forward: Vector; up: Vector }[] {
    return this.list.map(({ settings, camera: { camera } }) => {
      camera.updateMatrixWorld();
      const e = camera.matrixWorld.elements as unknown as number[];
      const column = (k: number, sign: number): Vector =>
        [0, 1, 2].map((row) => sign * (e[k * 4 + row] as number)) as Vector;
      return { ...settings, position: camera.position.toArray() as Vector, forward: column(2, -1), up: column(1, 1) };
    });
  }

  notifyChange(): void {
    this.root.hidden = this.list.length === 0;
    storeValue(
      STORED,
      this.list.map(({ settings }) => settings),
    );
    this.renderer.setExtraViews(
      this.root,
      this.list.map((pane) => ({ camera: () => pane.camera.camera, area: pane.area })),
    );
    this.redraw();
  }

  private fillFrames(): void {
    if (this.list.length === 0) return;
    const names = format.sortNames(this.model.forest.frames.map((frame) => frame.name));
    for (const pane of this.list) pane.fillFrames(names);
  }

  private poseOf(frame: string | null, { positions, quaternions, count, drawn }: FramePoses): Pose | null {
    const i = this.model.forest.index.get(frame ?? "") ?? -1;
    if (i < 0 || i >= count || !drawn[i]) return null;
    return {
      position: Array.from(positions.subarray(i * 3, i * 3 + 3)) as Vector,
      quaternion: Array.from(quaternions.subarray(i * 4, i * 4 + 4)) as Quaternion,
    };
  }
}

function isPaneSettings(value: unknown): value is PaneSettings {
  const settings = value as Partial<PaneSettings> | null;
  const known = KINDS.some(([kind]) => kind === settings?.kind);
  return known && (settings?.frame === null || typeof settings?.frame === "string");
}
