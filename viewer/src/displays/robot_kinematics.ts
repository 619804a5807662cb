// SPDX-License-Identifier: Apache-2.0
/** The poses of a robot's links from the positions of its joints. The server has read them from its description. */

import type { RobotJoint, RobotModel } from "../protocol/messages";
import { compose, IDENTITY, inverse, type Pose } from "../util/math";

/** The pose of a link from elsewhere; null if it is unknown. */
export type KnownPose = (link: string) => Pose | null;

export class Kinematics {
  private readonly joints: ReadonlyMap<string, RobotJoint>;

  constructor(private readonly robot: RobotModel) {
    this.joints = new Map(robot.joints.map((joint) => [joint.name, joint]));
  }

  /**
   * The pose of each link.
   *
   * @param root The pose of the root link.
   * @param positions Positions by joint, in radians or meters; other joints have their defaults or follow another joint.
   * @param knownPose Poses of links that differ from those of the joints, such as those of frames.
   */
  poses(root: Pose, positions: Readonly<Record<string, number>>, knownPose: KnownPose = () => null): Map<string, Pose> {
    const poses = new Map([[this.robot.root, root]]);
    for (const joint of this.robot.joints) {
      const parent = poses.get(joint.parent) ?? root;
      poses.set(joint.child, knownPose(joint.child) ?? compose(parent, this.jointPose(joint, positions)));
    }
    return poses;
  }

  /** The pose of the root link, derived from the first link whose pose is known; null if there is none. */
  root(positions: Readonly<Record<string, number>>, knownPose: KnownPose): Pose | null {
    const own = knownPose(this.robot.root);
    if (own) return own;
    for (const [link, pose] of this.poses(IDENTITY, positions)) {
      const found = knownPose(link);
      if (found) return compose(found, inverse(pose));
    }
    return null;
  }

  private jointPose(joint: RobotJoint, positions: Readonly<Record<string, number>>): Pose {
    return compose(toPose(joint.origin), motion(joint, this.position(joint, positions)));
  }

  private position(joint: RobotJoint, positions: Readonly<Record<string, number>>): number {
    const { name, mimic, value } = joint;
    if (Object.hasOwn(positions, name)) return positions[name] as number;
    const leader = mimic && this.joints.get(mimic.joint);
    return leader ? mimic.multiplier * this.position(leader, positions) + mimic.offset : (value ?? 0);
  }
}

function motion({ type, axis }: RobotJoint, position: number): Pose {
  const [x, y, z] = axis;
  if (type === "prismatic") return { ...IDENTITY, position: [x * position, y * position, z * position] };
  if (type !== "revolute" && type !== "continuous") return IDENTITY;
  const [sine, cosine] = [Math.sin(position / 2), Math.cos(position / 2)];
  return { ...IDENTITY, quaternion: [x * sine, y * sine, z * sine, cosine] };
}

function toPose([x, y, z, qx, qy, qz, qw]: RobotJoint["origin"]): Pose {
  return { position: [x, y, z], quaternion: [qx, qy, qz, qw] };
}
