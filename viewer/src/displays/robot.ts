// SPDX-License-Identifier: Apache-2.0
/** The RobotModel display: each link of a URDF is drawn at its frame, or at the position of its joint without one. */

import * as THREE from "three";
import URDFLoader, { type URDFJoint, type URDFRobot } from "urdf-loader";
import { dropEmptyTextures, hasImage, materialsOf, FORBIDDEN_URL, type Meshes } from "../scene/meshes";
import type { FramePoses } from "../scene/frame_poses";
import type { Robot, FrameUpdate } from "../protocol/messages";
import { Display, release, type Context, type DisplayConfig } from "./display";

export class RobotDisplay extends Display<"RobotModel"> {
  robot: Robot | null = null;
  model: URDFRobot | null = null;
  /** Joint positions set with the sliders. */
  private sliderPositions: Record<string, number> = {};
  /** Whether the joint positions override the frames, because they are not published. */
  private overridesFrames = false;
  /** The number of meshes being loaded. */
  loading = 0;
  private readonly problems: string[] = [];

  constructor(
    id: number,
    config: DisplayConfig,
    context: Context,
    private readonly meshes: Meshes,
  ) {
    super(id, config, context);
    this.status = { state: "waiting", text: "No robot description received" };
  }

  setRobot(robot: Robot): void {
    this.robot = robot;
    this.rebuild();
  }

  /** Sets joint positions; `overridesFrames` draws them even if transforms differ. */
  setJoints(positions: Record<string, number>, overridesFrames: boolean): void {
    this.sliderPositions = positions;
    this.overridesFrames = overridesFrames;
    for (const [name, value] of Object.entries(positions)) this.model?.setJointValue(name, value);
    this.context.redraw();
  }

  override restyle(): void {
    if (this.robot) this.rebuild();
  }

  override bounds(): THREE.Box3 {
    return this.model?.visible ? new THREE.Box3().setFromObject(this.model) : new THREE.Box3();
  }

  override probe(): Record<string, unknown> {
    let meshes = 0;
    let textures = 0;
    this.model?.traverse((part) => {
      meshes += (part as Partial<THREE.Mesh>).isMesh ? 1 : 0;
      for (const { map } of materialsOf(part) as THREE.MeshPhongMaterial[]) textures += map && hasImage(map) ? 1 : 0;
    });
    const visible = (this.model?.visible ?? false) && this.object.visible;
    return {
      ...super.probe(),
      robot: this.robot?.name ?? null,
      meshes,
      textures,
      loading: this.loading,
      visible,
      links: this.linkPoses(),
    };
  }

  /** The pose of each link in the scene. */
  private linkPoses(): Record<string, number[]> {
    const poses = Object.entries(this.model?.links ?? {}).map(([name, link]) => {
      const position = link.getWorldPosition(new THREE.Vector3());
      const quaternion = link.getWorldQuaternion(new THREE.Quaternion());
      return [name, [...position.toArray(), ...quaternion.toArray()]] as [string, number[]];
    });
    return Object.fromEntries(poses);
  }

  private rebuild(): void {
    if (this.model) {
      release(this.model);
      this.model.removeFromParent();
      this.model = null;
    }
    const robot = this.robot as Robot;
    this.problems.splice(0, Infinity, ...robot.problems);
    this.loading = 0;
    try {
      this.model = this.parse(robot);
    } catch (error) {
      this.status = { state: "error", text: `Cannot parse the robot description: ${String(error)}` };
      return;
    }
    this.model.visible = false;
    for (const joint of robot.joints) this.model.setJointValue(joint.name, joint.value);
    this.setJoints(this.sliderPositions, this.overridesFrames);
    this.object.add(this.model);
    this.updateStatus();
  }

  private parse(robot: Robot): URDFRobot {
    const textures = new THREE.LoadingManager();
    let complete = true;
    textures.onStart = (): void => void (complete = false);
    const loader = new URDFLoader(textures);
    // File names stay unchanged, because the table of the server maps them to URLs.
    loader.packages = (name: string): string => `package://${name}`;
    loader.parseVisual = this.options.flag("Visual Enabled");
    loader.parseCollision = this.options.flag("Collision Enabled");
    loader.loadMeshCb = (path, _manager, material, done): void => {
      const url = Object.hasOwn(robot.meshes, path) ? robot.meshes[path] : undefined;
      if (!url) {
        this.problems.push(`Mesh file not found: ${path.slice(0, 200)}`);
        return;
      }
      this.loading++;
      this.meshes
        .load(url, path)
        .then(({ object, coloured }) => {
          this.paint(object, coloured ? null : material);
          done(object);
          if (complete) dropEmptyTextures(object);
        })
        .catch((error: unknown) => this.problems.push(error instanceof Error ? error.message : String(error)))
        .finally(() => {
          this.loading--;
          this.updateStatus();
          this.context.redraw();
        });
    };
    textures.setURLModifier((path) =>
      Object.hasOwn(robot.meshes, path) ? (robot.meshes[path] as string) : FORBIDDEN_URL,
    );
    const model = loader.parse(robot.urdf);
    textures.onLoad = (): void => {
      complete = true;
      dropEmptyTextures(model);
      this.context.redraw();
    };
    model.traverse((part) => {
      if ((part as Partial<THREE.Mesh>).isMesh && !part.userData.shared) this.paint(part, null);
    });
    return model;
  }

