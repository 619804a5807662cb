// SPDX-License-Identifier: Apache-2.0
/** The 3D view: frames, labels, highlights, measurements and clicks. */

import * as THREE from "three";
import { Adjuster } from "./adjuster";
import { FramesView, type FrameOptions } from "./frames";
import { LabelLayer, type Label } from "./labels";
import { Measure, type MeasuredEnd } from "./measure";
import type { Model } from "../model/model";
import { FramePoses } from "./frame_poses";
import { Highlight } from "./highlight";
import { Picker, type Hit } from "./picking";
import { Panes } from "./panes";
import { PointerTools, type PixelBox } from "./tools";
import type { Reference } from "./camera";
import type { FrameUpdate, Json, JsonObject, RvizView, Vector } from "../protocol/messages";
import { SceneRenderer } from "./renderer";
import type { Theme } from "../util/theme";

const PICK_PX = 18;
const CLICK_PX = 5;
const HOVER_INTERVAL_MS = 60;
/** Frames far away from all others are ignored when fitting the camera, if the frames span more than this. */
const OUTLIER_SPAN_M = 300;
/** An outlier is this many times as far away as the median frame. */
const OUTLIER_FACTOR = 20;
/** The distance around the frames in which displayed data is included when fitting the camera. */
const FIT_MARGIN_M = 1;
/** Relative; the camera computes with float64, but its angles are recomputed from positions. */
const CAMERA_PRECISION = 1e-5;
const REFIT_MS = [1000, 3000];

export interface TfOptions extends FrameOptions {
  names: boolean;
}

export class View {
  readonly renderer: SceneRenderer;
  readonly framePoses = new FramePoses();
  readonly measure: Measure;
  readonly highlight: Highlight;
  readonly tools: PointerTools;
  readonly adjuster: Adjuster;
  readonly panes: Panes;
  /** The frame update whose poses are in the scene. */
  shown: FrameUpdate | null = null;
  /** The number of frame updates drawn. */
  updates = 0;
  tf: TfOptions = { scale: 1, axes: true, arrows: true, names: true };
  tfShown = true;
  followed: string | null = null;
  /** A view whose target frame is not known yet. */
  private waitingView: RvizView | null = null;
  /** The view of a file, and its description right after it was applied. */
  private fileView: { view: RvizView; before: RvizView | null } | null = null;
  private readonly frames: FramesView;
  private readonly labels: LabelLayer;
  private pendingUpdate: FrameUpdate | null = null;
  private needsDraw = true;
  private hasFitted = false;
  /** Whether the user has moved the camera, so that it is not fitted again automatically. */
  private cameraChosen = false;
  private readonly bounds: (() => THREE.Box3)[] = [];
  private chain: number[] = [];
  private readonly picker = new Picker();
  /** Where the first click of a double-click was: it can open a panel, which moves the scene under the pointer. */
  private readonly firstClick = new Picker();
  private readonly surfaces: (() => THREE.Object3D[])[] = [];
  private readonly clickListeners: ((event: PointerEvent) => boolean)[] = [];
  private readonly missListeners: ((event: PointerEvent) => boolean)[] = [];
  private readonly hoverListeners: ((event: PointerEvent) => boolean)[] = [];
  private readonly pointListeners: ((point: Vector) => void)[] = [];
  private readonly posesListeners: ((framePoses: FramePoses, update: FrameUpdate) => void)[] = [];
  private readonly beforeDrawListeners: ((update: FrameUpdate) => void)[] = [];
  private readonly drawnListeners: ((update: FrameUpdate | null) => void)[] = [];

  constructor(
    private readonly model: Model,
    private readonly theme: Theme,
    canvas: HTMLCanvasElement,
    labels: HTMLElement,
    panes: HTMLElement,
  ) {
    const palette = theme.palette();
    this.frames = new FramesView(palette);
    this.labels = new LabelLayer(labels);
    this.measure = new Measure(palette);
    this.highlight = new Highlight(palette);
    this.renderer = new SceneRenderer(
      canvas,
      palette,
      () => this.prepare(),
      () => this.finish(),
    );
    this.tools = new PointerTools(canvas, this);
    this.adjuster = new Adjuster(model, this.renderer, () => this.refresh());
    this.tools.onChange((tool) => this.measure.setActive(tool === "measure"));
    this.panes = new Panes(
      panes,
      model,
      this.renderer,
      () => this.refresh(),
      () => this.content(),
    );
    this.renderer.scene.add(this.frames.object, this.measure.object, this.highlight.object, this.tools.object);
    this.renderer.compile(this.frames.alwaysDrawn);
    theme.onChange(() => this.recolor());
    model.on("frames", (update) => {
      this.pendingUpdate = update;
      this.refresh();
    });
    model.on("tree", () => this.refresh());
    model.on("fixed", () => this.measure.forgetPoints());
    model.on("visibility", () => this.refresh());
    model.on("selection", () => this.refresh());
    model.on("relation", (relation) => {
      const indices = relation.ok ? relation.chain.map((name) => model.forest.index.get(name) ?? -1) : [];
      this.chain = indices.filter((i) => i >= 0);
      this.refresh();
    });
    this.listenForClicks(canvas);
  }

