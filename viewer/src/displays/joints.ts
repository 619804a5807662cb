// SPDX-License-Identifier: Apache-2.0
/** The Effort and JointTrajectory displays, which draw on the robots of the page. */

import * as THREE from "three";
import type { FramePoses } from "../scene/frame_poses";
import { slice, type FrameUpdate, type RobotModel, type Shapes } from "../protocol/messages";
import { IDENTITY, type Pose } from "../util/math";
import { MessageDisplay } from "./display";
import { Kinematics } from "./robot_kinematics";
import { makeSolidMaterial } from "./vectors";

/** Joints without a limit are drawn relative to this effort. */
const DEFAULT_EFFORT = 10;
/** The radius of the circle at the full effort, in meters. */
const RADIUS_M = 0.15;
const FULL_TURN = 1.9 * Math.PI;
const LINK_RADIUS_M = 0.02;
/** Links that move less than this are not drawn. */
const MIN_PATH_M = 1e-4;

type JointClass = "Effort" | "JointTrajectory";

abstract class JointsDisplay<C extends JointClass> extends MessageDisplay<Shapes, C> {
  protected framePoses: FramePoses | null = null;

  override setPoses(framePoses: FramePoses, update: FrameUpdate): void {
    this.framePoses = framePoses;
    super.setPoses(framePoses, update);
  }

  /** The robots that have one of these joints. */
  protected robots(joints: readonly string[]): RobotModel[] {
    const names = new Set(joints);
    return [...this.context.model.robots.values()].filter((robot) => robot.joints.some(({ name }) => names.has(name)));
  }

  /** The pose of a frame in the scene; null if it is unknown. */
  protected frame(name: string): Pose | null {
    const { framePoses, context } = this;
    const i = context.model.forest.index.get(name) ?? -1;
    if (!framePoses || i < 0 || i >= framePoses.count || !Number.isFinite(framePoses.positions[i * 3] as number))
      return null;
    return {
      position: [...framePoses.positions.subarray(i * 3, i * 3 + 3)] as Pose["position"],
      quaternion: [...framePoses.quaternions.subarray(i * 4, i * 4 + 4)] as Pose["quaternion"],
    };
  }
}

export class EffortDisplay extends JointsDisplay<"Effort"> {
  protected build({ description }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "efforts") return group;
    for (const robot of this.robots(description.joints))
      for (const joint of robot.joints) {
        const effort = description.efforts[description.joints.indexOf(joint.name)];
        if (effort === undefined || effort === null || joint.type === "fixed") continue;
        const part = effort / (joint.effort ?? DEFAULT_EFFORT);
        const circle = this.circle(Math.max(-1, Math.min(1, part)), new THREE.Vector3(...joint.axis));
        circle.userData.joint = { name: joint.name, link: joint.child, effort, part };
        group.add(circle);
      }
    return group;
  }

  protected override onPose(object: THREE.Object3D): void {
    for (const circle of object.children) {
      const pose = this.frame((circle.userData.joint as { link: string }).link);
      circle.visible = pose !== null;
      if (!pose) continue;
      circle.position.fromArray(pose.position).sub(object.position);
      circle.quaternion.fromArray(pose.quaternion);
    }
  }

  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    return {
      joints: object.children.filter(({ visible }) => visible).map(({ userData }) => userData.joint as unknown),
    };
  }

  /** A circle around the axis of a joint, in the direction of the effort, whose length and color show its size. */
  private circle(part: number, axis: THREE.Vector3): THREE.Object3D {
    const group = new THREE.Group();
    const size = Math.abs(part);
    if (size === 0 || axis.length() === 0) return group;
    const radius = RADIUS_M * this.options.number("Scale") * (0.3 + 0.7 * size);
    const tube = this.options.number("Width") / 2;
    const turn = FULL_TURN * size;
    const color = `#${new THREE.Color().setHSL((1 - size) / 3, 0.9, 0.5).getHexString()}`;
    const look = makeSolidMaterial(color, this.options.number("Alpha"));
    const arc = new THREE.Mesh(new THREE.TorusGeometry(radius, tube, 8, 64, turn), look);
    const head = new THREE.Mesh(new THREE.ConeGeometry(tube * 2.5, tube * 5, 12), look.clone());
    head.position.set(radius * Math.cos(turn), radius * Math.sin(turn), 0);
    head.rotation.z = turn;
    const turned = new THREE.Group();
    turned.add(arc, head);
    const direction = axis.normalize().multiplyScalar(Math.sign(part));
    turned.quaternion.setFromUnitVectors(new THREE.Vector3(0, 0, 1), direction);
    group.add(turned);
    return group;
  }
}