  /** Copies shared materials, because the alpha of robots can differ. */
  private paint(object: THREE.Object3D, material: THREE.Material | null): void {
    const alpha = this.options.number("Alpha");
    object.traverse((part) => {
      const mesh = part as THREE.Mesh;
      if (!mesh.isMesh) return;
      const painted = (material ? [material] : materialsOf(mesh)).map((m) => {
        const copy = m.clone();
        copy.side = THREE.DoubleSide;
        if (alpha < 1) Object.assign(copy, { transparent: true, opacity: copy.opacity * alpha, depthWrite: false });
        if (copy instanceof THREE.MeshPhongMaterial) copy.shininess = Math.min(copy.shininess, 20);
        return copy;
      });
      mesh.material = painted.length === 1 ? (painted[0] as THREE.Material) : painted;
    });
  }

  private updateStatus(): void {
    const first = this.problems[0];
    const more = this.problems.length > 1 ? ` (and ${this.problems.length - 1} more)` : "";
    if (first) this.status = { state: "error", text: first + more };
    else if (this.loading > 0) this.status = { state: "waiting", text: `Loading ${this.loading} meshes` };
    else this.status = { state: "ok", text: [this.robot?.name ?? "", ...(this.robot?.warnings ?? [])].join("; ") };
  }

  override setPoses(framePoses: FramePoses, _update: FrameUpdate): void {
    const { model } = this;
    if (!model) return;
    const prefix = this.options.text("TF Prefix");
    const pose = (link: string): THREE.Matrix4 | null => matrixOf(framePoses, this.context.model, prefix, link);
    const root = pose(model.name);
    const found = root ?? this.rootFromAnyLink(model, pose);
    // Without frames, the robot is drawn at the fixed frame, so that its sliders can be used.
    const start = found ?? new THREE.Matrix4();
    model.visible = true;
    if (!found && !this.problems.length)
      this.status = {
        state: "waiting",
        text: `No transform from ${prefix}${model.name}; the robot is drawn at the fixed frame`,
      };
    else if (found && this.status.state === "waiting" && this.loading === 0) this.updateStatus();
    model.matrixAutoUpdate = false;
    model.matrix.copy(start);
    for (const joint of Object.values(model.joints)) this.setJointPose(joint, pose);
    model.matrixWorldNeedsUpdate = true;
  }

  /** Sets the matrix of a joint to the transform between its links, if both frames exist. */
  private setJointPose(joint: URDFJoint, pose: (link: string) => THREE.Matrix4 | null): void {
    const parent = this.overridesFrames ? null : pose(joint.parent?.name ?? "");
    const child = parent ? pose(joint.children[0]?.name ?? "") : null;
    joint.matrixAutoUpdate = !(parent && child);
    if (parent && child) joint.matrix.copy(parent.invert().multiply(child));
    else joint.updateMatrix();
    joint.matrixWorldNeedsUpdate = true;
  }

  /** The pose of the root, derived from the first link that has a frame; null if no link has one. */
  private rootFromAnyLink(model: URDFRobot, pose: (link: string) => THREE.Matrix4 | null): THREE.Matrix4 | null {
    for (const [name, link] of Object.entries(model.links)) {
      const known = pose(name);
      if (!known) continue;
      const chain = new THREE.Matrix4();
      for (let at: THREE.Object3D | null = link; at && at !== model; at = at.parent) {
        if (at.matrixAutoUpdate) at.updateMatrix();
        chain.premultiply(at.matrix);
      }
      return known.multiply(chain.invert());
    }
    return null;
  }
}

function matrixOf(framePoses: FramePoses, model: Context["model"], prefix: string, link: string): THREE.Matrix4 | null {
  const i = model.forest.index.get(prefix + link) ?? -1;
  if (i < 0 || i >= framePoses.count || !Number.isFinite(framePoses.positions[i * 3] as number)) return null;
  return new THREE.Matrix4().compose(
    new THREE.Vector3().fromArray(framePoses.positions, i * 3),
    new THREE.Quaternion().fromArray(framePoses.quaternions, i * 4),
    new THREE.Vector3(1, 1, 1),
  );
}
