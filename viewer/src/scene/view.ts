// SPDX-License-Identifier: Apache-2.0
/** The picture as a whole: frames, names, what is highlighted or measured, and which frame a click means. */

import * as THREE from "three";
import { FramesView, type FrameOptions } from "./frames";
import { LabelLayer, type Label } from "./labels";
import { Measure } from "./measure";
import type { Model } from "../model/model";
import { Placement } from "./frame_poses";
import type { Tick } from "../protocol/messages";
import { Stage } from "./renderer";
import type { Theme } from "../util/theme";

const PICK_PX = 18;
const CLICK_PX = 5;
/** Trees larger than this are looked through for frames that stand far away. */
const FAR_APART_M = 300;
const OUTLIER = 20;
/** So far around the frames data is looked at, too. */
const NEAR_M = 1;
const FIT_AGAIN_MS = [1000, 3000];

export interface TfOptions extends FrameOptions {
  names: boolean;
}

export class View {
  readonly stage: Stage;
  readonly placement = new Placement();
  readonly measure: Measure;
  /** The tick whose poses are in the scene. */
  shown: Tick | null = null;
  /** Ticks drawn so far. */
  ticks = 0;
  tf: TfOptions = { scale: 1, axes: true, arrows: true, names: true };
  tfShown = true;
  followed: string | null = null;
  private readonly frames: FramesView;
  private readonly labels: LabelLayer;
  private pending: Tick | null = null;
  private stale = true;
  private fitted = false;
  private readonly bounds: (() => THREE.Box3)[] = [];
  private chain: number[] = [];
  private readonly placed: ((placement: Placement, tick: Tick) => void)[] = [];
  private readonly taken: ((tick: Tick) => void)[] = [];
  private readonly finished: ((tick: Tick | null) => void)[] = [];

  constructor(
    private readonly model: Model,
    private readonly theme: Theme,
    canvas: HTMLCanvasElement,
    labels: HTMLElement,
  ) {
    const palette = theme.palette();
    this.frames = new FramesView(palette);
    this.labels = new LabelLayer(labels);
    this.measure = new Measure(palette);
    this.stage = new Stage(
      canvas,
      palette,
      () => this.prepare(),
      () => this.finish(),
    );
    this.stage.scene.add(this.frames.object, this.measure.object);
    this.stage.announce(this.frames.usual);
    theme.onChange(() => this.recolour());
    model.on("tick", (tick) => {
      this.pending = tick;
      this.refresh();
    });
    model.on("tree", () => this.refresh());
    model.on("visibility", () => this.refresh());
    model.on("selection", () => this.refresh());
    model.on("relation", (relation) => {
      const indices = relation.ok ? relation.chain.map((name) => model.forest.index.get(name) ?? -1) : [];
      this.chain = indices.filter((i) => i >= 0);
      this.refresh();
    });
    this.listenForClicks(canvas);
  }

  /** Called with each tick's poses in place, before the picture is made. */
  onPlaced(listener: (placement: Placement, tick: Tick) => void): void {
    this.placed.push(listener);
  }

  /** Called when a tick is about to be drawn: the server may make the next one meanwhile. */
  onTaken(listener: (tick: Tick) => void): void {
    this.taken.push(listener);
  }

  /** Called after each picture, with the tick that it showed first, if it did. */
  onDrawn(listener: (tick: Tick | null) => void): void {
    this.finished.push(listener);
  }

  /** Something other than the camera changed. */
  refresh(): void {
    this.stale = true;
    this.stage.invalidate();
  }

  /** Looks at everything that is drawn. */
  fit(): void {
    const { positions, drawn, count } = this.placement;
    const points: THREE.Vector3[] = [];
    for (let i = 0; i < count; i++) if (drawn[i]) points.push(new THREE.Vector3().fromArray(positions, i * 3));
    const box = new THREE.Box3().setFromPoints(withoutOutliers(points));
    // Of a scan that reaches far, what is around the frames is seen; all of it where there are no frames.
    const near = box.clone().expandByScalar(Math.max(NEAR_M, box.getSize(new THREE.Vector3()).length() / 3));
    for (const bounds of this.bounds) {
      const own = bounds();
      box.union(near.isEmpty() ? own : own.intersect(near));
    }
    if (!box.isEmpty()) this.stage.camera.fit(box.expandByScalar(0.1));
  }

  /** Others whose things are to be seen when everything is looked at. */
  onFit(bounds: () => THREE.Box3): void {
    this.bounds.push(bounds);
  }

  /** The camera was set by somebody: do not move it when the first frames come. */
  keepCamera(): void {
    this.fitted = true;
  }

  position(frame: string): THREE.Vector3 | null {
    const i = this.model.forest.index.get(frame) ?? -1;
    if (i < 0 || i >= this.placement.count || !this.placement.drawn[i]) return null;
    return new THREE.Vector3().fromArray(this.placement.positions, i * 3);
  }

  setFollowed(frame: string | null): void {
    this.followed = frame;
    this.stage.camera.follow(null);
    this.refresh();
  }

