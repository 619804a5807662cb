// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { Kinematics } from "../src/displays/robot_kinematics";
import type { RobotJoint, RobotModel } from "../src/protocol/messages";
import { IDENTITY, type Pose } from "../src/util/math";

function joint(name: string, parent: string, child: string, other: Partial<RobotJoint>): RobotJoint {
  return {
    ...{ name, parent, child, type: "fixed", origin: [0, 0, 0, 0, 0, 0, 1], axis: [1, 0, 0] },
    ...{ mimic: null, lower: null, upper: null, effort: null, value: null },
    ...other,
  };
}

/** base -(turn about z)> arm -(slide along x)> hand -(follows turn twice as far)> finger */
const joints = [
  joint("turn", "base", "arm", { type: "revolute", axis: [0, 0, 1], origin: [0, 0, 1, 0, 0, 0, 1], value: 0 }),
  joint("slide", "arm", "hand", { type: "prismatic", origin: [1, 0, 0, 0, 0, 0, 1], value: 0.5 }),
  joint("follow", "hand", "finger", {
    ...{ type: "continuous", axis: [0, 0, 1] },
    mimic: { joint: "turn", multiplier: 2, offset: 0 },
  }),
];
const kinematics = new Kinematics({ root: "base", joints } as unknown as RobotModel);
const yaw = (angle: number): Pose["quaternion"] => [0, 0, Math.sin(angle / 2), Math.cos(angle / 2)];

function expectPose(pose: Pose | null | undefined, position: number[], quaternion: number[]): void {
  position.forEach((value, k) => expect(pose?.position[k]).toBeCloseTo(value, 12));
  quaternion.forEach((value, k) => expect(pose?.quaternion[k]).toBeCloseTo(value, 12));
}

describe("the links of a robot", () => {
  it("follow the positions of its joints, whose defaults the server gives", () => {
    const poses = kinematics.poses(IDENTITY, { turn: Math.PI / 2 });
    expectPose(poses.get("arm"), [0, 0, 1], yaw(Math.PI / 2));
    expectPose(poses.get("hand"), [0, 1.5, 1], yaw(Math.PI / 2));
    expectPose(poses.get("finger"), [0, 1.5, 1], yaw((3 * Math.PI) / 2));
  });

  it("are drawn at known poses, with the others relative to them", () => {
    const arm: Pose = { position: [5, 0, 0], quaternion: [0, 0, 0, 1] };
    const poses = kinematics.poses(IDENTITY, { slide: 0 }, (link) => (link === "arm" ? arm : null));
    expectPose(poses.get("hand"), [6, 0, 0], [0, 0, 0, 1]);
  });

  it("determine the pose of the root", () => {
    const hand: Pose = { position: [0, 0, 0], quaternion: yaw(Math.PI / 2) };
    const root = kinematics.root({ turn: 0, slide: 0 }, (link) => (link === "hand" ? hand : null));
    expectPose(root, [0, -1, -1], yaw(Math.PI / 2));
    expect(kinematics.root({}, () => null)).toBeNull();
  });
});
