// SPDX-License-Identifier: Apache-2.0
/** Undoes changes of the displays and of the camera. */

import type { Displays } from "../displays/manager";
import type { View as CameraView } from "../scene/camera";
import type { View } from "../scene/view";
import { toast } from "../util/toast";

const MAX_STEPS = 100;
/** The displays of a large .rviz file take a megabyte per step. */
const MAX_CHARACTERS = 32 << 20;
/** A drag or several turns of the wheel are one step; the camera also needs a moment to come to rest. */
const SETTLING_MS = 400;

interface Snapshot {
  displays: string;
  camera: string;
}

export class Undo {
  private readonly past: Snapshot[] = [];
  private future: Snapshot[] = [];
  private current: Snapshot;
  private timer = 0;
  /** Whether the user does something that is not noted yet, such as a drag. */
  private isActing = false;

  constructor(
    private readonly displays: Displays,
    private readonly view: View,
  ) {
    this.current = this.snapshot();
    const listen = (events: string[], act: () => void): void => {
      for (const event of events) document.addEventListener(event, act, { capture: true, passive: true });
    };
    listen(["pointerdown", "wheel", "keydown"], () => {
      this.absorb();
      this.isActing = true;
    });
    listen(["pointerup", "pointercancel", "wheel", "keyup", "change"], () => this.noteSoon());
    displays.onChange(() => {
      if (this.isActing) this.noteDisplays();
      else this.absorb();
    });
  }

  /** Forgets all steps, for example because a file was opened. */
  clear(): void {
    this.past.length = 0;
    this.future = [];
    this.current = this.snapshot();
  }

  undo(): void {
    this.note();
    this.go(this.past, this.future, "Nothing to undo.");
  }

  redo(): void {
    this.note();
    this.go(this.future, this.past, "Nothing to redo.");
  }

  private go(from: Snapshot[], to: Snapshot[], nothing: string): void {
    const wanted = from.pop();
    if (!wanted) {
      toast(nothing, null, "info");
      return;
    }
    to.push(this.current);
    if (wanted.displays !== this.current.displays) this.displays.restore(wanted.displays);
    if (wanted.camera !== this.current.camera) this.view.setView(JSON.parse(wanted.camera) as CameraView);
    this.current = { displays: this.displays.snapshot(), camera: wanted.camera };
  }

  private snapshot(): Snapshot {
    return { displays: this.displays.snapshot(), camera: this.camera() };
  }

  private camera(): string {
    const round = (_key: string, value: unknown): unknown =>
      typeof value === "number" ? Number(value.toPrecision(6)) : value;
    return JSON.stringify(this.view.savedView, round);
  }

  /** What happens without the user, such as a new topic or the first fit of the camera, is not a step. */
  private absorb(): void {
    if (!this.isActing) this.current = this.snapshot();
  }

  /** A change of a display is a step of its own, also when the next one follows at once. */
  private noteDisplays(): void {
    if (this.displays.snapshot() !== this.current.displays) this.note();
    this.isActing = true;
  }

  private noteSoon(): void {
    clearTimeout(this.timer);
    this.timer = window.setTimeout(() => this.note(), SETTLING_MS);
  }

  /** Adds a step if something has changed since the last one. */
  private note(): void {
    clearTimeout(this.timer);
    this.isActing = false;
    const now = this.snapshot();
    if (now.displays === this.current.displays && now.camera === this.current.camera) return;
    // Moving the camera does not need another copy of the displays.
    if (now.displays === this.current.displays) now.displays = this.current.displays;
    this.past.push(this.current);
    this.future = [];
    this.current = now;
    while (this.past.length > MAX_STEPS || charactersOf(this.past) > MAX_CHARACTERS) this.past.shift();
  }
}

/** The length of all steps; steps with the same displays share their text. */
function charactersOf(steps: readonly Snapshot[]): number {
  let total = 0;
  for (const [i, { displays, camera }] of steps.entries())
    total += camera.length + (displays === steps[i - 1]?.displays ? 0 : displays.length);
  return total;
}
