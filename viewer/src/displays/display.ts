// SPDX-License-Identifier: Apache-2.0
/** The base classes of displays: scene object, options and status. */

import * as THREE from "three";
import type { Model } from "../model/model";
import type { PickedGroup, PickedPart } from "../model/picked";
import type { FramePoses } from "../scene/frame_poses";
import { DISPLAYS, type DisplayClass } from "../generated/displays";
import type {
  DisplayMessage,
  DisplayPose,
  JsonObject,
  DisplayOptions,
  FrameUpdate,
  Vector,
} from "../protocol/messages";
import type { Hit } from "../scene/picking";
import type { Palette } from "../util/theme";
import { Options } from "./options";

export interface DisplayConfig {
  class: string;
  name: string;
  enabled: boolean;
  topic: string | null;
  options: JsonObject;
  /** Whether the display itself is enabled; in a disabled group, `enabled` is false nevertheless. */
  checked?: boolean;
  /** The place in the .rviz file, and that of the group that contains the display. */
  source?: string;
  group?: string;
  /** Whether the page added the display by itself next to those of a file. It is not saved in the file. */
  added?: boolean;
}

export interface Context {
  model: Model;
  palette(): Palette;
  distinct(): boolean;
  /** The height of the canvas in pixels. */
  height(): number;
  /** Whether the browser renders without a graphics card. */
  software(): boolean;
  /** Whether the page is a replay. */
  replayed(): boolean;
  redraw(): void;
}

export interface Status {
  state: "ok" | "waiting" | "error";
  text: string;
}

export abstract class Display<C extends DisplayClass = DisplayClass> {
  readonly object = new THREE.Group();
  readonly kind: C;
  readonly options: Options<C>;
  status: Status = { state: "ok", text: "" };
  /** A short note next to the name, such as the thinning of a cloud. */
  note = "";
  /** What a replay omits of this display. */
  omitted = "";

  constructor(
    readonly id: number,
    readonly config: DisplayConfig,
    protected readonly context: Context,
  ) {
    this.kind = displayClass(config.class) as C;
    this.options = new Options(config.options, DISPLAYS[this.kind].options);
    this.object.visible = config.enabled;
  }

  /** Applies changed options or a changed palette. */
  restyle(): void {}

  /** Applies the poses of a frame update. */
  setPoses(_framePoses: FramePoses, _update: FrameUpdate): void {}

  /** The box that "Show everything" makes visible; empty for grids and axes. */
  bounds(): THREE.Box3 {
    return new THREE.Box3();
  }

  /** The part of the display that is hit; null if it cannot be selected. */
  pick(_hit: Hit): PickedPart | null {
    return null;
  }

  /** The parts at points of the scene for which `inside` returns true. */
  pickAll(_inside: (point: THREE.Vector3) => boolean): PickedGroup {
    return { display: this.config.name, count: 0, parts: [] };
  }

  /** A summary of what is drawn, for tests. */
  probe(): Record<string, unknown> {
    return { class: this.config.class, enabled: this.config.enabled, ...this.status };
  }

  dispose(): void {
    release(this.object);
    this.object.removeFromParent();
  }
}

