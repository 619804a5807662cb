// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { Forest } from "../src/model/model";
import type { FrameUpdate } from "../src/protocol/messages";
import { applyAdjustment, poseAt, poseInParent } from "../src/scene/adjustment";
import { compose, inverse, normalize, relativePose, type Pose } from "../src/util/math";
import { staticCommands } from "../src/util/static_commands";

const pose = (x: number, y: number, z: number, ...q: [number, number, number, number]): Pose => ({
  position: [x, y, z],
  quaternion: normalize(q),
});

/** map → base → lidar (static) → tip, and map → tree. Each pose is relative to the parent. */
const LOCAL = [
  pose(0, 0, 0, 0, 0, 0, 1),
  pose(1, 2, 0, 0, 0, 0.3, 0.9),
  pose(0.1, 0, 0.3, 0.1, 0, 0.2, 0.97),
  pose(0, 0.5, 0, 0.4, 0, 0, 0.9),
  pose(5, 0, 0, 0, 0, 0, 1),
];
const PARENTS = [-1, 0, 1, 2, 0];
const NAMES = ["map", "base", "lidar", "tip", "tree"];
const CHANGED = pose(0.2, -0.1, 0.4, 0, 0.2, 0.1, 0.95);
const forest = new Forest(
  1,
  NAMES.map((name, i) => ({ name, parent: PARENTS[i] as number, static: i === 2, component: 0 })),
  [{ root: "map", size: 5 }],
);

function inMap(i: number, local: Pose[]): Pose {
  const parent = PARENTS[i] as number;
  return parent < 0 ? (local[i] as Pose) : compose(inMap(parent, local), local[i] as Pose);
}

/** The poses of all frames in a fixed frame, by forward kinematics. */
function expected(fixed: number, local: Pose[]): Pose[] {
  return NAMES.map((_, i) => relativePose(inMap(fixed, local), inMap(i, local)));
}

function row({ position, quaternion }: Pose): number[] {
  return [...position, ...quaternion];
}

function update(fixed: number, entries: [frame: number, pose: Pose][]): FrameUpdate {
  return {
    kind: "frames",
    revision: 1,
    time: 0,
    origin: [0, 0, 0],
    count: 5,
    poses: new Float32Array(expected(fixed, LOCAL).flatMap(row)),
    states: new Uint8Array(5),
    displays: entries.map(([frame, own], i) => ({
      id: 1,
      sequence: i,
      frame,
      ok: true,
      pose: new Float32Array(row(own)),
    })),
  };
}

function expectPose(found: Pose, wanted: Pose): void {
  const { position, quaternion } = compose(inverse(found), wanted);
  for (const part of position) expect(part).toBeCloseTo(0, 5);
  expect(Math.abs(quaternion[3])).toBeCloseTo(1, 6);
}

describe("an adjusted static transform", () => {
  const changed = LOCAL.map((local, i) => (i === 2 ? CHANGED : local));

  it.each(NAMES.map((name, i) => [name, i] as const))("moves what it should in %s", (name, fixed) => {
    const wanted = expected(fixed, changed);
    const entries = expected(fixed, LOCAL).map((own, i) => [i, own] as [number, Pose]);
    const result = applyAdjustment(update(fixed, entries), forest, name, { frame: 2, pose: CHANGED });
    wanted.forEach((frame, i) => {
      expectPose(poseAt(result.poses, i), frame);
      expectPose(poseAt((result.displays[i] as { pose: Float32Array }).pose, 0), frame);
    });
  });

  it("moves messages by the pose of their own stamp", () => {
    const earlier = LOCAL.map((local, i) => (i === 1 ? pose(-3, 1, 0, 0, 0, 0.7, 0.7) : local));
    const message = expected(0, earlier)[3] as Pose;
    const result = applyAdjustment(update(0, [[3, message]]), forest, "map", { frame: 2, pose: CHANGED });
    const wanted = expected(
      0,
      earlier.map((local, i) => (i === 2 ? CHANGED : local)),
    );
    expectPose(poseAt((result.displays[0] as { pose: Float32Array }).pose, 0), wanted[3] as Pose);
  });

  it("leaves messages of unknown frames and the original update unchanged", () => {
    const before = update(0, [[-1, LOCAL[1] as Pose]]);
    const result = applyAdjustment(before, forest, "map", { frame: 2, pose: CHANGED });
    expect(result.displays[0]).toBe(before.displays[0]);
    expectPose(poseAt(before.poses, 2), expected(0, LOCAL)[2] as Pose);
    expectPose(poseInParent(before, forest, 2) as Pose, LOCAL[2] as Pose);
    expect(poseInParent(before, forest, 0)).toBeNull();
  });
});

it("the commands contain the transform", () => {
  const [coframe, ros, urdf] = staticCommands("base link", "lidar", pose(0.1, -0, 1 / 3, 0, 0, 1, 1)).map(
    ({ text }) => text,
  );
  const flags = "--x 0.1 --y 0 --z 0.333333 --qx 0 --qy 0 --qz 0.707107 --qw 0.707107";
  expect(coframe).toBe(`coframe static --frame-id 'base link' --child-frame-id lidar ${flags}`);
  expect(ros).toBe(
    `ros2 run tf2_ros static_transform_publisher --frame-id 'base link' --child-frame-id lidar ${flags}`,
  );
  expect(urdf).toBe('<origin xyz="0.1 0 0.333333" rpy="0 0 1.570796"/>');
});
