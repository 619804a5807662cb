// SPDX-License-Identifier: Apache-2.0
/** The dialog that adds a display: all topics, searched and grouped by type or by node. */

import { displayClass } from "../displays/display";
import type { Displays } from "../displays/manager";
import { DISPLAYS } from "../generated/displays";
import type { Model } from "../model/model";
import type { DisplayTopic, NodeGraph } from "../protocol/messages";
import { h, iconButton, select, shorten } from "../util/dom";
import * as format from "../util/format";

const MAX_ROWS = 500;
const WITHOUT_TOPIC = Object.entries(DISPLAYS).flatMap(([kind, { types }]) => (types.length === 0 ? [kind] : []));
const INSPECTED = "Without a display: only in the message inspector";

interface Row {
  /** The class of the display; "" for a topic that has none. */
  kind: string;
  topic: string | null;
  type: string;
}

export class AddDisplay {
  private readonly dialog: HTMLDialogElement;
  private readonly search = h("input", {
    type: "search",
    placeholder: "Topic, type or node",
    aria: { label: "Search" },
  });
  private readonly list = h("div", { class: "add-list" });
  private grouping = "type";
  private graph: NodeGraph | null = null;
  /** What the list contains, as text. */
  private shown = "";

  constructor(
    private readonly model: Model,
    private readonly displays: Displays,
  ) {
    const grouping = select(
      "Group",
      [
        ["type", "By type"],
        ["node", "By node"],
      ],
      this.grouping,
      (value) => {
        this.grouping = value;
        this.fill();
      },
    );
    this.dialog = h(
      "dialog",
      { class: "add-display", aria: { label: "Add a display" } },
      h(
        "div",
        { class: "sheet-head" },
        h("h2", {}, "Add a display"),
        iconButton("close", "Close", () => this.dialog.close()),
      ),
      h("div", { class: "toolbar" }, this.search, grouping),
      this.list,
    );
    document.body.append(this.dialog);
    this.search.addEventListener("input", () => this.fill());
    this.search.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault(); // The button that has opened the dialog gets the focus back.
      this.list.querySelector<HTMLButtonElement>("button")?.click();
    });
    this.dialog.addEventListener("close", () => this.model.countGraphUsers(false));
    model.on("topics", () => this.dialog.open && this.fill());
    model.on("graph", (graph) => {
      this.graph = graph;
      if (this.dialog.open && this.grouping === "node") this.fill();
    });
  }

  show(): void {
    if (this.dialog.open) return;
    this.search.value = "";
    this.model.countGraphUsers(true);
    this.fill();
    this.dialog.showModal();
    this.search.focus();
  }

  private fill(): void {
    const wanted = this.search.value.trim().toLowerCase();
    const groups = this.grouping === "node" ? this.byNode() : this.byType();
    let left = MAX_ROWS;
    const found = [...groups].flatMap(([title, rows]) => {
      const matching = rows.filter(({ kind, topic, type }) =>
        `${title} ${kind} ${topic ?? ""} ${type}`.toLowerCase().includes(wanted),
      );
      const shown = matching.slice(0, Math.max(0, left)).map((row) => ({ ...row, isShown: this.isShown(row) }));
      left -= shown.length;
      return shown.length ? [{ title, shown }] : [];
    });
    // A button that is replaced between press and release is not clicked.
    const text = JSON.stringify(found);
    if (text === this.shown) return;
    this.shown = text;
    const sections = found.map(({ title, shown }) =>
      h("section", {}, h("h3", {}, shorten(title, 100)), ...shown.map((row) => this.row(row, row.isShown))),
    );
    this.list.replaceChildren(...(sections.length ? sections : [h("p", { class: "muted" }, "No topic matches.")]));
  }

  private byType(): Map<string, Row[]> {
    const groups = new Map<string, Row[]>();
    const add = (title: string, row: Row): void => void groups.set(title, [...(groups.get(title) ?? []), row]);
    const topics = this.model.topics.map(rowOf);
    for (const row of topics) if (row.kind) add(row.kind, row);
    groups.set("Without a topic", WITHOUT_TOPIC.map(rowWithoutTopic));
    for (const row of topics) if (!row.kind) add(INSPECTED, row);
    return groups;
  }

  /** Groups the topics by the nodes that publish them, which only a live graph knows. */
  private byNode(): Map<string, Row[]> {
    const { nodes = [], topics: known = [], links = [] } = this.graph ?? {};
    const rows = new Map(this.model.topics.map((topic) => [topic.topic, rowOf(topic)]));
    const groups = new Map(format.sortNames(nodes.map(({ name }) => name)).map((name) => [name, [] as Row[]]));
    for (const { node, topic, publishes } of links) {
      const row = rows.get(known[topic]?.topic ?? "");
      const group = groups.get(nodes[node]?.name ?? "");
      if (publishes && row && group && !group.includes(row)) group.push(row);
    }
    const published = new Set([...groups.values()].flat());
    const others = [...rows.values()].filter((row) => !published.has(row));
    groups.set(nodes.length ? "Publisher unknown" : "Topics", others);
    return groups;
  }

  private isShown({ topic }: Row): boolean {
    return topic !== null && this.displays.list.some(({ config }) => config.topic === topic);
  }

  private row(row: Row, isShown: boolean): HTMLElement {
    const { kind, topic, type } = row;
    return h(
      "button",
      { type: "button", class: "add-row", data: { topic: topic ?? kind }, on: { click: () => this.choose(row) } },
      h("span", {}, shorten(topic ?? kind, 90)),
      h("small", {}, [kind || "Inspect", type, isShown ? "displayed" : ""].filter(Boolean).join(" · ")),
    );
  }

  private choose({ kind, topic }: Row): void {
    this.dialog.close();
    if (kind) this.displays.add(kind, topic);
    else if (topic !== null) this.model.emit("inspect", topic);
  }
}

function rowOf({ topic, type, display }: DisplayTopic): Row {
  return { kind: displayClass(display) ?? "", topic, type };
}

function rowWithoutTopic(kind: string): Row {
  return { kind, topic: null, type: "" };
}
