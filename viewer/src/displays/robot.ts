// SPDX-License-Identifier: Apache-2.0
/** The RobotModel display: each link of a robot is drawn at its frame, or at the position of its joint without one. */

import * as THREE from "three";
import { hasImage, materialsOf, MISSING_TEXTURE, type Meshes } from "../scene/meshes";
import type { FramePoses } from "../scene/frame_poses";
import type { PickedGroup, PickedPart } from "../model/picked";
import type { Hit } from "../scene/picking";
import {
  FrameState,
  type FrameUpdate,
  type RobotLink,
  type RobotModel,
  type RobotShape,
  type Vector,
} from "../protocol/messages";
import * as format from "../util/format";
import { IDENTITY, type Pose } from "../util/math";
import { Display, isInside, MAX_LISTED_PARTS, release, type Context, type DisplayConfig } from "./display";
import { Kinematics, type KnownPose } from "./robot_kinematics";

/** How links look whose transforms are no longer received. */
const STALE_MATERIAL = new THREE.MeshLambertMaterial({
  color: "#8b929a",
  transparent: true,
  opacity: 0.35,
  depthWrite: false,
  side: THREE.DoubleSide,
});

/** Shinier surfaces would be white in the light of the scene. */
const MAX_SHININESS = 20;
const MAX_NAMED_TEXTURES = 3;

export class RobotDisplay extends Display<"RobotModel"> {
  robot: RobotModel | null = null;
  private model = new THREE.Group();
  private links: ReadonlyMap<string, THREE.Group> = new Map();
  private kinematics: Kinematics | null = null;
  /** Joint positions set with the sliders. */
  private positions: Readonly<Record<string, number>> = {};
  /** Whether the joint positions override the frames, because they are not published. */
  private overridesFrames = false;
  /** The number of meshes being loaded. */
  loading = 0;
  private readonly problems: string[] = [];
  /** The names of textures that cannot be drawn. */
  private readonly missing = new Set<string>();
  private origin: readonly number[] = [0, 0, 0];
  /** The links whose transforms are no longer received. */
  private readonly staleLinks = new Set<string>();

  constructor(
    id: number,
    config: DisplayConfig,
    context: Context,
    private readonly meshes: Meshes,
  ) {
    super(id, config, context);
    this.status = { state: "waiting", text: "No robot description received" };
  }

  setRobot(robot: RobotModel): void {
    this.robot = robot;
    this.rebuild();
  }

  /** Sets joint positions; `overridesFrames` draws them even if transforms differ. */
  setJoints(positions: Record<string, number>, overridesFrames: boolean): void {
    this.positions = positions;
    this.overridesFrames = overridesFrames;
    this.context.redraw();
  }

  override restyle(): void {
    if (this.robot) this.rebuild();
  }

  override bounds(): THREE.Box3 {
    return this.model.visible ? new THREE.Box3().setFromObject(this.model) : new THREE.Box3();
  }

  override probe(): Record<string, unknown> {
    let meshes = 0;
    let textures = 0;
    let opaque = 1;
    this.model.traverse((part) => {
      meshes += (part as Partial<THREE.Mesh>).isMesh ? 1 : 0;
      for (const { opacity } of materialsOf(part)) opaque = Math.min(opaque, opacity);
      for (const { map } of materialsOf(part) as THREE.MeshPhongMaterial[]) textures += map && hasImage(map) ? 1 : 0;
    });
    const visible = this.model.visible && this.object.visible;
    return {
      ...super.probe(),
      robot: this.robot?.name ?? null,
      meshes,
      textures,
      opacity: opaque,
      loading: this.loading,
      stale: [...this.staleLinks],
      visible,
      links: this.linkPoses(),
    };
  }

  override pick(hit: Hit): PickedPart | null {
    for (const [name, link] of this.links) if (isInside(hit.object, link)) return this.partOf(name, hit.point);
    return null;
  }

