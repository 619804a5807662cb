// SPDX-License-Identifier: Apache-2.0
/** The DiagnosticArray display: a table of the newest status of each component, in a corner above the scene. */

import * as THREE from "three";
import type { DiagnosticItem, Shapes } from "../protocol/messages";
import { byId, h, setText, shorten } from "../util/dom";
import { MessageDisplay, type Context, type DisplayConfig } from "./display";

const LEVELS = ["OK", "Warning", "Error", "Stale"];
const LOWEST_LEVEL: Record<string, number> = { All: 0, "Warnings and errors": 1, Errors: 2 };

export class DiagnosticsDisplay extends MessageDisplay<Shapes, "DiagnosticArray"> {
  private readonly body = h("tbody");
  private readonly caption = h("figcaption");
  private readonly figure = h(
    "figure",
    { class: "diagnostics", hidden: true },
    h("div", { class: "table" }, h("table", {}, this.body)),
    this.caption,
  );
  /** The names of the components whose values are shown. */
  private readonly open = new Set<string>();
  private shownShapes: Shapes | null = null;

  constructor(id: number, config: DisplayConfig, context: Context) {
    super(id, config, context);
    byId("images").append(this.figure);
  }

  protected build(): THREE.Object3D {
    return new THREE.Group();
  }

  override restyle(): void {
    super.restyle();
    this.figure.style.width = `${this.options.number("Width")}px`;
    this.render();
  }

  protected override onPose(_object: THREE.Object3D, message: Shapes): void {
    if (message === this.shownShapes) return;
    this.shownShapes = message;
    this.render();
  }

  override clear(): void {
    super.clear();
    this.shownShapes = null;
    this.render();
  }

  override dispose(): void {
    this.figure.remove();
    super.dispose();
  }

  protected override describe({ description }: Shapes): Record<string, unknown> {
    const items = description.kind === "diagnostics" ? description.items : [];
    return { rows: items.map(({ level, name, message }) => [level, name, message]) };
  }

  private render(): void {
    const description = this.shownShapes?.description;
    const items = description?.kind === "diagnostics" ? description.items : [];
    const lowest = LOWEST_LEVEL[this.options.choice("Show")] ?? 0;
    const visible = items.filter(({ level }) => level >= lowest);
    this.body.replaceChildren(...visible.flatMap((item) => this.rows(item)));
    this.figure.hidden = !this.shownShapes;
    const counts = LEVELS.map((name, level) => [items.filter((item) => item.level === level).length, name] as const);
    const summary = counts.filter(([count]) => count > 0).map(([count, name]) => `${count} ${name}`);
    setText(this.caption, [shorten(this.config.topic ?? this.config.name, 60), ...summary].join(" · "));
  }

  private rows(item: DiagnosticItem): HTMLElement[] {
    const isOpen = this.open.has(item.name);
    const toggle = (): void => {
      if (isOpen) this.open.delete(item.name);
      else this.open.add(item.name);
      this.render();
    };
    const name = h("button", { type: "button", aria: { expanded: String(isOpen) }, on: { click: toggle } }, item.name);
    const level = LEVELS[item.level] ?? `Level ${item.level}`;
    const row = h(
      "tr",
      { data: { level: String(item.level) } },
      h("td", {}, level),
      h("td", {}, name),
      h("td", {}, item.message),
    );
    if (!isOpen) return [row];
    const hardware: [string, string][] = item.hardware ? [["Hardware", item.hardware]] : [];
    const values = [...hardware, ...(item.values as [string, string][])];
    return [
      row,
      ...values.map(([key, value]) => h("tr", { class: "value" }, h("td"), h("td", {}, key), h("td", {}, value))),
    ];
  }
}
