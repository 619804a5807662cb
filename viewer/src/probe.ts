/** What tests, and the curious, can read of the page: `window.coframe`, told anew with each picture. */

import type { Displays } from "./displays/manager";
import type { Model } from "./model";
import type { Vector } from "./protocol";
import type { View } from "./view";

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