  private prepare(): void {
    const { model, placement } = this;
    if (this.pending) for (const listener of this.taken) listener(this.pending);
    if (!this.stale || !model.tick) return;
    this.stale = false;
    this.shown = model.tick;
    const moved = placement.update(model, model.tick, performance.now());
    if (moved) this.stage.camera.shift(moved);
    this.frames.object.visible = this.tfShown;
    this.frames.update(placement, model.forest, this.tf);
    this.frames.setChain(placement, model.selection.frame ? this.chain : []);
    this.measure.update((frame) => this.position(frame));
    if (this.followed) {
      const position = this.position(this.followed);
      if (position) this.stage.camera.follow(position);
    }
    for (const listener of this.placed) listener(placement, model.tick);
    if (!this.fitted && (placement.drawn.includes(1) || this.bounds.some((bounds) => !bounds().isEmpty()))) {
      this.fitted = true;
      this.fit();
      this.fitAgain();
    }
  }

  /** Data comes a moment after the frames: look at that too, if nobody has touched the camera since. */
  private fitAgain(): void {
    const { canvas, camera } = this.stage;
    let touched = false;
    for (const event of ["pointerdown", "wheel"] as const)
      canvas.addEventListener(event, () => (touched = true), { once: true, passive: true });
    const mode = camera.mode;
    for (const wait of FIT_AGAIN_MS)
      setTimeout(() => {
        if (!touched && camera.mode === mode && this.followed === null) this.fit();
      }, wait);
  }

  private finish(): void {
    this.labels.draw(this.collectLabels(), this.stage.camera.current, this.stage.width, this.stage.height);
    const tick = this.pending;
    this.pending = null;
    if (tick) this.ticks++;
    for (const listener of this.finished) listener(tick);
  }

  private collectLabels(): Label[] {
    const { forest, selection } = this.model;
    const { placement } = this;
    const labels: Label[] = [];
    const chain = new Set(selection.frame ? this.chain : []);
    const several = forest.components.length > 1;
    const own = forest.frames[forest.index.get(this.model.fixed) ?? -1]?.component;
    for (let i = 0; i < placement.count; i++) {
      if (!placement.drawn[i]) continue;
      const name = forest.name(i);
      const root = (forest.frames[i]?.parent ?? -1) < 0;
      const chosen = name === selection.frame || name === selection.reference;
      const position = new THREE.Vector3().fromArray(placement.positions, i * 3);
      if (root && several && forest.frames[i]?.component !== own)
        labels.push({
          key: `tree ${name}`,
          text: `${name}: its own tree`,
          position,
          priority: -3,
          className: "caption",
        });
      if (!chosen && !(this.tf.names && this.tfShown)) continue;
      const fade = (placement.fade[i] as number) > 0;
      labels.push({
        key: name,
        text: name,
        position,
        priority: chosen ? -2 : chain.has(i) ? -1.5 : root ? 0 : 1,
        className: chosen || chain.has(i) ? "chosen" : fade ? "faded" : root ? "root" : "",
      });
    }
    const measured = this.measure.label();
    if (measured) labels.push(measured);
    return labels;
  }

  private recolour(): void {
    const palette = this.theme.palette();
    this.stage.setPalette(palette);
    this.frames.setPalette(palette);
    this.measure.setPalette(palette);
    this.refresh();
  }

  /** A click is a press that did not become a drag; it means the nearest frame, if one is near. */
  private listenForClicks(canvas: HTMLCanvasElement): void {
    let down: { x: number; y: number } | null = null;
    canvas.addEventListener("pointerdown", (event) => {
      down = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    });
    canvas.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > CLICK_PX) return;
      const bounds = canvas.getBoundingClientRect();
      const frame = this.pick(event.clientX - bounds.left, event.clientY - bounds.top);
      if (this.measure.active) {
        if (frame) this.measure.add(frame);
        this.refresh();
      } else this.model.select(frame);
    });
  }

  private pick(x: number, y: number): string | null {
    const camera = this.stage.camera.current;
    const { placement } = this;
    const point = new THREE.Vector3();
    let best: { i: number; far: number } | null = null;
    for (let i = 0; i < placement.count; i++) {
      if (!placement.drawn[i]) continue;
      point.fromArray(placement.positions, i * 3).project(camera);
      if (point.z < -1 || point.z > 1) continue;
      const px = ((point.x + 1) / 2) * this.stage.width;
      const py = ((1 - point.y) / 2) * this.stage.height;
      // Depth decides between frames at one place.
      const far = Math.hypot(px - x, py - y) + point.z * 1e-3;
      if (far < PICK_PX && (!best || far < best.far)) best = { i, far };
    }
    return best ? this.model.forest.name(best.i) : null;
  }
}

/** Where a few frames are kilometres away from all others, the others are what one wants to see. */
function withoutOutliers(points: THREE.Vector3[]): THREE.Vector3[] {
  if (new THREE.Box3().setFromPoints(points).getSize(new THREE.Vector3()).length() < FAR_APART_M) return points;
  const middle = (axis: "x" | "y" | "z"): number => median(points.map((point) => point[axis]));
  const centre = new THREE.Vector3(middle("x"), middle("y"), middle("z"));
  const usual = Math.max(1, median(points.map((point) => point.distanceTo(centre))));
  return points.filter((point) => point.distanceTo(centre) <= OUTLIER * usual);
}

function median(values: number[]): number {
  return values.sort((a, b) => a - b)[values.length >> 1] ?? 0;
}
