// SPDX-License-Identifier: Apache-2.0
/** The state of the page for tests and debugging, as `window.coframe`. */

import * as THREE from "three";
import type { Displays } from "./displays/manager";
import type { Model } from "./model/model";
import type { Vector } from "./protocol/messages";
import type { NodesView } from "./scene/nodes";
import type { View } from "./scene/view";

interface FrameProbe {
  /** Expressed in the fixed frame, in meters. */
  position: Vector;
  quaternion: number[];
  visible: boolean;
  state: number;
}

export function exposeProbe(model: Model, view: View, displays: Displays, nodes: NodesView): void {
  const frames = (): Record<string, FrameProbe> => {
    const { framePoses } = view;
    const found: Record<string, FrameProbe> = {};
    if (view.shown?.revision !== model.forest.revision) return found; // not drawn yet
    for (let i = 0; i < framePoses.count; i++) {
      const position = [0, 1, 2].map(
        (k) => (framePoses.positions[i * 3 + k] as number) + (framePoses.origin[k] as number),
      ) as Vector;
      found[model.forest.name(i)] = {
        position,
        quaternion: Array.from(framePoses.quaternions.subarray(i * 4, i * 4 + 4)),
        visible: framePoses.drawn[i] === 1 && view.tfShown,
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
    get nodes() {
      return nodes.probe();
    },
    get updates() {
      return view.updates;
    },
    get fps() {
      return view.renderer.fps;
    },
    /** Whether the playhead stands still and its frame update is drawn. */
    get settled() {
      const { live, playing } = model.clock;
      return !live && !playing && !model.isSeeking && view.shown === model.frameUpdate;
    },
    /** The camera, expressed in the fixed frame, in meters. */
    get camera() {
      const { camera } = view.renderer;
      const { origin } = view.framePoses;
      const inFixedFrame = (point: THREE.Vector3): number[] =>
        point.toArray().map((value, k) => value + (origin[k] as number));
      return {
        mode: camera.mode,
        position: inFixedFrame(camera.current.position),
        target: inFixedFrame(camera.target),
      };
    },
    /** The cameras of the additional views, in the scene. */
    get panes() {
      return view.panes.probe();
    },
    /** Projects a point of the fixed frame onto the canvas; returns pixels. */
    pixel(point: Vector): [number, number] {
      const { width, height, camera } = view.renderer;
      const projected = new THREE.Vector3(...point)
        .sub(new THREE.Vector3(...view.framePoses.origin))
        .project(camera.current);
      return [((projected.x + 1) / 2) * width, ((1 - projected.y) / 2) * height];
    },
    get connected() {
      return model.connected;
    },
    get live() {
      return model.clock.live;
    },
    get invalidMessages() {
      return model.invalidMessages;
    },
  };
  Object.defineProperty(window, "coframe", { value: probe });
}
