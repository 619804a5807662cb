// SPDX-License-Identifier: Apache-2.0
/** A static transform that the user adjusts by hand: its effect on the poses of a frame update. */

import type { Forest } from "../model/model";
import { FrameState, type FrameUpdate } from "../protocol/messages";
import { compose, inverse, normalize, relativePose, type Pose, type Quaternion, type Vector } from "../util/math";

export interface Adjustment {
  /** The index of the child frame. */
  frame: number;
  /** The adjusted pose of the child relative to its parent. */
  pose: Pose;
}

/** The pose of a frame of an update. */
export function poseAt(poses: ArrayLike<number>, i: number): Pose {
  const [x, y, z, ...quaternion] = Array.from({ length: 7 }, (_, k) => poses[i * 7 + k] as number) as [
    number,
    number,
    number,
    ...Quaternion,
  ];
  return { position: [x, y, z], quaternion };
}

/**
 * Returns a copy of a frame update as it would be with the adjusted transform. Everything below the frame moves, or, if
 * the fixed frame is below it, everything else. Displayed messages move with their frames.
 */
export function applyAdjustment(
  update: FrameUpdate,
  forest: Forest,
  fixed: string,
  adjustment: Adjustment,
): FrameUpdate {
  const { frame, pose } = adjustment;
  const parent = forest.frames[frame]?.parent ?? -1;
  if (parent < 0 || update.revision !== forest.revision) return update;
  const [parentPose, framePose] = [poseAt(update.poses, parent), poseAt(update.poses, frame)];
  const below = new Set(forest.subtree(frame));
  const fixedIsBelow = below.has(forest.index.get(fixed) ?? -1);
  const tree = forest.frames[frame]?.component;
  const moves = (i: number): boolean => i >= 0 && forest.frames[i]?.component === tree && below.has(i) !== fixedIsBelow;
  // How everything that moves does so, expressed in the fixed frame.
  const movement = fixedIsBelow
    ? compose(compose(framePose, inverse(pose)), inverse(parentPose))
    : compose(compose(parentPose, pose), inverse(framePose));
  const poses = update.poses.slice();
  for (let i = 0; i < update.count; i++)
    if (moves(i) && update.states[i] !== FrameState.otherTree) write(poses, i * 7, compose(movement, poseAt(poses, i)));
  const displays = update.displays.map((entry) => {
    if (!entry.ok || !moves(entry.frame)) return entry;
    const own = poseAt(entry.pose, 0);
    let moved = compose(movement, own);
    if (!fixedIsBelow) {
      // A message has the pose of its own stamp, when the parent may have been somewhere else.
      const message = poseAt(update.poses, entry.frame);
      const correction = compose(relativePose(framePose, parentPose), pose);
      moved = compose(
        compose(compose(own, relativePose(message, framePose)), correction),
        relativePose(framePose, message),
      );
    }
    const changed = entry.pose.slice();
    write(changed, 0, moved);
    return { ...entry, pose: changed };
  });
  return { ...update, poses, displays };
}

function write(out: Float32Array, at: number, { position, quaternion }: Pose): void {
  out.set([...position, ...quaternion], at);
}

/** The pose of a frame relative to its parent, rounded to micrometers because updates have float32 coordinates. */
export function poseInParent(update: FrameUpdate, forest: Forest, frame: number): Pose | null {
  const parent = forest.frames[frame]?.parent ?? -1;
  if (parent < 0 || update.revision !== forest.revision) return null;
  const { position, quaternion } = relativePose(poseAt(update.poses, parent), poseAt(update.poses, frame));
  const round = (value: number): number => Math.round(value * 1e6) / 1e6;
  return { position: position.map(round) as Vector, quaternion: normalize(quaternion.map(round) as Quaternion) };
}