export class TrajectoryDisplay extends JointsDisplay<"JointTrajectory"> {
  protected build({ description, payload }: Shapes): THREE.Object3D {
    const group = new THREE.Group();
    if (description.kind !== "trajectory") return group;
    const width = description.joints.length;
    const points = slice(payload, description.points, width);
    for (const robot of this.robots(description.joints)) {
      const drawn = new THREE.Group();
      drawn.userData.root = robot.root;
      const kinematics = new Kinematics(robot);
      const poses: Map<string, Pose>[] = [];
      for (let row = 0; row + width <= points.length; row += width) {
        const positions = Object.fromEntries(description.joints.map((name, k) => [name, points[row + k] as number]));
        poses.push(kinematics.poses(IDENTITY, positions));
      }
      this.addPaths(drawn, robot, poses);
      group.add(drawn);
    }
    return group;
  }

  protected override onPose(object: THREE.Object3D): void {
    for (const drawn of object.children) {
      const pose = this.frame(drawn.userData.root as string);
      drawn.visible = pose !== null;
      if (!pose) continue;
      drawn.position.fromArray(pose.position).sub(object.position);
      drawn.quaternion.fromArray(pose.quaternion);
    }
  }

  protected override describe(_message: Shapes, object: THREE.Object3D): Record<string, unknown> {
    const paths: Record<string, number[]> = {};
    for (const drawn of object.children) Object.assign(paths, drawn.visible ? drawn.userData.paths : {});
    return { paths };
  }

  /** Adds the path of each link that moves, relative to the root, and a line through the links at the end. */
  private addPaths(target: THREE.Group, robot: RobotModel, poses: readonly Map<string, Pose>[]): void {
    const color = this.options.color("Color");
    const alpha = this.options.number("Alpha");
    const material = new THREE.LineBasicMaterial({ color, transparent: alpha < 1, opacity: alpha });
    const paths: Record<string, number[]> = {};
    for (const { name } of robot.links) {
      const points = poses.flatMap((links) => [...(links.get(name)?.position ?? [])]);
      const first = new THREE.Vector3().fromArray(points);
      const length = Math.max(
        0,
        ...points.map((_, i) => (i % 3 ? 0 : first.distanceTo(new THREE.Vector3().fromArray(points, i)))),
      );
      if (length < MIN_PATH_M) continue;
      paths[name] = points;
      target.add(line(points, material));
    }
    target.userData.paths = paths;
    const end = poses.at(-1);
    if (!end || !this.options.flag("Show End")) return;
    for (const { parent, child } of robot.joints) {
      const [from, to] = [end.get(parent), end.get(child)];
      if (from && to) target.add(line([...from.position, ...to.position], material));
      if (!to || !(child in paths)) continue;
      const ball = new THREE.Mesh(new THREE.SphereGeometry(LINK_RADIUS_M, 12, 8), makeSolidMaterial(color, alpha));
      ball.position.fromArray(to.position);
      target.add(ball);
    }
  }
}

function line(points: readonly number[], material: THREE.Material): THREE.Line {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
  const made = new THREE.Line(geometry, material);
  made.frustumCulled = false;
  return made;
}