/** Removes the package of a class: "rviz_default_plugins/TF" and "rviz/TF" are both TF. Null if there is no such display. */
export function displayClass(name: string): DisplayClass | null {
  const kind = name.replace(/^.*\//, "");
  return Object.hasOwn(DISPLAYS, kind) ? (kind as DisplayClass) : null;
}

const MAX_WAITING = 16;
/** The most parts of a display that are listed when a rectangle selects more. */
export const MAX_LISTED_PARTS = 100;
/** Larger coordinates are ignored when fitting the camera, because one outlier would make everything else tiny. */
const MAX_FIT_COORDINATE_M = 200;

/** A display of a topic. Each message is an object, whose pose and visibility are set by frame updates. */
export abstract class MessageDisplay<
  M extends DisplayMessage = DisplayMessage,
  C extends DisplayClass = DisplayClass,
> extends Display<C> {
  /** Removed objects whose resources are not freed yet. */
  private readonly removedObjects: THREE.Object3D[] = [];
  /** The number of removed objects at the last frame update. */
  private previouslyRemoved = 0;
  private origin: readonly number[] = [0, 0, 0];
  protected readonly drawnMessages = new Map<number, { object: THREE.Object3D; message: M }>();

  /** How the server prepares the messages. */
  subscription(): DisplayOptions {
    return { ...this.options.subscription(), display: this.kind };
  }

  receive(message: DisplayMessage): void {
    this.removeMessage(message.sequence);
    const object = this.build(message as M);
    object.visible = false;
    this.drawnMessages.set(message.sequence, { object, message: message as M });
    this.object.add(object);
    this.dropOldest();
  }

  protected abstract build(message: M): THREE.Object3D;

  /** Called after the pose of a message is set. */
  protected onPose(_object: THREE.Object3D, _message: M): void {}

  override restyle(): void {
    for (const entry of this.drawnMessages.values()) {
      const { object } = entry;
      entry.object = this.build(entry.message);
      entry.object.position.copy(object.position);
      entry.object.quaternion.copy(object.quaternion);
      entry.object.visible = object.visible;
      this.removeObject(object);
      this.object.add(entry.object);
      this.onPose(entry.object, entry.message);
    }
  }

  override setPoses(framePoses: FramePoses, update: FrameUpdate): void {
    this.freeRemoved();
    const listed = new Map<number, DisplayPose>();
    for (const entry of update.displays) if (entry.id === this.id) listed.set(entry.sequence, entry);
    this.origin = framePoses.origin;
    const newest = Math.max(-1, ...listed.keys());
    for (const [sequence, { object, message }] of this.drawnMessages) {
      const entry = listed.get(sequence);
      if (!entry) {
        object.visible = false;
        if (sequence < newest || listed.size === 0) this.removeMessage(sequence);
        continue;
      }
      object.visible = entry.ok && entry.pose.every(Number.isFinite);
      if (!object.visible) continue;
      for (const [k, axis] of (["x", "y", "z"] as const).entries())
        object.position[axis] =
          (entry.pose[k] as number) + (update.origin[k] as number) - (framePoses.origin[k] as number);
      object.quaternion.fromArray(entry.pose, 3);
      this.onPose(object, message);
    }
  }

  override bounds(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const { object } of this.drawnMessages.values()) {
      const own = object.visible ? new THREE.Box3().setFromObject(object) : box;
      if ([...own.min, ...own.max].every((value) => Math.abs(value) < MAX_FIT_COORDINATE_M)) box.union(own);
    }
    return box;
  }

  /** Adds the pose of each visible message, expressed in the fixed frame. */
  override probe(): Record<string, unknown> {
    const shown = [...this.drawnMessages.values()].filter(({ object }) => object.visible);
    return {
      ...super.probe(),
      topic: this.config.topic,
      messages: shown.map(({ object, message }) => ({
        sequence: message.sequence,
        position: this.toFixedFrame(object.position),
        quaternion: object.quaternion.toArray(),
        ...this.describe(message, object),
      })),
    };
  }

  override pick(hit: Hit): PickedPart | null {
    for (const { object, message } of this.drawnMessages.values())
      if (isInside(hit.object, object)) return this.partAt(message, object, hit);
    return null;
  }

  override pickAll(inside: (point: THREE.Vector3) => boolean): PickedGroup {
    const group = super.pickAll(inside);
    for (const { object, message } of this.drawnMessages.values()) {
      if (!object.visible) continue;
      for (const hit of this.partsOf(message, object)) {
        if (!inside(hit.point)) continue;
        group.count++;
        if (group.parts.length < MAX_LISTED_PARTS) group.parts.push(this.partAt(message, object, hit));
      }
    }
    return group;
  }

  /** Describes a part of a message; displays add what they know. */
  protected partAt(message: M, object: THREE.Object3D, hit: Hit): PickedPart {
    return {
      title: this.kind,
      display: this.config.name,
      topic: this.config.topic,
      frame: null,
      stamp: "stamp" in message ? message.stamp : null,
      position: this.toFixedFrame(hit.point) as Vector,
      rows: [],
      source: {
        id: this.id,
        sequence: message.sequence,
        local: object.worldToLocal(hit.point.clone()).toArray(),
      },
    };
  }

  /** The parts that a rectangle can select: by default the center of what is drawn. The hits may be reused. */
  protected *partsOf(_message: M, object: THREE.Object3D): Iterable<Hit> {
    const box = new THREE.Box3().setFromObject(object);
    if (!box.isEmpty()) yield { object, point: box.getCenter(new THREE.Vector3()), index: null };
  }

  protected describe(_message: M, _object: THREE.Object3D): Record<string, unknown> {
    return {};
  }

  /** Converts scene coordinates to the fixed frame. */
  protected toFixedFrame(point: THREE.Vector3): number[] {
    return point.toArray().map((value, k) => value + (this.origin[k] as number));
  }

  override dispose(): void {
    this.drawnMessages.clear();
    for (const object of this.removedObjects) release(object);
    super.dispose();
  }

  clear(): void {
    for (const sequence of [...this.drawnMessages.keys()]) this.removeMessage(sequence);
  }

  private removeMessage(sequence: number): void {
    const entry = this.drawnMessages.get(sequence);
    if (!entry) return;
    this.removeObject(entry.object);
    this.drawnMessages.delete(sequence);
  }

  /**
   * Removes an object and frees its resources one frame later. By then the next message uses the same shader program,
   * which would otherwise be deleted and compiled again for every message.
   */
  private removeObject(object: THREE.Object3D): void {
    object.removeFromParent();
    this.removedObjects.push(object);
  }

  private freeRemoved(): void {
    for (const object of this.removedObjects.splice(0, this.previouslyRemoved)) release(object);
    this.previouslyRemoved = this.removedObjects.length;
  }

  /** Limits the number of messages that no frame update lists. */
  private dropOldest(): void {
    const waiting = [...this.drawnMessages].filter(([, entry]) => !entry.object.visible);
    for (const [sequence] of waiting.slice(0, Math.max(0, waiting.length - MAX_WAITING))) this.removeMessage(sequence);
  }
}