  /** Calls the listener after the poses of a frame update are set, before drawing. */
  onPoses(listener: (framePoses: FramePoses, update: FrameUpdate) => void): void {
    this.posesListeners.push(listener);
  }

  /** Calls the listener before a frame update is drawn, so that the server can prepare the next one. */
  onBeforeDraw(listener: (update: FrameUpdate) => void): void {
    this.beforeDrawListeners.push(listener);
  }

  /** Calls the listener after each draw, with the frame update if it is a new one. */
  onDrawn(listener: (update: FrameUpdate | null) => void): void {
    this.drawnListeners.push(listener);
  }

  /** Redraws the scene after a change of anything but the camera. */
  refresh(): void {
    this.needsDraw = true;
    this.renderer.invalidate();
  }

  /** Moves the camera so that everything is visible. */
  fit(): void {
    const box = this.content();
    if (!box.isEmpty()) this.renderer.camera.fit(box.expandByScalar(0.1));
  }

  /** The box around the frames and the data near them. */
  private content(): THREE.Box3 {
    const { positions, drawn, count } = this.framePoses;
    const points: THREE.Vector3[] = [];
    for (let i = 0; i < count; i++) if (drawn[i]) points.push(new THREE.Vector3().fromArray(positions, i * 3));
    const box = new THREE.Box3().setFromPoints(removeOutliers(points));
    // Data far away from the frames, such as long scans, is ignored unless there are no frames.
    const near = box.clone().expandByScalar(Math.max(FIT_MARGIN_M, box.getSize(new THREE.Vector3()).length() / 3));
    for (const bounds of this.bounds) {
      const own = bounds();
      box.union(near.isEmpty() ? own : own.intersect(near));
    }
    return box;
  }

  /** Registers further objects that `fit` makes visible. */
  addBounds(bounds: () => THREE.Box3): void {
    this.bounds.push(bounds);
  }

  /** Registers objects on whose surfaces the tools find points. */
  addSurfaces(surfaces: () => THREE.Object3D[]): void {
    this.surfaces.push(surfaces);
  }

  /** Calls the listener with each point that the user clicks with the tool for points, in the fixed frame. */
  onPoint(listener: (point: Vector) => void): void {
    this.pointListeners.push(listener);
  }

  /** Calls the listener with each click without a tool; if it returns true, the click does not select a frame. */
  onClick(listener: (event: PointerEvent) => boolean): void {
    this.clickListeners.push(listener);
  }

  /** Calls the listener with each click that hits neither a frame nor what other listeners use. */
  onMiss(listener: (event: PointerEvent) => boolean): void {
    this.missListeners.push(listener);
  }

  /** Shows a hand above what the listener returns true for. */
  onHover(listener: (event: PointerEvent) => boolean): void {
    this.hoverListeners.push(listener);
  }

  /** What is visible under the pointer; null if it is none of these objects. */
  findHit(event: PointerEvent, roots: readonly THREE.Object3D[], lines = false): Hit | null {
    this.aim(event);
    return this.picker.findHit(roots, true, lines);
  }

  /** The frame whose origin is near the pointer. */
  frameAt(event: MouseEvent): string | null {
    const bounds = this.renderer.canvas.getBoundingClientRect();
    return this.pick(event.clientX - bounds.left, event.clientY - bounds.top);
  }

  /** Returns whether points of the scene are inside a rectangle of the canvas. */
  insideBox({ left, right, top, bottom }: PixelBox): (point: THREE.Vector3) => boolean {
    const { camera, width, height } = this.renderer;
    camera.current.updateMatrixWorld();
    const matrix = camera.current.projectionMatrix.clone().multiply(camera.current.matrixWorldInverse);
    const at = new THREE.Vector3();
    return (point) => {
      at.copy(point).applyMatrix4(matrix);
      const [x, y] = [((at.x + 1) / 2) * width, ((1 - at.y) / 2) * height];
      return at.z > -1 && at.z < 1 && x >= left && x <= right && y >= top && y <= bottom;
    };
  }

