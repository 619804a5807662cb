// SPDX-License-Identifier: Apache-2.0
/** The tools that publish: their topics and options, as in .rviz files. */

import type { JsonObject, RvizTool } from "../protocol/messages";

export type PublishingTool = "estimate" | "goal" | "point";

/** RViz's names and default topics. */
export const PUBLISHING_TOOLS: Record<PublishingTool, { class: string; title: string; topic: string }> = {
  estimate: { class: "SetInitialPose", title: "2D pose estimate", topic: "/initialpose" },
  goal: { class: "SetGoal", title: "2D goal pose", topic: "/goal_pose" },
  point: { class: "PublishPoint", title: "Publish point", topic: "/clicked_point" },
};

/** RViz's default variances of x and y in square meters, and of yaw in square radians: a deviation of 15 degrees. */
const VARIANCES: readonly [key: string, value: number][] = [
  ["Covariance x", 0.25],
  ["Covariance y", 0.25],
  ["Covariance yaw", (Math.PI / 12) ** 2],
];

export class ToolSettings {
  private readonly topics = new Map<PublishingTool, string>();
  private readonly options = new Map<PublishingTool, JsonObject>();

  topic(tool: PublishingTool): string {
    return this.topics.get(tool) ?? PUBLISHING_TOOLS[tool].topic;
  }

  /** Sets a topic; an empty one restores the default. */
  setTopic(tool: PublishingTool, topic: string): void {
    if (topic) this.topics.set(tool, topic);
    else this.topics.delete(tool);
  }

  /** The variances that a pose estimate is published with. */
  get variances(): [number, number, number] {
    const options = this.options.get("estimate") ?? {};
    return VARIANCES.map(([key, value]) => {
      const given = options[key];
      return typeof given === "number" && given >= 0 ? given : value;
    }) as [number, number, number];
  }

  /** Replaces all settings by those of an .rviz file. */
  load(tools: readonly RvizTool[]): void {
    this.topics.clear();
    this.options.clear();
    for (const [tool, { class: name }] of entries()) {
      const found = tools.find((one) => one.class === name);
      if (found?.topic) this.topics.set(tool, found.topic);
      if (found) this.options.set(tool, found.options);
    }
  }

  /** The tools that differ from the defaults, in the format of .rviz files. */
  save(): RvizTool[] {
    return entries()
      .filter(([tool]) => this.topics.has(tool) || this.options.has(tool))
      .map(([tool, { class: name }]) => ({
        class: name,
        topic: this.topic(tool),
        options: this.options.get(tool) ?? {},
      }));
  }
}

function entries(): [PublishingTool, (typeof PUBLISHING_TOOLS)[PublishingTool]][] {
  return Object.entries(PUBLISHING_TOOLS) as [PublishingTool, (typeof PUBLISHING_TOOLS)[PublishingTool]][];
}
