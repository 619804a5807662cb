// SPDX-License-Identifier: Apache-2.0
/** The messages on /rosout and those of the viewer, newest last. Only visible lines have elements. */

import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import type { LogEntry, LogLevel, ProblemReport } from "../protocol/messages";
import { fillSelect, h, select, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { storeValue, loadStored } from "../util/storage";
import { lastBefore, LEVELS, matchesFilter, type LogFilter } from "./filter";

/** As many as the server keeps of a recording. */
const MAX_ENTRIES = 20_000;
const MAX_NODES = 500;
const ROW_PX = 20;
const MAX_LINE = 400;

export class LogPane implements Pane {
  readonly id = "log";
  readonly title = "Log";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly list = h("div", {
    class: "log-list",
    id: "log-list",
    tabindex: "0",
    role: "log",
    aria: { live: "off" },
  });
  private readonly rowContainer = h("div", { class: "log-inner" });
  private readonly note = h("p", { class: "log-note", id: "log-note", role: "status" });
  private readonly nodes: HTMLSelectElement;
  private readonly nodeNames = new Set<string>();
  private readonly filter: LogFilter = { level: "info", node: "", text: "" };
  private entries: LogEntry[] = [];
  private shown: LogEntry[] = [];
  private omittedCount = 0;
  private text = "";
  private isOpen = false;
  /** Whether the list follows the newest message. */
  private isFollowing = true;
  private drawing = 0;
  private current = -1;

  constructor(private readonly model: Model) {
    this.filter.level = loadStored<LogLevel>("log-level", "info");
    if (!LEVELS.includes(this.filter.level)) this.filter.level = "info";
    const level = select(
      "Lowest level",
      LEVELS.map((one) => [one, one === "fatal" ? "fatal" : `${one} and above`] as const),
      this.filter.level,
      (value) => {
        storeValue("log-level", value);
        this.setFilter({ level: value as LogLevel });
      },
    );
    this.nodes = select("Node", [["", "all nodes"]], "", (node) => this.setFilter({ node }));
    const text = h("input", { type: "search", placeholder: "Filter", aria: { label: "Text in the log" } });
    text.addEventListener("input", () => this.setFilter({ text: text.value }));
    this.controls = [level, this.nodes, text];
    this.list.append(this.rowContainer);
    this.body = h("div", { class: "log" }, this.note, this.list);
    this.list.addEventListener("scroll", () => {
      const { scrollTop, clientHeight, scrollHeight } = this.list;
      this.isFollowing = scrollTop + clientHeight >= scrollHeight - ROW_PX;
      this.schedule();
    });
    new ResizeObserver(() => this.schedule()).observe(this.list);
    model.on("log", ({ reset, entries, omitted, text: why }) => {
      if (!this.isOpen) return;
      if (reset) this.clear();
      this.omittedCount += omitted;
      this.text = why;
      this.add(entries);
    });
    model.on("problem", (problem) => this.isOpen && this.add([this.entryOf(problem)]));
    model.on("hello", () => this.request());
    model.on("frames", () => this.followTime());
  }

  open(): void {
    this.isOpen = true;
    this.request();
  }

  close(): void {
    this.isOpen = false;
    this.model.send({ type: "log", shown: false });
    this.clear();
  }

  private request(): void {
    if (!this.isOpen || !this.model.hello) return;
    this.clear();
    this.model.send({ type: "log", shown: true });
    this.add(this.model.problems.map((problem) => this.entryOf(problem)));
  }

  private clear(): void {
    this.entries = [];
    this.shown = [];
    this.omittedCount = 0;
    this.text = "";
    this.nodeNames.clear();
    this.fillNodes();
    this.schedule();
  }

  private entryOf({ text, hint }: ProblemReport): LogEntry {
    const stamp = Number(BigInt(Date.now()) * 1_000_000n - this.model.origin);
    return { stamp, level: "warning", node: "coframe.viewer", text: `${text} ${hint}`.trim(), place: "" };
  }

  private add(entries: readonly LogEntry[]): void {
    for (const entry of entries) {
      this.entries.push(entry);
      if (matchesFilter(entry, this.filter)) this.shown.push(entry);
    }
    const extra = this.entries.length - MAX_ENTRIES;
    if (extra > 0) {
      this.entries.splice(0, extra);
      this.omittedCount += extra;
      this.shown = this.entries.filter((entry) => matchesFilter(entry, this.filter));
    }
    const before = this.nodeNames.size;
    for (const { node } of entries) if (this.nodeNames.size < MAX_NODES) this.nodeNames.add(node);
    if (this.nodeNames.size !== before) this.fillNodes();
    this.schedule();
  }

  private fillNodes(): void {
    const names = format.sortNames([...this.nodeNames]);
    fillSelect(this.nodes, [["", "all nodes"], ...names.map((name) => [name, name] as const)], this.filter.node);
    if (this.nodes.value !== this.filter.node) this.setFilter({ node: "" });
  }

  private setFilter(change: Partial<LogFilter>): void {
    Object.assign(this.filter, change);
    this.shown = this.entries.filter((entry) => matchesFilter(entry, this.filter));
    this.isFollowing = true;
    this.schedule();
  }

  /** In a recording, the list follows the playhead. */
  private followTime(): void {
    if (!this.isOpen || this.model.hello?.mode !== "recording") return;
    const current = lastBefore(this.shown, this.model.playhead);
    if (current === this.current) return;
    this.current = current;
    const top = Math.max(0, current) * ROW_PX;
    const { scrollTop, clientHeight } = this.list;
    if (top < scrollTop || top > scrollTop + clientHeight - ROW_PX) this.list.scrollTop = top - clientHeight / 2;
    this.schedule();
  }

  private schedule(): void {
    this.drawing ||= requestAnimationFrame(() => {
      this.drawing = 0;
      this.draw();
    });
  }

  private draw(): void {
    const { shown, list } = this;
    const omitted = this.omittedCount ? `${format.count(this.omittedCount)} older messages are not shown.` : "";
    const empty = shown.length ? "" : this.entries.length ? "No message passes the filters." : "No messages yet.";
    setText(this.note, [this.text || empty, omitted].filter(Boolean).join(" "));
    this.rowContainer.style.height = `${shown.length * ROW_PX}px`;
    const recorded = this.model.hello?.mode === "recording";
    if (this.isFollowing && !recorded) list.scrollTop = list.scrollHeight;
    const first = Math.max(0, Math.floor(list.scrollTop / ROW_PX) - 2);
    const last = Math.min(shown.length, Math.ceil((list.scrollTop + list.clientHeight) / ROW_PX) + 2);
    this.rowContainer.replaceChildren(...shown.slice(first, last).map((entry, i) => this.row(entry, first + i)));
  }

  private row(entry: LogEntry, i: number): HTMLElement {
    const line = entry.text.replace(/\s+/g, " ");
    const row = h(
      "button",
      {
        type: "button",
        class: "log-row",
        title: `${entry.text}\n${entry.place}`.trim().slice(0, 2000),
        tabindex: "-1",
        data: { level: entry.level, current: String(i === this.current) },
        on: { click: () => this.model.setClock({ live: false, playing: false }, entry.stamp) },
      },
      h("span", { class: "numbers" }, format.stamp(this.model.origin, entry.stamp)),
      h("span", { class: "log-level" }, entry.level),
      h("span", { class: "log-node" }, shorten(entry.node, 60)),
      h("span", { class: "log-text" }, shorten(line, MAX_LINE)),
    );
    row.style.top = `${i * ROW_PX}px`;
    return row;
  }
}
