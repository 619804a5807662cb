// SPDX-License-Identifier: Apache-2.0
/**
 * Where each frame stands in the scene.
 *
 * The scene has its own origin, near the first poses that came, so that float32 on the graphics card is exact also
 * where coordinates are UTM metres. Trees that are not connected with the fixed frame stand beside it on the ground.
 */

import { FrameState, type Tick, type Vector } from "../protocol/messages";
import type { Forest, Model } from "../model/model";

/** Further than this from its origin the scene is moved: float32 has 0.06 mm steps there. */
const FARTHEST_M = 1000;
const TREE_GAP_M = 1;
const LARGEST_TREE_M = 1e4;

export class Placement {
  /** Scene coordinates, count x 3. */
  positions = new Float64Array(0);
  /** count x 4. */
  quaternions = new Float32Array(0);
  drawn = new Uint8Array(0);
  /** 0 fresh, 1 as good as gone. */
  fade = new Float32Array(0);
  count = 0;
  /** World coordinates of the scene's origin. */
  origin: Vector = [0, 0, 0];
  /** On the ground, by component; the fixed frame's own stands at zero. */
  offsets: number[] = [];
  frameTimeout = 15;
  private started = false;
  private fixed = "";
  private radii: number[] = [];

  /** Takes the tick's poses; returns how far the scene's origin moved, when it did. */
  update(model: Model, tick: Tick, now: number): Vector | null {
    const forest = model.forest;
    const moved = this.moveOrigin(tick, model.fixed);
    if (tick.revision !== forest.revision || tick.count !== forest.frames.length) return moved;
    this.resize(tick.count);
    this.arrangeTrees(forest, tick, model.fixed);
    const age = (now - model.statsReceived) / 1000;
    const dx = tick.origin[0] - this.origin[0];
    const dy = tick.origin[1] - this.origin[1];
    const dz = tick.origin[2] - this.origin[2];
    for (let i = 0; i < tick.count; i++) {
      const p = i * 7;
      const state = tick.states[i];
      const foreign = state === FrameState.otherTree;
      const side = foreign ? (this.offsets[forest.frames[i]?.component ?? 0] ?? 0) : 0;
      this.positions[i * 3] = (tick.poses[p] as number) + (foreign ? side : dx);
      this.positions[i * 3 + 1] = (tick.poses[p + 1] as number) + (foreign ? 0 : dy);
      this.positions[i * 3 + 2] = (tick.poses[p + 2] as number) + (foreign ? 0 : dz);
      for (let k = 0; k < 4; k++) this.quaternions[i * 4 + k] = tick.poses[p + 3 + k] as number;
      this.fade[i] = this.fadeOf(model, i, state, age);
      this.drawn[i] = Number(
        this.fade[i] < 1 && state !== FrameState.gone && finite(tick.poses, p) && model.isShown(forest.name(i)),
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

  private moveOrigin(tick: Tick, fixed: string): Vector | null {
    const delta: Vector = [
      tick.origin[0] - this.origin[0],
      tick.origin[1] - this.origin[1],
      tick.origin[2] - this.origin[2],
    ];
    if (!delta.every(Number.isFinite)) return null;
    const other = this.fixed !== fixed;
    if (this.started && !other && Math.hypot(...delta) < FARTHEST_M) return null;
    this.origin = [...tick.origin];
    const first = !this.started || other;
    this.started = true;
    this.fixed = fixed;
    // In another fixed frame all coordinates are new: the camera stays where it looks, near the origin.
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

  /** Trees only ever get more room, so that none dances while its frames move. */
  private arrangeTrees(forest: Forest, tick: Tick, fixed: string): void {
    if (this.radii.length !== forest.components.length) this.radii = forest.components.map(() => 0);
    if (forest.components.length < 2) {
      this.offsets = [0];
      return;
    }
    const own = forest.frames[forest.index.get(fixed) ?? -1]?.component ?? -1;
    for (let i = 0; i < tick.count; i++) {
      const c = forest.frames[i]?.component ?? 0;
      const foreign = tick.states[i] === FrameState.otherTree;
      const x = (tick.poses[i * 7] as number) + (foreign ? 0 : tick.origin[0] - this.origin[0]);
      const y = (tick.poses[i * 7 + 1] as number) + (foreign ? 0 : tick.origin[1] - this.origin[1]);
      const radius = Math.min(LARGEST_TREE_M, Math.hypot(x, y));
      if (radius > (this.radii[c] ?? 0)) this.radii[c] = radius * 1.1;
    }
    let edge = this.radii[own] ?? 0;
    this.offsets = this.radii.map((radius, c) => {
      if (c === own) return 0;
      const centre = edge + TREE_GAP_M + radius;
      edge = centre + radius;
      return centre;
    });
  }
}

function finite(poses: Float32Array, at: number): boolean {
  for (let k = 0; k < 7; k++) if (!Number.isFinite(poses[at + k] as number)) return false;
  return true;
}
