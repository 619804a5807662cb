// SPDX-License-Identifier: Apache-2.0
/** The newest message of one topic, or the one at the displayed time, as a tree. */

import { CompletedInput, MAX_TEXT } from "../dock/completion";
import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import type { InspectedField, Inspection } from "../protocol/messages";
import { h, icon, iconButton, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { link, linked } from "../util/link";
import { storeValue, loadStored } from "../util/storage";
import { toast } from "../util/toast";
import { hasChildren, isOpen, keyOf, visibleRows } from "./rows";

const MAX_VALUE = 320;

interface Row {
  element: HTMLElement;
  value: HTMLElement;
}

export class MessagePane implements Pane {
  readonly id = "message";
  readonly title = "Message";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[] = [];
  private readonly topic: CompletedInput;
  private readonly facts = h("p", { class: "message-facts", id: "message-facts", role: "status" });
  private readonly tree = h("ul", { class: "fields", id: "fields", aria: { label: "Fields of the message" } });
  private readonly toggledFields = new Set<string>();
  private readonly rows = new Map<string, Row>();
  private inspection: Inspection | null = null;
  /** The rows that exist; they are made again only if this changes. */
  private shape = "";
  private wantedTopic: string;
  private isOpen = false;

  constructor(private readonly model: Model) {
    this.wantedTopic = (linked("topic")[0] ?? loadStored("inspected", "")).slice(0, MAX_TEXT);
    this.topic = new CompletedInput(model, "topic", "Topic to inspect", "/topic", (text) => this.inspect(text));
    this.topic.input.value = this.wantedTopic;
    this.body = h("div", { class: "message" }, this.topic.element, this.facts, this.tree);
    model.on("inspect", (topic) => this.inspect(topic));
    model.on("inspection", (inspection) => this.show(inspection));
    model.on("hello", () => this.request());
  }

  open(): void {
    this.isOpen = true;
    this.request();
    if (!this.wantedTopic) this.topic.input.focus();
  }

  close(): void {
    this.isOpen = false;
    this.model.send({ type: "inspect", topic: "" });
    this.clear();
  }

  private inspect(topic: string): void {
    if (topic.length > MAX_TEXT) {
      toast(`The name of this topic has more than ${MAX_TEXT} characters.`);
      return;
    }
    this.topic.input.value = this.wantedTopic = topic;
    storeValue("inspected", topic);
    link("topic", [topic]);
    this.request();
  }

  private request(): void {
    if (!this.isOpen) return;
    this.clear();
    this.model.send({ type: "inspect", topic: this.wantedTopic });
  }

  private clear(): void {
    this.inspection = null;
    this.shape = "";
    this.rows.clear();
    this.tree.replaceChildren();
    setText(this.facts, this.wantedTopic ? "" : "Choose a topic.");
  }

  private show(inspection: Inspection): void {
    if (!this.isOpen || inspection.topic !== this.wantedTopic) return;
    this.inspection = inspection;
    const { message_type: type, rate, stamp, publishers, text, state } = inspection;
    const facts = [
      type,
      format.rate(rate),
      stamp === null ? "" : format.stamp(this.model.origin, stamp),
      publishers.length ? `published by ${publishers.slice(0, 20).join(", ")}` : "",
      text,
    ];
    setText(this.facts, shorten(facts.filter(Boolean).join(" · "), 600));
    this.facts.dataset.state = state;
    this.refresh();
  }

  private refresh(): void {
    const fields = this.inspection?.fields ?? [];
    const visible = visibleRows(fields, this.toggledFields);
    const shape = visible.map((i) => `${keyOf(fields[i] as InspectedField, i)} ${hasChildren(fields, i)}`).join("\n");
    if (shape !== this.shape) {
      this.shape = shape;
      this.rows.clear();
      this.tree.replaceChildren(...visible.map((i) => this.row(fields, i)));
    }
    for (const i of visible) {
      const field = fields[i] as InspectedField;
      const row = this.rows.get(keyOf(field, i));
      if (row) setText(row.value, shorten(field.text, MAX_VALUE));
    }
  }

  private row(fields: readonly InspectedField[], i: number): HTMLElement {
    const field = fields[i] as InspectedField;
    const key = keyOf(field, i);
    const value = h("span", { class: "mono field-value" });
    const name = h("span", { class: "mono field-name" }, shorten(field.name, 80));
    const open = isOpen(field, key, this.toggledFields);
    const head = hasChildren(fields, i)
      ? h(
          "button",
          {
            type: "button",
            class: "field-head",
            aria: { expanded: String(open) },
            on: { click: () => this.toggle(key) },
          },
          icon("chevron"),
          name,
        )
      : h("span", { class: "field-head" }, name);
    const plot = field.is_number
      ? iconButton("plus", `Plot ${shorten(field.path, 120)}`, () => this.model.emit("plot", field.path), "field-plot")
      : null;
    const element = h(
      "li",
      { class: "field-row", title: field.type.slice(0, 100), data: { path: field.path.slice(0, 300) } },
      head,
      value,
      plot,
    );
    element.style.setProperty("--depth", String(Math.min(field.depth, 12)));
    this.rows.set(key, { element, value });
    return element;
  }

  private toggle(key: string): void {
    if (!this.toggledFields.delete(key)) this.toggledFields.add(key);
    this.refresh();
    this.rows.get(key)?.element.querySelector("button")?.focus();
  }
}
