// SPDX-License-Identifier: Apache-2.0
/** Keyboard shortcuts, and the help dialog that lists them. */

import { h, iconButton } from "../util/dom";

export interface Shortcut {
  key: string;
  shown?: string;
  text: string;
  act(): void;
}

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
        { class: "sheet-body" },
        h(
          "dl",
          { class: "keys" },
          ...[...shortcuts, ...MOUSE].map((s) =>
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
    if (event.ctrlKey || event.metaKey || event.altKey || event.defaultPrevented) return;
    // An open dialog handles its own keys.
    if (document.querySelector("dialog[open]") && !(this.dialog.open && event.key === "?")) return;
    const target = event.target as HTMLElement;
    const typing = target.matches("input:not([type=checkbox]):not([type=range]), select, textarea");
    if (typing && event.key !== "Escape") return;
    if (event.key.startsWith("Arrow") && target.matches("input[type=range]")) return;
    if (event.key === " " && target.matches("button, input, summary")) return;
    const found = this.shortcuts.find((shortcut) => shortcut.key === event.key);
    if (!found) return;
    if (typing) target.blur();
    found.act();
    event.preventDefault();
  }
}

const MOUSE: { key: string; shown?: string; text: string }[] = [
  { key: "drag", text: "Rotate the camera" },
  { key: "right drag", text: "Move the camera" },
  { key: "wheel", text: "Zoom" },
  { key: "click a frame", text: "Select and inspect the frame" },
  { key: "Shift drag on the timeline", text: "Select a time span to loop" },
];
