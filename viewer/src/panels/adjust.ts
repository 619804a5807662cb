// SPDX-License-Identifier: Apache-2.0
/** The part of the inspector that adjusts a static transform by hand: a mount that is calibrated by eye. */

import { copyText, h, iconButton, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { distance, relativePose, rpyDegrees } from "../util/math";
import type { Model } from "../model/model";
import type { GizmoMode } from "../scene/gizmo";
import { staticCommands } from "../util/static_commands";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

export class AdjustPanel {
  private readonly element = h("div", { class: "block adjust", id: "adjust" });
  private readonly start = h("button", { type: "button", class: "small" }, "Adjust by hand");
  private readonly modes: Record<GizmoMode, HTMLButtonElement>;
  private readonly change = h("div", { class: "numbers" });
  private readonly publish = h("button", { type: "button", class: "small primary" }, "Publish");
  private readonly body = h("div", { hidden: true });
  private readonly commands: { text: HTMLElement; label: HTMLElement }[] = [];
  private mode: GizmoMode = "translate";
  /** Whether the transform was sent to the server, which has not confirmed it yet. */
  private isSent = false;

  constructor(
    root: HTMLElement,
    private readonly model: Model,
    private readonly view: View,
    private readonly live: boolean,
  ) {
    this.modes = { translate: this.modeButton("translate", "Move"), rotate: this.modeButton("rotate", "Rotate") };
    this.start.addEventListener("click", () => this.toggle());
    this.publish.addEventListener("click", () => this.send());
    this.body.append(
      h("div", { class: "buttons" }, this.modes.translate, this.modes.rotate),
      this.change,
      ...[0, 1, 2].map((k) => this.commandRow(k)),
      h(
        "div",
        { class: "buttons" },
        h("button", { type: "button", class: "small", on: { click: () => this.reset() } }, "Reset"),
        this.publish,
      ),
    );
    this.element.append(h("div", { class: "block-head" }, "Static transform"), this.start, this.body);
    root.append(this.element);
    const { adjuster } = view;
    adjuster.onChange(() => this.show());
    model.on("selection", ({ frame }) => {
      if (adjuster.current && adjuster.current.child !== frame) adjuster.stop();
      this.show();
    });
    for (const event of ["tree", "hello"] as const) model.on(event, () => this.show());
    model.on("published", ({ topic, subscribers }) => {
      const { current } = adjuster;
      if (!current || !this.isSent) return;
      this.isSent = false;
      const others = "If another node publishes this transform, its next message replaces yours.";
      toast(
        `Published ${current.parent} → ${current.child} on ${topic} (${subscribers} subscriptions).`,
        others,
        "info",
      );
    });
    this.show();
  }

  private toggle(): void {
    const { adjuster } = this.view;
    const { frame } = this.model.selection;
    if (adjuster.current) adjuster.stop();
    else if (frame) adjuster.start(frame, this.mode);
  }

  private reset(): void {
    const { adjuster } = this.view;
    if (adjuster.current) adjuster.set(adjuster.current.originalPose);
  }

  private send(): void {
    const { current } = this.view.adjuster;
    if (!current) return;
    const { parent, child, pose } = current;
    this.isSent = true;
    this.model.send({
      type: "publish_static",
      parent,
      child,
      translation: pose.position,
      quaternion: pose.quaternion,
    });
  }

  private show(): void {
    const { adjuster } = this.view;
    const { current } = adjuster;
    // A replay does not contain the frames of its messages, which would stay behind.
    this.element.hidden = !this.live || !adjuster.canAdjust(this.model.selection.frame);
    setText(this.start, current ? "Stop adjusting" : "Adjust by hand");
    this.start.setAttribute("aria-pressed", String(current !== null));
    this.body.hidden = current === null;
    if (!current) return;
    const { parent, child, pose, originalPose: original } = current;
    const moved = format.meters(distance(original.position, pose.position));
    const angles = rpyDegrees(relativePose(original, pose).quaternion).map((angle) => format.formatFixed(angle, 2));
    setText(
      this.change,
      `Moved ${moved}, rotated ${angles.join("°, ")}°. Other pages and nodes see it when published.`,
    );
    staticCommands(parent, child, pose).forEach(({ name, text }, k) => {
      setText((this.commands[k] as { label: HTMLElement }).label, name);
      setText(
        (this.commands[k] as { text: HTMLElement }).text,
        text.length > 1000 ? "The frame names are too long." : shorten(text, 1000),
      );
    });
    const possible = this.model.hello?.can_publish ?? false;
    this.publish.disabled = !possible;
    this.publish.title = possible
      ? "Publish on /tf_static from the viewer's node"
      : "Publishing requires a live ROS graph.";
    for (const [mode, button] of Object.entries(this.modes))
      button.setAttribute("aria-pressed", String(mode === this.mode));
  }

  private modeButton(mode: GizmoMode, text: string): HTMLButtonElement {
    const choose = (): void => {
      this.mode = mode;
      this.view.adjuster.setMode(mode);
      this.show();
    };
    return h("button", { type: "button", class: "small", on: { click: choose } }, text);
  }

  private commandRow(k: number): HTMLElement {
    const [label, text] = [h("span"), h("pre", { class: "command" })];
    this.commands[k] = { label, text };
    const copy = iconButton("copy", "Copy the command", () => {
      void copyText(text.textContent ?? "").then((ok) =>
        toast(
          ok ? `Copied: ${label.textContent}` : "The browser does not allow this page to use the clipboard.",
          null,
          "info",
        ),
      );
    });
    return h("div", {}, h("div", { class: "block-head" }, label, copy), text);
  }
}
