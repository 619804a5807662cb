// SPDX-License-Identifier: Apache-2.0
/** Keyboard shortcuts, and the help dialog that lists them. */

import type { Camera } from "../scene/camera";
import { h, iconButton } from "../util/dom";

export interface Shortcut {
  key: string;
  shown?: string;
  text: string;
  /** Whether the help lists the key; it does by default. */
  isListed?: boolean;
  act(): void;
}

const TURN = Math.PI / 24;
const MOVE = 0.08;
const ZOOM = 1.2;

/** The keys that move the camera. */
export function cameraKeys(camera: Camera): Shortcut[] {
  const arrows = (keys: string, shown: string, text: string, act: (x: number, y: number) => void): Shortcut[] =>
    ARROWS.map(([name, x, y], i) => ({ key: `${keys}+${name}`, shown, text, isListed: i === 0, act: () => act(x, y) }));
  return [
    ...arrows("Shift", "Shift + arrows", "Rotate the camera", (x, y) => camera.turn(x * TURN, y * TURN)),
    ...arrows("Control", "Ctrl + arrows", "Move the camera", (x, y) => camera.move(x * MOVE, y * MOVE)),
    { key: "+", shown: "+, -", text: "Zoom in and out", act: () => camera.zoom(1 / ZOOM) },
    { key: "-", text: "Zoom out", isListed: false, act: () => camera.zoom(ZOOM) },
  ];
}

const ARROWS = [
  ["ArrowLeft", -1, 0],
  ["ArrowRight", 1, 0],
  ["ArrowUp", 0, 1],
  ["ArrowDown", 0, -1],
] as const;

export class Shortcuts {
  private readonly dialog: HTMLDialogElement;

  constructor(private readonly shortcuts: Shortcut[]) {
    this.dialog = h(
      "dialog",
      { aria: { label: "Keyboard shortcuts" } },
      h(
        "div",
        { class: "sheet-head" },
        h("h2", {}, "Keyboard and mouse"),
        iconButton("close", "Close", () => this.dialog.close()),
      ),
      h(
        "div",
        { class: "sheet-body", tabindex: "0" },
        h(
          "dl",
          { class: "keys" },
          ...[...shortcuts.filter(({ isListed }) => isListed !== false), ...MOUSE].map((s) =>
            h("div", {}, h("dt", {}, s.text), h("dd", {}, h("span", { class: "key" }, s.shown ?? s.key))),
          ),
        ),
      ),
    );
    document.body.append(this.dialog);
    document.addEventListener("keydown", (event) => this.press(event));
  }

  show(): void {
    if (this.dialog.open) this.dialog.close();
    else this.dialog.showModal();
  }

  private press(event: KeyboardEvent): void {
    const arrow = event.key.startsWith("Arrow");
    const undo = (event.ctrlKey || event.metaKey) && !event.altKey && /^[zy]$/i.test(event.key);
    if (!undo && (event.metaKey || event.altKey || (event.ctrlKey && !arrow))) return;
    if (event.defaultPrevented) return;
    // An open dialog handles its own keys.
    if (document.querySelector("dialog[open]") && !(this.dialog.open && event.key === "?")) return;
    const target = event.target as HTMLElement;
    const typing = target.matches("input:not([type=checkbox]):not([type=range]), select, textarea");
    if (typing && event.key !== "Escape") return;
    // Sliders, tabs and menus have keys of their own.
    if (arrow && target.matches(OWN_ARROWS)) return;
    if (event.key === " " && target.matches("button, input, summary")) return;
    const isRedo = event.shiftKey || event.key.toLowerCase() === "y";
    const key = undo
      ? `Control+${isRedo ? "Z" : "z"}`
      : arrow
        ? `${event.ctrlKey ? "Control+" : event.shiftKey ? "Shift+" : ""}${event.key}`
        : event.key;
    const found = this.shortcuts.find((shortcut) => shortcut.key === key);
    if (!found) return;
    if (typing) target.blur();
    found.act();
    event.preventDefault();
  }
}

/** Elements that use the arrow keys themselves. */
const OWN_ARROWS = "input[type=range], input[type=radio], [role=slider], [role=tab], [role=menuitem], [role=treeitem]";

const MOUSE: { key: string; shown?: string; text: string }[] = [
  { key: "drag", text: "Rotate the camera" },
  { key: "middle drag, Shift drag", text: "Move the camera" },
  { key: "wheel, right drag", text: "Zoom" },
  { key: "double-click", text: "Look at the point" },
  { key: "click", text: "Select and inspect a frame, a point, a marker or a link" },
  { key: "Shift drag on the timeline", text: "Select a time span to loop" },
];
