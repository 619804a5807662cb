// SPDX-License-Identifier: Apache-2.0
/** Controls above the scene: view buttons, measurements, and instructions if there are no transforms. */

import type { CameraMode } from "../scene/camera";
import { h, iconButton, setText, shorten } from "../util/dom";
import type { Model } from "../model/model";
import { MAX_PANES } from "../scene/panes";
import type { View } from "../scene/view";

/** Messages appear only if the server has not responded within this time. */
const MESSAGE_DELAY_MS = 900;
const FPS_INTERVAL_MS = 1000;
const SILENT =
  "The server has stopped responding, or the network is interrupted. The scene shows the last data received.";
const NO_GRAPHICS =
  "The browser has withdrawn the graphics card, so the scene cannot be drawn. " +
  "If it does not return within a few seconds, reload the page or close other tabs with 3D content.";

export class Overlay {
  private readonly orbit: HTMLButtonElement;
  private readonly topButton: HTMLButtonElement;
  private readonly followButton: HTMLButtonElement;
  private readonly ruler: HTMLButtonElement;
  private readonly newPaneButton: HTMLButtonElement;
  private readonly selectButton: HTMLButtonElement;
  private readonly focusButton: HTMLButtonElement;
  private readonly hint = h("div", { class: "hint numbers", role: "status", id: "measured", hidden: true });
  private readonly followHint = h("div", { class: "hint", hidden: true });
  private readonly fps = h("div", { class: "fps numbers" });
  private readonly emptyHint: HTMLElement;
  private shownMode: CameraMode = "orbit";
  private isEmptyHintClosed = false;
  private noticeTimer = 0;
  private fpsUpdated = 0;

  constructor(
    root: HTMLElement,
    private readonly notice: HTMLElement,
    private readonly model: Model,
    private readonly view: View,
    onViews: () => void,
  ) {
    this.orbit = h(
      "button",
      { type: "button", title: "Orbit view (v)", on: { click: () => this.setMode("orbit") } },
      "3D",
    );
    this.topButton = h(
      "button",
      { type: "button", title: "Top-down view (v)", on: { click: () => this.setMode("top") } },
      "Top",
    );
    this.followButton = iconButton("target", "Follow the selected frame (f)", () => this.toggleFollow());
    this.ruler = iconButton("ruler", "Measure between two frames or points (m, n)", () => this.toggleMeasure());
    this.selectButton = iconButton("select", "Select: click anything, or drag a rectangle (k)", () =>
      view.tools.toggle("select"),
    );
    this.focusButton = iconButton("focus", "Look at the point that is clicked next (z), or double-click it", () =>
      view.tools.toggle("focus"),
    );
    this.newPaneButton = iconButton("plus", "Add a view: from above, around or out of a frame", () => this.addView());
    this.emptyHint = h(
      "div",
      { class: "empty-scene", hidden: true },
      h("h2", {}, "No transforms yet"),
      h("p", {}, "To see a moving robot, run this in another terminal:"),
      h("code", {}, "coframe demo"),
      h("p", {}, "Or start your own broadcasters with the same ROS_DOMAIN_ID."),
      iconButton("close", "Close", () => this.closeEmpty()),
    );
    root.append(
      this.hint,
      this.followHint,
      h(
        "div",
        { class: "view-tools", role: "toolbar", aria: { label: "View" } },
        this.orbit,
        this.topButton,
        iconButton("fit", "Show everything (a)", () => view.fit()),
        this.followButton,
        this.focusButton,
        this.selectButton,
        this.ruler,
        iconButton("camera", "Numbers of the view, and saved views (w)", onViews),
        this.newPaneButton,
      ),
      this.fps,
      this.emptyHint,
    );
    for (const event of ["connected", "silent"] as const) model.on(event, () => this.updateNotice());
    view.renderer.onLost(() => this.updateNotice());
    for (const event of ["tree", "robot"] as const) model.on(event, () => this.updateEmpty());
    model.on("hello", () => setTimeout(() => this.updateEmpty(), MESSAGE_DELAY_MS));
    model.on("selection", () => this.updateButtons());
    view.tools.onChange(() => this.updateButtons());
    view.onDrawn(() => this.updateHints());
    this.updateButtons();
  }

  toggleTop(): void {
    this.setMode(this.view.renderer.camera.mode === "top" ? "orbit" : "top");
  }

  toggleFollow(): void {
    const { frame } = this.model.selection;
    this.view.setFollowed(this.view.followed === frame ? null : frame);
    this.updateButtons();
  }

  toggleMeasure(): void {
    this.view.tools.toggle("measure");
  }

  /** Adds a view around the selected frame, or from above. */
  private addView(): void {
    const { frame } = this.model.selection;
    this.view.panes.add({ kind: frame ? "orbit" : "top", frame });
  }

  private setMode(mode: CameraMode): void {
    this.view.renderer.camera.setMode(mode);
    this.view.refresh();
    this.updateButtons();
  }

  private updateButtons(): void {
    const { camera } = this.view.renderer;
    this.shownMode = camera.mode;
    this.orbit.setAttribute("aria-pressed", String(camera.mode !== "top"));
    this.topButton.setAttribute("aria-pressed", String(camera.mode === "top"));
    this.followButton.setAttribute("aria-pressed", String(this.view.followed !== null));
    this.followButton.disabled = this.view.followed === null && this.model.selection.frame === null;
    const { active } = this.view.tools;
    for (const [button, tool] of [
      [this.ruler, "measure"],
      [this.selectButton, "select"],
      [this.focusButton, "focus"],
    ] as const)
      button.setAttribute("aria-pressed", String(active === tool));
  }

  private updateHints(): void {
    const { measure, followed } = this.view;
    this.hint.hidden = !measure.active;
    if (measure.active) setText(this.hint, measure.text());
    this.followHint.hidden = followed === null;
    if (followed !== null) setText(this.followHint, `Following ${shorten(followed, 40)}`);
    const pressed = String(followed !== null);
    const changed = this.shownMode !== this.view.renderer.camera.mode;
    if (changed || this.followButton.getAttribute("aria-pressed") !== pressed) this.updateButtons();
    this.newPaneButton.disabled = this.view.panes.count >= MAX_PANES;
    const now = performance.now();
    if (now - this.fpsUpdated < FPS_INTERVAL_MS) return;
    this.fpsUpdated = now;
    setText(this.fps, `${this.view.renderer.fps} fps`);
  }

  private closeEmpty(): void {
    this.isEmptyHintClosed = true;
    this.updateEmpty();
  }

  private updateEmpty(): void {
    const { forest, hello, robots } = this.model;
    this.emptyHint.hidden = this.isEmptyHintClosed || forest.frames.length > 0 || !hello || robots.size > 0;
  }

  private updateNotice(): void {
    const { connected, silent } = this.model;
    if (connected) {
      clearTimeout(this.noticeTimer);
      this.noticeTimer = 0;
      const text = silent ? SILENT : this.view.renderer.isContextLost ? NO_GRAPHICS : "";
      this.notice.hidden = !text;
      if (text) setText(this.notice, text);
      return;
    }
    // Each failed attempt to reconnect calls this again; only the first one starts the timer.
    this.noticeTimer ||= window.setTimeout(() => {
      this.notice.hidden = false;
      setText(
        this.notice,
        "The connection to the server is lost. The page reconnects automatically when the server runs again.",
      );
    }, MESSAGE_DELAY_MS);
  }
}