  /** Looks at the surface, or the ground, that a ray hits. */
  private focus(picker: Picker): void {
    const point = this.pointOn(picker);
    if (!point) return;
    this.cameraChosen = true;
    this.renderer.camera.lookAt(point);
  }

  /** Looks at a point of the fixed frame. */
  lookAt(point: Vector): void {
    this.cameraChosen = true;
    this.renderer.camera.lookAt(new THREE.Vector3(...point).sub(new THREE.Vector3(...this.framePoses.origin)));
  }

  /** The ray through the pixel under the pointer, in the scene. */
  rayAt(event: PointerEvent): THREE.Ray {
    this.aim(event);
    return this.picker.ray.clone();
  }

  groundAt(event: MouseEvent): THREE.Vector3 | null {
    this.aim(event);
    return this.groundOn(this.picker);
  }

  inFixedFrame(point: THREE.Vector3): Vector {
    return point.toArray().map((value, k) => value + (this.framePoses.origin[k] as number)) as Vector;
  }

  /**
   * Applies a view, and again as soon as the pose of its target frame is known. Returns whether its controller is
   * supported.
   *
   * @param view The view in the format of .rviz files.
   * @param isOfFile Whether it is the current view of an .rviz file, with which `describeView` compares later.
   */
  setView(view: RvizView, isOfFile = false): boolean {
    const target = view.options["Target Frame"];
    this.followed = typeof target === "string" && target && !target.startsWith("<") ? target : null;
    this.renderer.camera.follow(null);
    const supported = this.renderer.camera.apply(view, this.reference() ?? this.fixedFrame());
    this.waitingView = supported ? view : null;
    if (isOfFile) this.fileView = supported ? { view, before: null } : null;
    if (supported) this.hasFitted = this.cameraChosen = true; // The camera is not fitted to the first frames.
    this.refresh();
    return supported;
  }

  /** The view in the format of .rviz files. */
  get savedView(): RvizView {
    return this.renderer.camera.describe(this.followed, this.reference() ?? this.fixedFrame());
  }