/** Whether an object is another one or one of its descendants. */
export function isInside(object: THREE.Object3D, root: THREE.Object3D): boolean {
  for (let at: THREE.Object3D | null = object; at; at = at.parent) if (at === root) return true;
  return false;
}

/** Frees the graphics resources of an object and its descendants, except those marked `userData.shared`. */
export function release(object: THREE.Object3D): void {
  object.traverse((part) => {
    const mesh = part as Partial<THREE.Mesh>;
    if (part.userData.shared) return;
    mesh.geometry?.dispose();
    const materials = mesh.material ? (Array.isArray(mesh.material) ? mesh.material : [mesh.material]) : [];
    for (const material of materials) {
      for (const value of Object.values(material)) if (value instanceof THREE.Texture) value.dispose();
      material.dispose();
    }
  });
}

/** Moves an object to the pose of a frame, or hides it if the pose is unknown. Returns whether it is known. */
export function moveToFrame(object: THREE.Object3D, frame: string, framePoses: FramePoses, model: Model): boolean {
  const i = model.forest.index.get(frame) ?? -1;
  const at = i * 3;
  const known = i >= 0 && i < framePoses.count && Number.isFinite(framePoses.positions[at] as number);
  object.visible = known;
  if (!known) return false;
  object.position.fromArray(framePoses.positions, at);
  object.quaternion.fromArray(framePoses.quaternions, i * 4);
  return true;
}
