// SPDX-License-Identifier: Apache-2.0
/** Adjusts one static transform by hand: shows the gizmo and changes the frame updates of this page. */

import type { Model } from "../model/model";
import type { FrameUpdate } from "../protocol/messages";
import type { Pose } from "../util/math";
import { applyAdjustment, poseInParent } from "./adjustment";
import type { FramePoses } from "./frame_poses";
import { Gizmo, type GizmoMode } from "./gizmo";
import type { SceneRenderer } from "./renderer";

/** A transform that is being adjusted. */
export interface AdjustedTransform {
  parent: string;
  child: string;
  /** The pose of the child relative to the parent when the adjustment began, and now. */
  originalPose: Pose;
  pose: Pose;
}

export class Adjuster {
  current: AdjustedTransform | null = null;
  private gizmo: Gizmo | null = null;
  private readonly listeners: (() => void)[] = [];

  constructor(
    private readonly model: Model,
    private readonly renderer: SceneRenderer,
    private readonly redraw: () => void,
  ) {
    model.on("tree", () => {
      if (this.current && this.frames() === null) this.stop();
    });
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  /** Whether a frame has a static transform to its parent. */
  canAdjust(frame: string | null): boolean {
    const found = this.model.forest.frames[this.model.forest.index.get(frame ?? "") ?? -1];
    return found !== undefined && found.static && found.parent >= 0;
  }

  start(frame: string, mode: GizmoMode): void {
    const { forest, frameUpdate } = this.model;
    const i = forest.index.get(frame) ?? -1;
    const pose = frameUpdate && this.canAdjust(frame) ? poseInParent(frameUpdate, forest, i) : null;
    if (!pose || !pose.position.every(Number.isFinite)) return;
    this.stop();
    this.current = { parent: forest.name(forest.frames[i]?.parent ?? -1), child: frame, originalPose: pose, pose };
    const { scene, camera, canvas } = this.renderer;
    const redraw = (): void => this.renderer.invalidate();
    this.gizmo = new Gizmo(scene, camera, canvas, (changed) => this.set(changed), redraw);
    this.gizmo.setMode(mode);
    this.notify();
  }

  stop(): void {
    this.gizmo?.dispose();
    this.gizmo = null;
    this.current = null;
    this.notify();
  }

  setMode(mode: GizmoMode): void {
    this.gizmo?.setMode(mode);
    this.redraw();
  }

  set(pose: Pose): void {
    if (this.current) this.current = { ...this.current, pose };
    this.notify();
  }

  get isHovered(): boolean {
    return this.gizmo?.isHovered ?? false;
  }

  /** The update with the adjusted transform; the same update if nothing is adjusted. */
  apply(update: FrameUpdate): FrameUpdate {
    const frames = this.frames();
    if (!this.current || !frames) return update;
    const adjustment = { frame: frames.child, pose: this.current.pose };
    return applyAdjustment(update, this.model.forest, this.model.fixed, adjustment);
  }

  /** Moves the gizmo after the poses of an adjusted update are set. */
  place(framePoses: FramePoses): void {
    const frames = this.frames();
    if (this.current && frames && frames.parent < framePoses.count)
      this.gizmo?.place(framePoses, frames.parent, this.current.pose);
  }

  /** The indices of the two frames; null if there is no longer a static transform between them. */
  private frames(): { parent: number; child: number } | null {
    const { forest } = this.model;
    const child = forest.index.get(this.current?.child ?? "") ?? -1;
    const parent = forest.frames[child]?.parent ?? -1;
    return this.current && forest.frames[child]?.static && forest.name(parent) === this.current.parent
      ? { parent, child }
      : null;
  }

  private notify(): void {
    for (const listener of this.listeners) listener();
    this.redraw();
  }
}