  /** The view in the format of .rviz files: what has changed since that of the file was applied, or all of it. */
  describeView(): RvizView {
    const current = this.savedView;
    const whole = { class: current.class.replace(/^.*\//, ""), options: current.options };
    if (!this.fileView) return whole;
    const { view, before } = this.fileView;
    if (!before) return view;
    if (before.class !== current.class) return whole;
    return { class: whole.class, options: findChanges(before.options, current.options) };
  }

  /** The pose of the followed frame in the scene, or null if it is not known yet. */
  private reference(): Reference | null {
    if (this.followed === null) return this.framePoses.count > 0 ? this.fixedFrame() : null;
    const position = this.position(this.followed);
    const i = this.model.forest.index.get(this.followed) ?? -1;
    return position && { position, quaternion: new THREE.Quaternion().fromArray(this.framePoses.quaternions, i * 4) };
  }

  private fixedFrame(): Reference {
    const position = new THREE.Vector3(...this.framePoses.origin).negate();
    return { position, quaternion: new THREE.Quaternion() };
  }

  /** Moves the camera with the frame that it follows, or to the place that a file gives. */
  private moveCamera(): void {
    const { camera } = this.renderer;
    const reference = this.reference();
    if (!reference) return;
    const { waitingView, fileView } = this;
    if (waitingView) {
      camera.apply(waitingView, reference);
      if (fileView?.view === waitingView) fileView.before = camera.describe(this.followed, reference);
      this.waitingView = null;
    } else if (this.followed) camera.follow(reference);
  }

  position(frame: string): THREE.Vector3 | null {
    const i = this.model.forest.index.get(frame) ?? -1;
    if (i < 0 || i >= this.framePoses.count || !this.framePoses.drawn[i]) return null;
    return new THREE.Vector3().fromArray(this.framePoses.positions, i * 3);
  }

  setFollowed(frame: string | null): void {
    this.followed = frame;
    if (frame !== null) this.cameraChosen = true;
    this.renderer.camera.follow(null);
    // A view that still waits for its target frame is given up.
    if (this.fileView && this.fileView.view === this.waitingView) this.fileView = null;
    this.waitingView = null;
    this.refresh();
  }

  private prepare(): void {
    const { model, framePoses } = this;
    if (this.pendingUpdate) for (const listener of this.beforeDrawListeners) listener(this.pendingUpdate);
    if (!this.needsDraw || !model.frameUpdate) return;
    // After a change of the tree, the poses belong to the frames before it until the next frame update.
    if (model.frameUpdate.revision !== model.forest.revision) return;
    this.needsDraw = false;
    this.shown = model.frameUpdate;
    const update = this.adjuster.apply(model.frameUpdate);
    const moved = framePoses.update(model, update, performance.now());
    if (moved) this.renderer.camera.shift(moved);
    if (this.panes.count > 0) this.panes.update(framePoses, moved);
    this.frames.object.visible = this.tfShown;
    this.frames.update(framePoses, model.forest, this.tf);
    this.frames.setChain(framePoses, model.selection.frame ? this.chain : []);
    this.measure.update((end) => this.positionOf(end));
    this.moveCamera();
    this.adjuster.place(framePoses);
    this.highlight.place(framePoses.origin);
    for (const listener of this.posesListeners) listener(framePoses, update);
    if (!this.hasFitted && (framePoses.drawn.includes(1) || this.bounds.some((bounds) => !bounds().isEmpty()))) {
      this.hasFitted = true;
      this.fit();
      this.refitView();
    }
  }

  /** Fits again after data has arrived, unless the user has moved the camera or followed a frame. */
  private refitView(): void {
    const { canvas, camera } = this.renderer;
    for (const event of ["pointerdown", "wheel"] as const)
      canvas.addEventListener(event, () => (this.cameraChosen = true), { once: true, passive: true });
    const mode = camera.mode;
    for (const wait of REFIT_MS)
      setTimeout(() => {
        if (!this.cameraChosen && camera.mode === mode) this.fit();
      }, wait);
  }

  private finish(): void {
    const labels = this.collectLabels();
    this.labels.draw(labels, this.renderer.camera.current, this.renderer.width, this.renderer.height);
    this.panes.drawLabels(labels);
    const update = this.pendingUpdate;
    this.pendingUpdate = null;
    if (update) this.updates++;
    for (const listener of this.drawnListeners) listener(update);
  }

  private collectLabels(): Label[] {
    const { forest, selection } = this.model;
    const { framePoses } = this;
    const labels: Label[] = [];
    const chain = new Set(selection.frame ? this.chain : []);
    const several = forest.components.length > 1;
    const fixedTree = forest.frames[forest.index.get(this.model.fixed) ?? -1]?.component;
    for (let i = 0; i < framePoses.count; i++) {
      if (!framePoses.drawn[i]) continue;
      const name = forest.name(i);
      const root = (forest.frames[i]?.parent ?? -1) < 0;
      const chosen = name === selection.frame || name === selection.reference;
      const position = new THREE.Vector3().fromArray(framePoses.positions, i * 3);
      if (root && several && forest.frames[i]?.component !== fixedTree)
        labels.push({
          key: `tree ${name}`,
          text: `${name}: separate tree`,
          position,
          priority: -3,
          className: "caption",
        });
      if (!chosen && !(this.tf.names && this.tfShown)) continue;
      const fade = (framePoses.fade[i] as number) > 0;
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

  private recolor(): void {
    const palette = this.theme.palette();
    this.renderer.setPalette(palette);
    this.frames.setPalette(palette);
    this.measure.setPalette(palette);
    this.highlight.setPalette(palette);
    this.refresh();
  }

  /** A press without a drag is a click and selects the nearest frame within PICK_PX. */
  private listenForClicks(canvas: HTMLCanvasElement): void {
    let down: { x: number; y: number } | null = null;
    canvas.addEventListener("pointerdown", (event) => {
      down = event.button === 0 ? { x: event.clientX, y: event.clientY } : null;
    });
    let hovered = 0;
    canvas.addEventListener("pointermove", (event) => {
      const now = performance.now();
      if (event.buttons || this.tools.active || now - hovered < HOVER_INTERVAL_MS) return;
      canvas.style.cursor = this.hoverListeners.some((listener) => listener(event)) ? "pointer" : "";
      // Large clouds take a while to search, which must not make the page slow.
      hovered = performance.now() + 9 * (performance.now() - now);
    });
    canvas.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down.x, event.clientY - down.y) > CLICK_PX) return;
      const frame = this.frameAt(event);
      if (this.tools.active) this.use(event, frame);
      else if (!this.adjuster.isHovered && !this.clickListeners.some((used) => used(event))) this.click(event, frame);
    });
    canvas.addEventListener("mousedown", (event) => {
      if (event.detail === 1) this.aim(event, this.firstClick);
    });
    canvas.addEventListener("dblclick", (event) => {
      if (!this.tools.active && event.button === 0) this.focus(this.firstClick);
    });
  }

