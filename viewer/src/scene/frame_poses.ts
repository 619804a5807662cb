// SPDX-License-Identifier: Apache-2.0
/**
 * The poses of the frames in the scene.
 *
 * The scene has its own origin near the first poses received, so that float32 on the graphics card is precise enough
 * for UTM coordinates. Trees that are not connected to the fixed frame are drawn next to it.
 */

import { FrameState, type FrameUpdate, type Vector } from "../protocol/messages";
import type { Forest, Model } from "../model/model";

/** Beyond this distance the origin is moved: the resolution of float32 is 0.06 mm there. */
const MAX_ORIGIN_DISTANCE_M = 1000;
const TREE_GAP_M = 1;
const MAX_TREE_RADIUS_M = 1e4;

export class FramePoses {
  /** Scene coordinates in meters, count x 3. */
  positions = new Float64Array(0);
  /** x, y, z, w, count x 4. */
  quaternions = new Float32Array(0);
  drawn = new Uint8Array(0);
  /** From 0 (fresh) to 1 (invisible). */
  fade = new Float32Array(0);
  count = 0;
  /** World coordinates of the scene's origin. */
  origin: Vector = [0, 0, 0];
  /** The x offset of each tree; zero for the tree of the fixed frame. */
  offsets: number[] = [];
  frameTimeout = 15;
  private hasStarted = false;
  private fixedFrame = "";
  private radii: number[] = [];

  /** Applies a frame update. Returns the movement of the scene's origin, or null if it did not move. */
  update(model: Model, update: FrameUpdate, now: number): Vector | null {
    const forest = model.forest;
    const moved = this.moveOrigin(update, model.fixed);
    if (update.revision !== forest.revision || update.count !== forest.frames.length) return moved;
    this.resize(update.count);
    this.arrangeTrees(forest, update, model.fixed);
    const age = (now - model.statsReceived) / 1000;
    const dx = update.origin[0] - this.origin[0];
    const dy = update.origin[1] - this.origin[1];
    const dz = update.origin[2] - this.origin[2];
    for (let i = 0; i < update.count; i++) {
      const p = i * 7;
      const state = update.states[i];
      const foreign = state === FrameState.otherTree;
      const side = foreign ? (this.offsets[forest.frames[i]?.component ?? 0] ?? 0) : 0;
      this.positions[i * 3] = (update.poses[p] as number) + (foreign ? side : dx);
      this.positions[i * 3 + 1] = (update.poses[p + 1] as number) + (foreign ? 0 : dy);
      this.positions[i * 3 + 2] = (update.poses[p + 2] as number) + (foreign ? 0 : dz);
      for (let k = 0; k < 4; k++) this.quaternions[i * 4 + k] = update.poses[p + 3 + k] as number;
      this.fade[i] = this.fadeOf(model, i, state, age);
      this.drawn[i] = Number(
        this.fade[i] < 1 && state !== FrameState.gone && isFinitePose(update.poses, p) && model.isShown(forest.name(i)),
      );
    }
    return moved;
  }

  private resize(count: number): void {
    if (this.count === count) return;
    this.count = count;
    this.positions = new Float64Array(count * 3);
    this.quaternions = new Float32Array(count * 4);
    this.drawn = new Uint8Array(count);
    this.fade = new Float32Array(count);
  }

  private moveOrigin(update: FrameUpdate, fixed: string): Vector | null {
    const delta: Vector = [
      update.origin[0] - this.origin[0],
      update.origin[1] - this.origin[1],
      update.origin[2] - this.origin[2],
    ];
    if (!delta.every(Number.isFinite)) return null;
    const other = this.fixedFrame !== fixed;
    if (this.hasStarted && !other && Math.hypot(...delta) < MAX_ORIGIN_DISTANCE_M) return null;
    this.origin = [...update.origin];
    const first = !this.hasStarted || other;
    this.hasStarted = true;
    this.fixedFrame = fixed;
    // All coordinates change with the fixed frame, so the camera keeps its position near the origin.
    return first ? null : delta;
  }

  private fadeOf(model: Model, i: number, state: number | undefined, sinceStats: number): number {
    const stats = model.stats?.revision === model.forest.revision ? model.stats.frames[i] : undefined;
    if (model.forest.frames[i]?.static || !stats || stats.age === null) return state === FrameState.stale ? 0.6 : 0;
    const age = stats.age + (model.clock.live ? sinceStats : 0);
    const aging = state === FrameState.stale || stats.state === "stale" || stats.state === "gone";
    if (!aging || this.frameTimeout <= 0) return 0;
    return age >= this.frameTimeout ? 1 : 0.25 + 0.7 * Math.max(0, age / this.frameTimeout);
  }

  /** The space of a tree only grows, so that trees keep their positions while their frames move. */
  private arrangeTrees(forest: Forest, update: FrameUpdate, fixed: string): void {
    if (this.radii.length !== forest.components.length) this.radii = forest.components.map(() => 0);
    if (forest.components.length < 2) {
      this.offsets = [0];
      return;
    }
    const own = forest.frames[forest.index.get(fixed) ?? -1]?.component ?? -1;
    for (let i = 0; i < update.count; i++) {
      const c = forest.frames[i]?.component ?? 0;
      const foreign = update.states[i] === FrameState.otherTree;
      const x = (update.poses[i * 7] as number) + (foreign ? 0 : update.origin[0] - this.origin[0]);
      const y = (update.poses[i * 7 + 1] as number) + (foreign ? 0 : update.origin[1] - this.origin[1]);
      const radius = Math.min(MAX_TREE_RADIUS_M, Math.hypot(x, y));
      if (radius > (this.radii[c] ?? 0)) this.radii[c] = radius * 1.1;
    }
    let edge = this.radii[own] ?? 0;
    this.offsets = this.radii.map((radius, c) => {
      if (c === own) return 0;
      const center = edge + TREE_GAP_M + radius;
      edge = center + radius;
      return center;
    });
  }
}

function isFinitePose(poses: Float32Array, at: number): boolean {
  for (let k = 0; k < 7; k++) if (!Number.isFinite(poses[at + k] as number)) return false;
  return true;
}
