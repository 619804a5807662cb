// SPDX-License-Identifier: Apache-2.0
/** The last messages of a topic up to the displayed time, one row each, with the fields as columns. */

import { CompletedInput, MAX_TEXT } from "../dock/completion";
import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import type { TableColumn, TableRow, TopicTable } from "../protocol/messages";
import { download, h, select, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { storeValue, loadStored } from "../util/storage";

const COUNTS = ["20", "100", "500"] as const;
const MAX_CELL = 120;
const NUMBERS = /^(u?int\d+|float|double|octet|char|byte|float\d+|boolean|bool)$/;

export class TablePane implements Pane {
  readonly id = "table";
  readonly title = "Table";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly topic: CompletedInput;
  private readonly facts = h("p", { class: "message-facts", id: "table-facts", role: "status" });
  private readonly head = h("tr");
  private readonly lines = h("tbody", { id: "table-rows" });
  private readonly rows = new Map<number, { row: TableRow; element: HTMLElement }>();
  private columns: readonly TableColumn[] = [];
  private wanted = loadStored("table-topic", "").slice(0, MAX_TEXT);
  private count = loadStored("table-count", "100");
  private isOpen = false;

  constructor(private readonly model: Model) {
    this.topic = new CompletedInput(
      model,
      "topic",
      "Topic of the table",
      "/topic",
      (text) => this.show(text),
      "completion-table",
    );
    this.topic.input.value = this.wanted;
    if (!COUNTS.some((one) => one === this.count)) this.count = "100";
    const counts = COUNTS.map((one) => [one, `last ${one}`] as const);
    this.controls = [
      select("Number of messages", counts, this.count, (value) => {
        this.count = value;
        storeValue("table-count", value);
        this.request();
      }),
      h("button", { type: "button", class: "small", on: { click: () => this.save() } }, "CSV"),
    ];
    const table = h("table", { class: "topic-table" }, h("thead", {}, this.head), this.lines);
    const scroll = h(
      "div",
      { class: "table-scroll", tabindex: "0", role: "region", aria: { label: "Messages" } },
      table,
    );
    this.body = h("div", { class: "message" }, this.topic.element, this.facts, scroll);
    model.on("table", (table) => this.receive(table));
    model.on("hello", () => this.request());
  }

  open(): void {
    this.isOpen = true;
    this.request();
    if (!this.wanted) this.topic.input.focus();
  }

  close(): void {
    this.isOpen = false;
    this.model.send({ type: "table", topic: "" });
    this.clear();
  }

  private show(topic: string): void {
    this.wanted = topic;
    storeValue("table-topic", topic);
    this.request();
  }

  private request(): void {
    if (!this.isOpen) return;
    this.clear();
    this.model.send({ type: "table", topic: this.wanted, rows: Number(this.count) });
  }

  private clear(): void {
    this.rows.clear();
    this.columns = [];
    this.head.replaceChildren();
    this.lines.replaceChildren();
    setText(this.facts, this.wanted ? "" : "Choose a topic.");
  }

  private receive({ topic, message_type: type, state, text, columns, first, last, rows }: TopicTable): void {
    if (!this.isOpen || topic !== this.wanted) return;
    if (columns.length !== this.columns.length) this.setColumns(columns);
    for (const [key, { element }] of this.rows)
      if (key < first || key > last) {
        element.remove();
        this.rows.delete(key);
      }
    for (const row of rows) if (row.key >= first && row.key <= last && !this.rows.has(row.key)) this.insert(row);
    const { size } = this.rows;
    const count = size === 1 ? "1 message" : size > 1 ? `${size} messages` : "";
    setText(this.facts, shorten([type, count, text].filter(Boolean).join(" · "), 400));
    this.facts.dataset.state = state;
  }

  private setColumns(columns: readonly TableColumn[]): void {
    this.columns = columns;
    this.head.replaceChildren(h("th", {}, "time"), ...columns.map((column) => this.columnHead(column)));
  }

  private columnHead({ path, type }: TableColumn): HTMLElement {
    const name = shorten(path, 60);
    const plot = (): void => this.model.emit("plot", `${this.wanted}.${path}`);
    const content = NUMBERS.test(type)
      ? h("button", { type: "button", class: "link", title: `Plot ${name} (${type})`, on: { click: plot } }, name)
      : name;
    return h("th", { title: shorten(type, 100) }, content);
  }

  /** Inserts a row in the order of the messages, the newest first. */
  private insert(row: TableRow): void {
    const stamp = format.stamp(this.model.origin, row.stamp);
    const goTo = (): void => this.model.setClock({ live: false, playing: false }, row.stamp);
    const button = h(
      "button",
      { type: "button", class: "link numbers", title: "Go to this time", on: { click: goTo } },
      stamp,
    );
    const cells = row.problem ? [this.problemCell(row.problem)] : row.cells.map(valueCell);
    const element = h("tr", { data: { key: String(row.key) } }, h("td", {}, button), ...cells);
    const after = [...this.lines.children].find((other) => Number((other as HTMLElement).dataset.key) < row.key);
    this.lines.insertBefore(element, after ?? null);
    this.rows.set(row.key, { row, element });
  }

  private problemCell(problem: string): HTMLElement {
    const cell = h("td", { class: "unreadable" }, shorten(problem, 300));
    cell.colSpan = Math.max(1, this.columns.length);
    return cell;
  }

  private save(): void {
    const quoted = (text: string): string => `"${text.replaceAll('"', '""')}"`;
    const rows = [...this.rows.values()].map(({ row }) => row).sort((a, b) => a.key - b.key);
    const hasProblems = rows.some(({ problem }) => problem);
    const lines = [["stamp_ns", ...this.columns.map(({ path }) => path), ...(hasProblems ? ["problem"] : [])]];
    for (const row of rows) {
      const cells = this.columns.map((_, i) => row.cells[i] ?? ""); // Columns may have been added after the row.
      lines.push([
        String(this.model.origin + BigInt(Math.round(row.stamp))),
        ...cells,
        ...(hasProblems ? [row.problem] : []),
      ]);
    }
    const text = lines.map((line) => line.map(quoted).join(",")).join("\n");
    download("coframe-table.csv", new Blob([text, "\n"], { type: "text/csv" }));
  }
}

function valueCell(text: string): HTMLElement {
  return h("td", { title: text.length > MAX_CELL ? text : "" }, shorten(text, MAX_CELL));
}
