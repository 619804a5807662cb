// SPDX-License-Identifier: Apache-2.0
/** The buttons of the tools that publish, what the active one does, and its topic. */

import { h, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import type { Model } from "../model/model";
import { PUBLISHING_TOOLS, type PublishingTool, type ToolSettings } from "../model/tools";
import type { Vector } from "../protocol/messages";
import { isPublishingTool, type Tool } from "../scene/tools";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const BUTTONS: readonly [tool: PublishingTool, text: string, key: string][] = [
  ["estimate", "Pose", "p"],
  ["goal", "Goal", "g"],
  ["point", "Point", "u"],
];
const INSTRUCTIONS: Record<PublishingTool, string> = {
  estimate: "Press at the position of the robot, drag in its direction",
  goal: "Press at the goal, drag in the direction",
  point: "Click a point on a surface or on the ground",
};
const NOT_LIVE = "Publishing requires a live ROS graph.";

export class Toolbar {
  private readonly buttons = new Map<PublishingTool, HTMLButtonElement>();
  private readonly bar = h("div", { class: "publish-tools", role: "toolbar", aria: { label: "Publish" } });
  private readonly hint = h("div", { class: "hint tool-hint", role: "status", id: "tool", hidden: true });
  private readonly instruction = h("span");
  private readonly topic = h("input", { type: "text", aria: { label: "Topic of the tool" } });
  /** The last message that was sent. */
  private lastSent: { topic: string; what: string } | null = null;

  constructor(
    root: HTMLElement,
    private readonly model: Model,
    private readonly view: View,
    private readonly settings: ToolSettings,
  ) {
    for (const [tool, text, key] of BUTTONS) {
      const button = h("button", { type: "button", on: { click: () => this.toggle(tool) } }, text);
      button.dataset.tool = tool;
      button.dataset.key = key;
      this.buttons.set(tool, button);
    }
    this.bar.append(...this.buttons.values());
    root.append(this.hint, this.bar);
    this.hint.append(this.instruction, h("label", {}, "on ", this.topic));
    this.topic.addEventListener("change", () => this.setTopic());
    view.tools.onChange((tool) => this.show(tool));
    view.tools.onPose((tool, position, yaw) => this.publishPose(tool, position, yaw));
    view.onPoint((point) => this.publishPoint(point));
    model.on("hello", () => this.updateButtons());
    model.on("fixed", () => this.updateButtons());
    model.on("published", ({ topic, subscribers }) => {
      if (this.lastSent?.topic !== topic) return;
      const nodes = subscribers === 1 ? "1 subscription" : `${subscribers} subscriptions`;
      toast(
        `Published on ${topic}: ${this.lastSent.what}.`,
        subscribers ? nodes : `No node subscribes to ${topic}.`,
        "info",
      );
    });
    this.updateButtons();
  }

  toggle(tool: PublishingTool): void {
    if (this.model.hello?.can_publish) this.view.tools.toggle(tool);
    else toast(NOT_LIVE, "Start the viewer with: coframe view");
  }

  private publishPose(tool: PublishingTool, position: Vector, yaw: number): void {
    const { fixed } = this.model;
    const topic = this.settings.topic(tool);
    const covariance = tool === "estimate" ? { covariance: this.settings.variances } : {};
    const degrees = format.formatFixed((yaw * 180) / Math.PI, 1);
    this.lastSent = { topic, what: `${coordinates(position)}, yaw ${degrees}° in ${fixed}` };
    this.model.send({ type: "publish_pose", topic, frame: fixed, position, yaw, ...covariance });
  }

  private publishPoint(point: Vector): void {
    const { fixed } = this.model;
    const topic = this.settings.topic("point");
    this.lastSent = { topic, what: `${coordinates(point)} in ${fixed}` };
    this.model.send({ type: "publish_point", topic, frame: fixed, point });
  }

  private setTopic(): void {
    const { active } = this.view.tools;
    if (!isPublishingTool(active)) return;
    this.settings.setTopic(active, this.topic.value.trim());
    this.topic.value = this.settings.topic(active);
    this.updateButtons();
  }

  private show(tool: Tool | null): void {
    this.hint.hidden = !isPublishingTool(tool);
    if (isPublishingTool(tool)) {
      const { title } = PUBLISHING_TOOLS[tool];
      setText(this.instruction, `${title}: ${INSTRUCTIONS[tool]}. Publishes in ${shorten(this.model.fixed, 40)}`);
      this.topic.value = this.settings.topic(tool);
    }
    this.updateButtons();
  }

  private updateButtons(): void {
    const possible = this.model.hello?.can_publish ?? false;
    this.bar.hidden = this.model.hello?.mode === "replay";
    for (const [tool, button] of this.buttons) {
      const what = `${PUBLISHING_TOOLS[tool].title} (${button.dataset.key}): ${this.settings.topic(tool)}`;
      button.title = possible ? what : `${what}. ${NOT_LIVE}`;
      button.setAttribute("aria-disabled", String(!possible));
      button.setAttribute("aria-pressed", String(this.view.tools.active === tool));
    }
  }
}

function coordinates(point: Vector): string {
  return (["x", "y", "z"] as const).map((name, k) => `${name} ${format.formatFixed(point[k] as number, 3)}`).join(", ");
}