  override pickAll(inside: (point: THREE.Vector3) => boolean): PickedGroup {
    const group = super.pickAll(inside);
    if (!this.model.visible) return group;
    for (const [name, link] of this.links) {
      const box = new THREE.Box3().setFromObject(link);
      const center = box.getCenter(new THREE.Vector3());
      if (box.isEmpty() || !inside(center)) continue;
      group.count++;
      if (group.parts.length < MAX_LISTED_PARTS) group.parts.push(this.partOf(name, center));
    }
    return group;
  }

  /** Describes a link at a point of the scene. */
  private partOf(name: string, point: THREE.Vector3): PickedPart {
    const { robot } = this;
    const joint = robot?.joints.find(({ child }) => child === name);
    const shapes = robot?.links.find((link) => link.name === name)?.visuals ?? [];
    const meshes = shapes.flatMap(({ mesh }) => (mesh === null ? [] : [mesh.replace(/^.*\//, "")]));
    return {
      title: `Link ${name}`,
      display: this.config.name,
      topic: robot?.description_topic ?? null,
      frame: this.options.text("TF Prefix") + name,
      stamp: null,
      position: point.toArray().map((value, k) => value + (this.origin[k] as number)) as Vector,
      rows: [
        ["robot", robot?.name ?? ""],
        ["joint", joint ? `${joint.name} (${joint.type})` : ""],
        ["parent link", joint?.parent ?? ""],
        ["shapes", shapes.map(({ kind }) => kind).join(", ")],
        ["mesh", meshes.join(", ")],
      ],
      source: null,
    };
  }

  /** The pose of each link in the scene. */
  private linkPoses(): Record<string, number[]> {
    const poses = [...this.links].map(([name, link]) => {
      const position = link.getWorldPosition(new THREE.Vector3());
      const quaternion = link.getWorldQuaternion(new THREE.Quaternion());
      return [name, [...position.toArray(), ...quaternion.toArray()]] as [string, number[]];
    });
    return Object.fromEntries(poses);
  }

  private rebuild(): void {
    const robot = this.robot as RobotModel;
    const stale = [...this.staleLinks];
    this.staleLinks.clear();
    for (const name of stale) this.markLink(name); // So that the own materials are freed.
    release(this.model);
    this.model.removeFromParent();
    this.problems.splice(0, Infinity, ...robot.problems);
    this.missing.clear();
    this.loading = 0;
    this.kinematics = new Kinematics(robot);
    this.model = new THREE.Group();
    this.model.visible = false;
    this.links = new Map(robot.links.map((link) => [link.name, this.makeLink(robot, link)]));
    if (this.links.size > 0) this.model.add(...this.links.values());
    this.object.add(this.model);
    this.updateStatus();
    this.context.redraw();
  }

  private makeLink(robot: RobotModel, link: RobotLink): THREE.Group {
    const group = new THREE.Group();
    group.matrixAutoUpdate = false;
    if (this.options.flag("Visual Enabled")) for (const shape of link.visuals) group.add(this.makeShape(robot, shape));
    if (this.options.flag("Collision Enabled"))
      for (const shape of link.collisions) group.add(this.makeShape(robot, shape));
    return group;
  }

  private makeShape(robot: RobotModel, shape: RobotShape): THREE.Object3D {
    const geometry = primitive(shape);
    const object = geometry ? new THREE.Mesh(geometry, this.material(robot, shape)) : new THREE.Group();
    object.position.fromArray(shape.pose);
    object.quaternion.fromArray(shape.pose, 3);
    if (shape.mesh !== null) {
      object.scale.fromArray(shape.size);
      this.loadMesh(robot, shape, shape.mesh, object);
    }
    return object;
  }

  private loadMesh(robot: RobotModel, shape: RobotShape, file: string, parent: THREE.Object3D): void {
    const url = urlOf(robot, file);
    if (url === null) return; // The server has reported the reason.
    const { model } = this;
    this.loading++;
    this.meshes
      .load(url, file)
      .then(({ object, hasColors: colored, missing }) => {
        for (const texture of missing) this.missing.add(texture);
        if (colored) this.paint(object);
        else setMaterial(object, this.material(robot, shape));
        parent.add(object);
        for (const name of this.staleLinks) this.markLink(name);
      })
      .catch((error: unknown) => {
        if (model === this.model) this.problems.push(error instanceof Error ? error.message : String(error));
      })
      .finally(() => {
        if (model !== this.model) return; // The robot was built again.
        this.loading--;
        this.updateStatus();
        this.context.redraw();
      });
  }

  /** The material of a shape without colors of its own. */
  private material(robot: RobotModel, { color, texture }: RobotShape): THREE.Material {
    const material = new THREE.MeshPhongMaterial();
    if (color) {
      const [red, green, blue, alpha] = color;
      material.color.setRGB(red, green, blue);
      Object.assign(material, { opacity: alpha, transparent: alpha < 1, depthWrite: alpha >= 1 });
    }
    if (texture !== null) this.addTexture(material, urlOf(robot, texture));
    return this.adjustMaterial(material);
  }

  /** Loads a texture; a surface without it is gray. */
  private addTexture(material: THREE.MeshPhongMaterial, url: string | null): void {
    const drop = (): void => {
      if (url !== null) this.missing.add(url.split("/").pop() ?? url);
      this.updateStatus();
      material.map = null;
      material.color.set(MISSING_TEXTURE);
      material.needsUpdate = true;
      this.context.redraw();
    };
    if (url === null) {
      drop();
      return;
    }
    const loaded = (texture: THREE.Texture): void => (hasImage(texture) ? this.context.redraw() : drop());
    material.map = new THREE.TextureLoader().load(url, loaded, undefined, drop);
    material.map.colorSpace = THREE.SRGBColorSpace;
  }

  /** Copies the materials of a mesh file, which displays share, because the alpha of robots can differ. */
  private paint(object: THREE.Object3D): void {
    object.traverse((part) => {
      const mesh = part as THREE.Mesh;
      if (!mesh.isMesh) return;
      const painted = materialsOf(mesh).map((material) => this.adjustMaterial(material.clone()));
      mesh.material = painted.length === 1 ? (painted[0] as THREE.Material) : painted;
    });
  }

  private adjustMaterial(material: THREE.Material): THREE.Material {
    const alpha = this.options.number("Alpha");
    material.side = THREE.DoubleSide;
    if (alpha < 1) Object.assign(material, { transparent: true, opacity: material.opacity * alpha, depthWrite: false });
    if (material instanceof THREE.MeshPhongMaterial) material.shininess = Math.min(material.shininess, MAX_SHININESS);
    return material;
  }

  private updateStatus(): void {
    const names = [...this.missing].slice(0, MAX_NAMED_TEXTURES).join(", ");
    const textures = this.missing.size === 1 ? "1 texture" : `${this.missing.size} textures`;
    this.note = names && `Drawn gray, because browsers cannot show ${textures}: ${names}`;
    const first = this.problems[0];
    const more = this.problems.length > 1 ? ` (and ${this.problems.length - 1} more)` : "";
    if (first) this.status = { state: "error", text: first + more };
    else if (this.staleLinks.size > 0) this.status = { state: "error", text: this.staleText() };
    else if (this.loading > 0) this.status = { state: "waiting", text: `Loading ${this.loading} meshes` };
    else this.status = { state: "ok", text: [this.robot?.name ?? "", ...(this.robot?.warnings ?? [])].join("; ") };
  }

  private staleText(): string {
    const { stats, forest } = this.context.model;
    const prefix = this.options.text("TF Prefix");
    const ages = [...this.staleLinks].map((link) => stats?.frames[forest.index.get(prefix + link) ?? -1]?.age ?? 0);
    const age = Math.max(0, ...ages);
    const since = age > 0 ? ` for ${format.duration(age)}` : "";
    return `No transform received${since}: ${this.staleLinks.size} of ${this.links.size} links`;
  }

  /** Shows which links are stale: the transform of their frame, or of a frame above it, is no longer received. */
  private updateStale(framePoses: FramePoses, update: FrameUpdate, prefix: string): void {
    const { forest } = this.context.model;
    if (update.revision !== forest.revision) return;
    let changed = false;
    for (const name of this.links.keys()) {
      const i = forest.index.get(prefix + name) ?? -1;
      const state = update.states[i];
      const isStale =
        i >= 0 && (state === FrameState.stale || state === FrameState.gone || (framePoses.fade[i] ?? 0) > 0);
      if (isStale === this.staleLinks.has(name)) continue;
      changed = true;
      if (isStale) this.staleLinks.add(name);
      else this.staleLinks.delete(name);
      this.markLink(name);
    }
    if (changed || this.staleLinks.size > 0) this.updateStatus();
  }

  /** Draws a link in gray if it is stale, otherwise in its own colors. */
  private markLink(name: string): void {
    const isStale = this.staleLinks.has(name);
    this.links.get(name)?.traverse((part) => {
      const mesh = part as THREE.Mesh;
      if (!mesh.isMesh) return;
      if (isStale && mesh.material !== STALE_MATERIAL) {
        mesh.userData.material = mesh.material;
        mesh.material = STALE_MATERIAL;
      } else if (!isStale && mesh.material === STALE_MATERIAL) {
        mesh.material = mesh.userData.material as THREE.Material;
        delete mesh.userData.material;
      }
    });
  }

  override setPoses(framePoses: FramePoses, update: FrameUpdate): void {
    const { robot, kinematics } = this;
    if (!robot || !kinematics) return;
    const prefix = this.options.text("TF Prefix");
    const known: KnownPose = (link) => framePose(framePoses, this.context.model, prefix + link);
    const root = kinematics.root(this.positions, known);
    this.model.visible = true;
    this.origin = framePoses.origin;
    if (!root && !this.problems.length)
      this.status = {
        state: "waiting",
        text: `No transform from ${prefix}${robot.root}; the robot is drawn at the fixed frame`,
      };
    else if (root && this.status.state === "waiting" && this.loading === 0) this.updateStatus();
    this.updateStale(framePoses, update, prefix);
    // Without frames, the robot is drawn at the fixed frame, so that its sliders can be used.
    const start = root ?? IDENTITY;
    for (const [name, pose] of kinematics.poses(start, this.positions, this.overridesFrames ? undefined : known)) {
      const link = this.links.get(name);
      link?.matrix.compose(
        new THREE.Vector3(...pose.position),
        new THREE.Quaternion(...pose.quaternion),
        new THREE.Vector3(1, 1, 1),
      );
      if (link) link.matrixWorldNeedsUpdate = true;
    }
  }
}

/** The geometry of a shape; null for meshes. Cylinders and capsules of three.js are along y, those of URDF along z. */
function primitive({ kind, size }: RobotShape): THREE.BufferGeometry | null {
  const [x, y, z] = size as [number, number, number];
  switch (kind) {
    case "box":
      return new THREE.BoxGeometry(x, y, z);
    case "sphere":
      return new THREE.SphereGeometry(x, 30, 30);
    case "cylinder":
      return new THREE.CylinderGeometry(x, x, y, 30).rotateX(Math.PI / 2);
    case "capsule":
      return new THREE.CapsuleGeometry(x, y, 8, 30).rotateX(Math.PI / 2);
    case "mesh":
      return null;
  }
}

function setMaterial(object: THREE.Object3D, material: THREE.Material): void {
  object.traverse((part) => {
    if ((part as Partial<THREE.Mesh>).isMesh) (part as THREE.Mesh).material = material;
  });
}

function urlOf({ meshes }: RobotModel, reference: string): string | null {
  return Object.hasOwn(meshes, reference) ? (meshes[reference] as string) : null;
}

function framePose(framePoses: FramePoses, model: Context["model"], frame: string): Pose | null {
  const i = model.forest.index.get(frame) ?? -1;
  const { positions, quaternions } = framePoses;
  if (i < 0 || i >= framePoses.count || !Number.isFinite(positions[i * 3] as number)) return null;
  return {
    position: [...positions.subarray(i * 3, i * 3 + 3)] as Pose["position"],
    quaternion: [...quaternions.subarray(i * 4, i * 4 + 4)] as Pose["quaternion"],
  };
}
