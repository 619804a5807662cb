// SPDX-License-Identifier: Apache-2.0
/** Over the scene: how to look, what is being measured, and what to do when there is nothing to see. */

import type { CameraMode } from "../scene/camera";
import { h, iconButton, setText, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { View } from "../scene/view";

/** A server that answers within this is not worth a word. */
const PATIENCE_MS = 900;
const COUNT_MS = 1000;

export class Overlay {
  private readonly orbit: HTMLButtonElement;
  private readonly top: HTMLButtonElement;
  private readonly follow: HTMLButtonElement;
  private readonly ruler: HTMLButtonElement;
  private readonly hint = h("div", { class: "hint numbers", role: "status", id: "measured", hidden: true });
  private readonly following = h("div", { class: "hint", hidden: true });
  private readonly corner = h("div", { class: "corner numbers" });
  private readonly nothing: HTMLElement;
  private lost = 0;
  private counted = 0;

  constructor(
    root: HTMLElement,
    private readonly notice: HTMLElement,
    private readonly model: Model,
    private readonly view: View,
  ) {
    this.orbit = h(
      "button",
      { type: "button", title: "Turning view (v)", on: { click: () => this.setMode("orbit") } },
      "3D",
    );
    this.top = h(
      "button",
      { type: "button", title: "From above (v)", on: { click: () => this.setMode("top") } },
      "Top",
    );
    this.follow = iconButton("target", "Follow the selected frame (f)", () => this.toggleFollow());
    this.ruler = iconButton("ruler", "Measure between two frames (m)", () => this.toggleMeasure());
    this.nothing = h(
      "div",
      { class: "nothing", hidden: true },
      h("h2", {}, "No transforms yet"),
      h("p", {}, "To see a moving robot, run this in another terminal:"),
      h("code", {}, "coframe demo"),
      h("p", {}, "Or start your own broadcasters with the same ROS_DOMAIN_ID."),
    );
    root.append(
      this.hint,
      this.following,
      h(
        "div",
        { class: "view-tools", role: "toolbar", aria: { label: "View" } },
        this.orbit,
        this.top,
        iconButton("fit", "Show everything (a)", () => view.fit()),
        this.follow,
        this.ruler,
      ),
      this.corner,
      this.nothing,
    );
    model.on("connected", (connected) => this.tellConnection(connected));
    for (const event of ["tree", "robot"] as const) model.on(event, () => this.tellNothing());
    model.on("hello", () => setTimeout(() => this.tellNothing(), PATIENCE_MS));
    model.on("selection", () => this.tellButtons());
    view.onDrawn(() => this.tellPicture());
    this.tellButtons();
  }

  toggleTop(): void {
    this.setMode(this.view.stage.camera.mode === "top" ? "orbit" : "top");
  }

  toggleFollow(): void {
    const { frame } = this.model.selection;
    this.view.setFollowed(this.view.followed === frame ? null : frame);
    this.tellButtons();
  }

  toggleMeasure(): void {
    const { measure } = this.view;
    measure.setActive(!measure.active);
    this.view.refresh();
    this.tellButtons();
  }

  private setMode(mode: CameraMode): void {
    this.view.stage.camera.setMode(mode);
    this.view.refresh();
    this.tellButtons();
  }

  private tellButtons(): void {
    const { camera } = this.view.stage;
    this.orbit.setAttribute("aria-pressed", String(camera.mode === "orbit"));
    this.top.setAttribute("aria-pressed", String(camera.mode === "top"));
    this.follow.setAttribute("aria-pressed", String(this.view.followed !== null));
    this.follow.disabled = this.view.followed === null && this.model.selection.frame === null;
    this.ruler.setAttribute("aria-pressed", String(this.view.measure.active));
  }

  private tellPicture(): void {
    const { measure, followed } = this.view;
    this.hint.hidden = !measure.active;
    if (measure.active) setText(this.hint, measure.text());
    this.following.hidden = followed === null;
    if (followed !== null) setText(this.following, `Following ${shorten(followed, 40)}`);
    const pressed = String(followed !== null);
    if (this.follow.getAttribute("aria-pressed") !== pressed) this.tellButtons();
    const now = performance.now();
    if (now - this.counted < COUNT_MS) return;
    this.counted = now;
    setText(this.corner, `${this.view.stage.fps} pictures/s`);
  }

  private tellNothing(): void {
    const { forest, hello, robots } = this.model;
    this.nothing.hidden = forest.frames.length > 0 || !hello || robots.size > 0;
  }

  private tellConnection(connected: boolean): void {
    if (connected) {
      clearTimeout(this.lost);
      this.lost = 0;
      this.notice.hidden = true;
      return;
    }
    // Every attempt that fails says so again: the first counts.
    this.lost ||= window.setTimeout(() => {
      this.notice.hidden = false;
      setText(
        this.notice,
        "The connection to the server is lost. This page comes back by itself when the server runs again.",
      );
    }, PATIENCE_MS);
  }
}
