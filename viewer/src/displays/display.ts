// SPDX-License-Identifier: Apache-2.0
/** What all displays have: a place in the scene, options, and a word on how they are doing. */

import * as THREE from "three";
import type { Model } from "../model/model";
import type { Placement } from "../scene/frame_poses";
import type { DisplayMessage, DisplayPose, JsonObject, DisplayOptions, Tick } from "../protocol/messages";
import type { Palette } from "../util/theme";
import { Options, type OptionSpec } from "./options";

export interface DisplayConfig {
  class: string;
  name: string;
  enabled: boolean;
  topic: string | null;
  options: JsonObject;
}

export interface Context {
  model: Model;
  palette(): Palette;
  distinct(): boolean;
  /** Pixels the picture is high. */
  height(): number;
  /** Whether there is no graphics card to draw with. */
  software(): boolean;
  /** Whether it comes out of a file of its own. */
  replayed(): boolean;
  redraw(): void;
}

export interface Status {
  state: "ok" | "waiting" | "error";
  text: string;
}

export abstract class Display {
  readonly object = new THREE.Group();
  readonly options: Options;
  status: Status = { state: "ok", text: "" };
  /** What else is worth a word beside its name. */
  note = "";
  /** What a replay was thinned by. */
  leftOut = "";

  constructor(
    readonly id: number,
    readonly config: DisplayConfig,
    readonly specs: readonly OptionSpec[],
    protected readonly context: Context,
  ) {
    this.options = new Options(config.options, specs);
    this.object.visible = config.enabled;
  }

  /** An option or the palette changed. */
  restyle(): void {}

  /** New poses are known. */
  place(_placement: Placement, _tick: Tick): void {}

  /** What is to be seen when everything is looked at; nothing for what only helps to see. */
  bounds(): THREE.Box3 {
    return new THREE.Box3();
  }

  /** For tests: what is drawn, in few words. */
  probe(): Record<string, unknown> {
    return { class: this.config.class, enabled: this.config.enabled, ...this.status };
  }

  dispose(): void {
    release(this.object);
    this.object.removeFromParent();
  }
}

const MOST_WAITING = 16;
/** One wild point must not make everything else a speck. */
const FARTHEST_M = 200;

/** Draws what comes on a topic: each message an object, shown where and as long as the server says. */
export abstract class MessageDisplay<M extends DisplayMessage = DisplayMessage> extends Display {
  private readonly buried: THREE.Object3D[] = [];
  /** How many of them were there at the last picture. */
  private ripe = 0;
  private origin: readonly number[] = [0, 0, 0];
  protected readonly drawn = new Map<number, { object: THREE.Object3D; message: M }>();

  subscription(): DisplayOptions {
    return {};
  }

  receive(message: DisplayMessage): void {
    this.forget(message.sequence);
    const object = this.build(message as M);
    object.visible = false;
    this.drawn.set(message.sequence, { object, message: message as M });
    this.object.add(object);
    this.dropOldest();
  }

  protected abstract build(message: M): THREE.Object3D;

  /** Called when a message's pose is known. */
  protected placed(_object: THREE.Object3D, _message: M): void {}

  override restyle(): void {
    for (const entry of this.drawn.values()) {
      const { object } = entry;
      entry.object = this.build(entry.message);
      entry.object.position.copy(object.position);
      entry.object.quaternion.copy(object.quaternion);
      entry.object.visible = object.visible;
      this.bury(object);
      this.object.add(entry.object);
      this.placed(entry.object, entry.message);
    }
  }

  override place(placement: Placement, tick: Tick): void {
    this.freeBuried();
    const listed = new Map<number, DisplayPose>();
    for (const entry of tick.displays) if (entry.id === this.id) listed.set(entry.sequence, entry);
    this.origin = placement.origin;
    const newest = Math.max(-1, ...listed.keys());
    for (const [sequence, { object, message }] of this.drawn) {
      const entry = listed.get(sequence);
      if (!entry) {
        object.visible = false;
        if (sequence < newest || listed.size === 0) this.forget(sequence);
        continue;
      }
      object.visible = entry.ok && entry.pose.every(Number.isFinite);
      if (!object.visible) continue;
      for (const [k, axis] of (["x", "y", "z"] as const).entries())
        object.position[axis] =
          (entry.pose[k] as number) + (tick.origin[k] as number) - (placement.origin[k] as number);
      object.quaternion.fromArray(entry.pose, 3);
      this.placed(object, message);
    }
  }

  override bounds(): THREE.Box3 {
    const box = new THREE.Box3();
    for (const { object } of this.drawn.values()) {
      const own = object.visible ? new THREE.Box3().setFromObject(object) : box;
      if ([...own.min, ...own.max].every((value) => Math.abs(value) < FARTHEST_M)) box.union(own);
    }
    return box;
  }

  /** In the fixed frame: where each visible message's frame is. */
  override probe(): Record<string, unknown> {
    const shown = [...this.drawn.values()].filter(({ object }) => object.visible);
    return {
      ...super.probe(),
      topic: this.config.topic,
      messages: shown.map(({ object, message }) => ({
        sequence: message.sequence,
        position: this.inFixed(object.position),
        quaternion: object.quaternion.toArray(),
        ...this.describe(message, object),
      })),
    };
  }

  protected describe(_message: M, _object: THREE.Object3D): Record<string, unknown> {
    return {};
  }

  /** A place in the scene, as the fixed frame has it. */
  protected inFixed(place: THREE.Vector3): number[] {
    return place.toArray().map((value, k) => value + (this.origin[k] as number));
  }

  override dispose(): void {
    this.drawn.clear();
    for (const object of this.buried) release(object);
    super.dispose();
  }

  clear(): void {
    for (const sequence of [...this.drawn.keys()]) this.forget(sequence);
  }

  private forget(sequence: number): void {
    const entry = this.drawn.get(sequence);
    if (!entry) return;
    this.bury(entry.object);
    this.drawn.delete(sequence);
  }

  /**
   * Frees what is not drawn any more one picture later: by then the next message's material uses the same program,
   * which would else be thrown away and compiled anew for every message.
   */
  private bury(object: THREE.Object3D): void {
    object.removeFromParent();
    this.buried.push(object);
  }

  private freeBuried(): void {
    for (const object of this.buried.splice(0, this.ripe)) release(object);
    this.ripe = this.buried.length;
  }

  /** Messages that no tick names must not pile up. */
  private dropOldest(): void {
    const waiting = [...this.drawn].filter(([, entry]) => !entry.object.visible);
    for (const [sequence] of waiting.slice(0, Math.max(0, waiting.length - MOST_WAITING))) this.forget(sequence);
  }
}

/** Frees what the graphics card holds for an object and all below it. Shared meshes are marked `userData.shared`. */
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

/** Sets an object to a frame's pose; hides it where that is not known. */
export function toFrame(object: THREE.Object3D, frame: string, placement: Placement, model: Model): boolean {
  const i = model.forest.index.get(frame) ?? -1;
  const at = i * 3;
  const known = i >= 0 && i < placement.count && Number.isFinite(placement.positions[at] as number);
  object.visible = known;
  if (!known) return false;
  object.position.fromArray(placement.positions, at);
  object.quaternion.fromArray(placement.quaternions, i * 4);
  return true;
}
