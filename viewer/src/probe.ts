// SPDX-License-Identifier: Apache-2.0
/** What tests, and the curious, can read of the page: `window.coframe`, told anew with each picture. */

import * as THREE from "three";
import type { Displays } from "./displays/manager";
import type { Model } from "./model/model";
import type { Vector } from "./protocol/messages";
import type { View } from "./scene/view";

interface FrameProbe {
  /** In the fixed frame, in metres, as float64. */
  position: Vector;
  quaternion: number[];
  visible: boolean;
  state: number;
}

export function exposeProbe(model: Model, view: View, displays: Displays): void {
  const frames = (): Record<string, FrameProbe> => {
    const { placement } = view;
    const found: Record<string, FrameProbe> = {};
    for (let i = 0; i < placement.count; i++) {
      const position = [0, 1, 2].map(
        (k) => (placement.positions[i * 3 + k] as number) + (placement.origin[k] as number),
      ) as Vector;
      found[model.forest.name(i)] = {
        position,
        quaternion: Array.from(placement.quaternions.subarray(i * 4, i * 4 + 4)),
        visible: placement.drawn[i] === 1 && view.tfShown,
        state: view.shown?.states[i] ?? 0,
      };
    }
    return found;
  };
  const probe = {
    get time() {
      return view.shown?.time ?? null;
    },
    get fixed() {
      return model.fixed;
    },
    get frames() {
      return frames();
    },
    get displays() {
      return Object.fromEntries(displays.list.map((display) => [display.config.name, display.probe()]));
    },
    get ticks() {
      return view.ticks;
    },
    get fps() {
      return view.stage.fps;
    },
    /** Whether what is drawn is what was asked for, and stands still. */
    get settled() {
      const { live, playing } = model.clock;
      return !live && !playing && !model.waiting && view.shown === model.tick;
    },
    /** How one looks, in the fixed frame's metres. */
    get camera() {
      const { camera } = view.stage;
      const { origin } = view.placement;
      const told = (place: THREE.Vector3): number[] => place.toArray().map((value, k) => value + (origin[k] as number));
      return { mode: camera.mode, position: told(camera.current.position), target: told(camera.target) };
    },
    /** Where a point of the fixed frame is on the canvas, in pixels. */
    pixel(point: Vector): [number, number] {
      const { width, height, camera } = view.stage;
      const place = new THREE.Vector3(...point)
        .sub(new THREE.Vector3(...view.placement.origin))
        .project(camera.current);
      return [((place.x + 1) / 2) * width, ((1 - place.y) / 2) * height];
    },
    get connected() {
      return model.connected;
    },
    get live() {
      return model.clock.live;
    },
    get broken() {
      return model.broken;
    },
  };
  Object.defineProperty(window, "coframe", { value: probe });
}