  private click(event: PointerEvent, frame: string | null): void {
    if (frame === null && this.missListeners.some((used) => used(event))) return;
    this.model.select(frame);
  }

  /** Uses the active tool at a frame, on a surface or on the ground plane. */
  private use(event: PointerEvent, frame: string | null): void {
    this.aim(event);
    const surface = this.pointOn(this.picker);
    const point = surface && this.inFixedFrame(surface);
    if (this.tools.active === "measure") {
      const end = frame ?? point;
      if (end) this.measure.add(end);
    } else if (this.tools.active === "point" && point) {
      this.tools.choose(null);
      for (const listener of this.pointListeners) listener(point);
    } else if (this.tools.active === "focus") {
      this.tools.choose(null);
      this.focus(this.picker);
    }
    this.refresh();
  }

  /** The point of a surface, or of the ground, that a ray hits. */
  private pointOn(picker: Picker): THREE.Vector3 | null {
    return picker.surface(this.surfaces.flatMap((found) => found())) ?? this.groundOn(picker);
  }

  private groundOn(picker: Picker): THREE.Vector3 | null {
    return picker.ground(-this.framePoses.origin[2]);
  }

  private aim(event: MouseEvent, picker = this.picker): void {
    const { camera, canvas, width, height } = this.renderer;
    const bounds = canvas.getBoundingClientRect();
    picker.aim(camera.current, event.clientX - bounds.left, event.clientY - bounds.top, width, height);
  }

  private positionOf(end: MeasuredEnd): THREE.Vector3 | null {
    if (typeof end === "string") return this.position(end);
    return new THREE.Vector3(...end).sub(new THREE.Vector3(...this.framePoses.origin));
  }

  private pick(x: number, y: number): string | null {
    const camera = this.renderer.camera.current;
    const { framePoses } = this;
    const point = new THREE.Vector3();
    let best: { i: number; far: number } | null = null;
    for (let i = 0; i < framePoses.count; i++) {
      if (!framePoses.drawn[i]) continue;
      point.fromArray(framePoses.positions, i * 3).project(camera);
      if (point.z < -1 || point.z > 1) continue;
      const px = ((point.x + 1) / 2) * this.renderer.width;
      const py = ((1 - point.y) / 2) * this.renderer.height;
      // Depth decides between frames at the same pixel.
      const far = Math.hypot(px - x, py - y) + point.z * 1e-3;
      if (far < PICK_PX && (!best || far < best.far)) best = { i, far };
    }
    return best ? this.model.forest.name(best.i) : null;
  }
}

/** The options that differ by more than the precision of the camera. */
function findChanges(before: JsonObject, after: JsonObject): JsonObject {
  const changed: JsonObject = {};
  for (const [key, value] of Object.entries(after)) {
    const earlier = before[key];
    if (typeof value === "number" && typeof earlier === "number") {
      if (Math.abs(value - earlier) > CAMERA_PRECISION * Math.max(1, Math.abs(earlier))) changed[key] = value;
    } else if (isObject(value) && isObject(earlier)) {
      const inner = findChanges(earlier, value);
      if (Object.keys(inner).length > 0) changed[key] = inner;
    } else if (value !== earlier) changed[key] = value;
  }
  return changed;
}

function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Removes points that are far away from all others, so that `fit` shows the others. */
function removeOutliers(points: THREE.Vector3[]): THREE.Vector3[] {
  if (new THREE.Box3().setFromPoints(points).getSize(new THREE.Vector3()).length() < OUTLIER_SPAN_M) return points;
  const middle = (axis: "x" | "y" | "z"): number => median(points.map((point) => point[axis]));
  const center = new THREE.Vector3(middle("x"), middle("y"), middle("z"));
  const typical = Math.max(1, median(points.map((point) => point.distanceTo(center))));
  return points.filter((point) => point.distanceTo(center) <= OUTLIER_FACTOR * typical);
}

function median(values: number[]): number {
  return values.sort((a, b) => a - b)[values.length >> 1] ?? 0;
}
