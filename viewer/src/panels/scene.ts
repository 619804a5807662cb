// SPDX-License-Identifier: Apache-2.0
/** The Scene panel: the widgets and the nodes that a program has added. */

import type { Model } from "../model/model";
import type { Widget } from "../protocol/messages";
import type { NodesView } from "../scene/nodes";
import { h, setText, shorten } from "../util/dom";
import { WidgetRow } from "./widgets";

const MAX_ROWS = 300;
const UPDATE_MS = 100;

export class ScenePanel {
  readonly element: HTMLElement;
  private readonly widgetList = h("div", { class: "widgets" });
  private readonly nodeList = h("div", { class: "nodes" });
  private readonly nodeSection: HTMLElement;
  private readonly rows = new Map<number, WidgetRow>();
  private shownNodes = "";
  private timer = 0;

  constructor(
    private readonly model: Model,
    private readonly nodes: NodesView,
    private readonly onChange: () => void,
  ) {
    this.nodeSection = h("div", { class: "section", hidden: true }, h("h3", {}, "Scene nodes"), this.nodeList);
    this.element = h("section", { class: "tab-body" }, this.widgetList, this.nodeSection);
    model.on("hello", () => this.clear());
    model.on("widget", (widget) => this.set(widget));
    model.on("widgets_removed", ({ ids }) => this.remove(ids));
    nodes.onChange(() => {
      // Nodes may change many times per second.
      this.timer ||= window.setTimeout(() => {
        this.timer = 0;
        this.listNodes();
      }, UPDATE_MS);
    });
  }

  get hasWidgets(): boolean {
    return this.rows.size > 0;
  }

  get isEmpty(): boolean {
    return this.rows.size === 0 && this.shownNodes === "";
  }

  private set(widget: Widget): void {
    let row = this.rows.get(widget.id);
    if (!row) {
      row = new WidgetRow(widget, (message) => this.model.send(message));
      this.rows.set(widget.id, row);
      // Ids only grow, so that the new widget is the last one of its folder.
      (this.rows.get(widget.parent ?? -1)?.content ?? this.widgetList).append(row.element);
    }
    row.set(widget);
    this.onChange();
  }

  private remove(ids: readonly number[]): void {
    for (const id of ids) {
      this.rows.get(id)?.element.remove();
      this.rows.delete(id);
    }
    this.onChange();
  }

  private clear(): void {
    this.remove([...this.rows.keys()]);
  }

  private listNodes(): void {
    const all = this.nodes.rows();
    const key = all.length ? JSON.stringify(all) : "";
    if (key === this.shownNodes) return;
    this.shownNodes = key;
    this.nodeSection.hidden = all.length === 0;
    const rows = all.slice(0, MAX_ROWS).map(({ name, kind, hidden, problem }) => {
      const box = h("input", { type: "checkbox", checked: !hidden, aria: { label: `Show ${name}` } });
      box.checked = !hidden;
      box.addEventListener("change", () => this.nodes.setHidden(name, !box.checked));
      const detail = h("small", {});
      setText(detail, problem ? shorten(problem, 120) : kind);
      return h(
        "label",
        { class: problem ? "check problem-row" : "check", title: name, data: { node: name } },
        box,
        h("span", { class: "name" }, shorten(name, 80)),
        detail,
      );
    });
    if (all.length > MAX_ROWS) rows.push(h("label", { class: "check" }, `and ${all.length - MAX_ROWS} more`));
    this.nodeList.replaceChildren(...rows);
    this.onChange();
  }
}
