// SPDX-License-Identifier: Apache-2.0
/**
 * The Frames panel: a row per frame with a checkbox, the name, rate, age and publisher.
 *
 * Only visible rows have HTML elements, so that ten thousand frames cost no more than ten.
 */

import { severityIcon } from "./findings";
import { h, icon, iconButton, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import type { Model } from "../model/model";
import type { Severity } from "../protocol/messages";

const ROW_PX = 40;
const SPARE_ROWS = 4;

interface Row {
  frame: number;
  depth: number;
  hasChildren: boolean;
  /** The size of the tree, in the row of its root if there are several trees. */
  tree: string | null;
}

interface RowElements {
  element: HTMLElement;
  caret: HTMLButtonElement;
  box: HTMLInputElement;
  mark: HTMLElement;
  name: HTMLElement;
  tag: HTMLElement;
  rate: HTMLElement;
  publisher: HTMLElement;
  age: HTMLElement;
  solo: HTMLButtonElement;
  frame: number;
}

export class TreePanel {
  readonly element: HTMLElement;
  private readonly search: HTMLInputElement;
  private readonly list: HTMLElement;
  private readonly rowContainer: HTMLElement;
  private readonly emptyNote: HTMLElement;
  private readonly summary: HTMLElement;
  private readonly pool: RowElements[] = [];
  private readonly collapsedFrames = new Set<string>();
  private rows: Row[] = [];

  constructor(private readonly model: Model) {
    this.search = h("input", {
      type: "search",
      placeholder: "Search frames",
      aria: { label: "Search frames" },
      id: "search",
      on: { input: () => this.rebuild() },
    });
    this.rowContainer = h("div", { class: "tree-inner", role: "presentation" });
    this.list = h(
      "div",
      {
        class: "tree",
        role: "tree",
        tabindex: "0",
        aria: { label: "Frames" },
        on: { scroll: () => this.render(), keydown: (event) => this.key(event) },
      },
      this.rowContainer,
    );
    this.emptyNote = h("div", { class: "empty" });
    this.summary = h("span", { class: "muted numbers" });
    this.element = h(
      "section",
      { class: "tab-body tree-panel", aria: { label: "Frames" } },
      h(
        "div",
        { class: "toolbar" },
        this.search,
        h("button", { type: "button", class: "small", on: { click: () => this.showAll() } }, "Show all"),
        h("button", { type: "button", class: "small", on: { click: () => this.hideAll() } }, "Hide all"),
      ),
      this.list,
      this.emptyNote,
      h("div", { class: "tree-foot" }, this.summary, legend()),
    );
    model.on("tree", () => this.rebuild());
    model.on("stats", () => this.render());
    model.on("findings", () => this.render());
    model.on("selection", () => this.reveal());
    model.on("visibility", () => this.render());
    model.on("fixed", () => this.render());
    model.on("connected", () => this.rebuild());
    new ResizeObserver(() => this.render()).observe(this.list);
    this.rebuild();
  }

  focusSearch(): void {
    this.search.focus();
    this.search.select();
  }

  private showAll(): void {
    this.model.solo = null;
    this.model.setHidden([...this.model.hidden], false);
  }

  private hideAll(): void {
    this.model.setHidden(
      this.model.forest.frames.map((frame) => frame.name),
      true,
    );
  }

  private rebuild(): void {
    const { forest } = this.model;
    this.model.updateSolo();
    const text = this.search.value.trim().toLowerCase();
    const kept = text ? this.findMatches(text) : null;
    this.rows = [];
    const several = forest.roots.length > 1;
    const walk = (first: number): void => {
      const stack = [{ frame: first, depth: 0 }];
      while (stack.length) {
        const { frame, depth } = stack.pop() as { frame: number; depth: number };
        if (kept && !kept.has(frame)) continue;
        const children = forest.children[frame] ?? [];
        const size = forest.components[forest.frames[frame]?.component ?? 0]?.size;
        const tree = several && depth === 0 ? `separate tree${size ? ` · ${size} frames` : ""}` : null;
        this.rows.push({ frame, depth, hasChildren: children.length > 0, tree });
        if (this.collapsedFrames.has(forest.name(frame)) && !kept) continue;
        for (let k = children.length - 1; k >= 0; k--) stack.push({ frame: children[k] as number, depth: depth + 1 });
      }
    };
    forest.roots.forEach(walk);
    this.rowContainer.style.height = `${this.rows.length * ROW_PX}px`;
    this.summarize(several);
    this.updateEmpty(text);
    this.render();
  }

  /** The frames whose names contain a text, with their ancestors. */
  private findMatches(text: string): Set<number> {
    const { forest } = this.model;
    const kept = new Set<number>();
    forest.frames.forEach((frame, i) => {
      if (!frame.name.toLowerCase().includes(text)) return;
      kept.add(i);
      for (const ancestor of forest.ancestors(i)) kept.add(ancestor);
    });
    return kept;
  }

  private summarize(severalTrees: boolean): void {
    const { frames, roots } = this.model.forest;
    const trees = severalTrees ? ` in ${roots.length} trees` : "";
    setText(this.summary, frames.length ? `${format.count(frames.length)} frames${trees}` : "");
  }

  private updateEmpty(text: string): void {
    this.emptyNote.hidden = this.rows.length > 0;
    this.list.hidden = this.rows.length === 0;
    if (!this.model.connected && !this.model.hello) this.emptyNote.replaceChildren("Connecting…");
    else if (text && this.model.forest.frames.length)
      this.emptyNote.replaceChildren(`No frame name contains “${text}”.`);
    else
      this.emptyNote.replaceChildren(
        h("strong", {}, "No transforms yet"),
        h("p", {}, "No messages received on /tf or /tf_static. In another terminal, run"),
        h("code", {}, "coframe demo"),
        h("p", {}, "or start your own broadcasters with the same ROS_DOMAIN_ID."),
      );
  }

  private render(): void {
    const first = Math.max(0, Math.floor(this.list.scrollTop / ROW_PX) - SPARE_ROWS);
    const fits = Math.ceil((this.list.clientHeight || 400) / ROW_PX) + 2 * SPARE_ROWS;
    const shown = this.rows.slice(first, first + fits);
    while (this.pool.length < shown.length) this.pool.push(this.makeRow());
    this.pool.forEach((row, k) => {
      const data = shown[k];
      row.element.hidden = !data;
      if (data) this.fill(row, data, first + k);
    });
  }

  private makeRow(): RowElements {
    const row = {} as RowElements;
    row.frame = -1;
    row.caret = h(
      "button",
      {
        type: "button",
        class: "caret",
        tabindex: "-1",
        on: { click: (event) => this.toggleCollapsed(event, row.frame) },
      },
      icon("chevron"),
    );
    row.box = h("input", {
      type: "checkbox",
      tabindex: "-1",
      on: {
        click: (event) => event.stopPropagation(),
        change: () => this.model.setHidden([this.model.forest.name(row.frame)], !row.box.checked),
      },
    });
    row.mark = h("span", { class: "mark", hidden: true });
    row.name = h("span", { class: "name" });
    row.tag = h("span", { class: "tag" });
    row.rate = h("span", { class: "rate numbers" });
    row.publisher = h("span", { class: "publisher" });
    row.age = h("span", { class: "age numbers" });
    row.solo = iconButton("eye", "Show only this frame and its children", () => this.toggleSolo(row.frame), "solo");
    row.solo.tabIndex = -1;
    row.element = h(
      "div",
      { class: "row", role: "treeitem", on: { click: (event) => this.choose(event, row.frame) } },
      row.caret,
      row.box,
      h("span", { class: "dot", aria: { hidden: "true" } }),
      row.mark,
      h("div", { class: "cells" }, row.name, row.tag, row.rate, row.publisher, row.age),
      row.solo,
    );
    this.rowContainer.append(row.element);
    return row;
  }

  private fill(row: RowElements, data: Row, index: number): void {
    const { forest, model } = { forest: this.model.forest, model: this.model };
    const name = forest.name(data.frame);
    const stats = model.stats?.revision === forest.revision ? model.stats.frames[data.frame] : undefined;
    const isStatic = forest.frames[data.frame]?.static ?? false;
    const isRoot = (forest.frames[data.frame]?.parent ?? -1) < 0;
    const state = isRoot ? "root" : isStatic ? "static" : (stats?.state ?? "fresh");
    row.frame = data.frame;
    row.element.style.transform = `translateY(${index * ROW_PX}px)`;
    row.element.style.setProperty("--depth", String(Math.min(data.depth, 12)));
    row.element.dataset.state = state;
    row.element.dataset.frame = name.slice(0, 200);
    row.element.classList.toggle("fixed", name === model.fixed);
    row.element.classList.toggle("dimmed", !model.isShown(name));
    row.element.setAttribute("aria-level", String(data.depth + 1));
    row.element.setAttribute("aria-selected", String(name === model.selection.frame));
    if (data.hasChildren) row.element.setAttribute("aria-expanded", String(!this.collapsedFrames.has(name)));
    else row.element.removeAttribute("aria-expanded");
    const mark = model.marks.get(name);
    setMark(row.mark, mark?.severity);
    const described = describe(
      name,
      state,
      stats?.publisher ?? null,
      stats?.samples ?? null,
      stats?.longest_gap ?? null,
    );
    row.element.title = [described, ...(mark?.lines ?? [])].join("\n");
    row.caret.hidden = !data.hasChildren;
    row.caret.setAttribute(
      "aria-label",
      `${this.collapsedFrames.has(name) ? "Expand" : "Collapse"} ${name.slice(0, 60)}`,
    );
    row.box.checked = model.isShown(name);
    row.box.setAttribute("aria-label", `Show ${name.slice(0, 60)}`);
    row.solo.classList.toggle("on", model.solo === name);
    setText(row.name, shorten(name, 200));
    setText(row.tag, [name === model.fixed ? "fixed" : "", data.tree ?? ""].filter(Boolean).join(" · "));
    setText(row.rate, isRoot ? "" : isStatic ? "static" : format.rate(stats?.rate ?? null));
    setText(row.publisher, isRoot ? "root" : shorten(stats?.publisher ?? "", 100));
    setText(row.age, isStatic || isRoot ? "" : ageText(state, stats?.age ?? null));
  }

  private toggleCollapsed(event: Event, frame: number): void {
    event.stopPropagation();
    const name = this.model.forest.name(frame);
    if (!this.collapsedFrames.delete(name)) this.collapsedFrames.add(name);
    this.rebuild();
  }

  private toggleSolo(frame: number): void {
    const name = this.model.forest.name(frame);
    this.model.setSolo(this.model.solo === name ? null : name);
  }

  private choose(event: MouseEvent, frame: number): void {
    if ((event.target as Element).closest("button")) return;
    this.model.select(this.model.forest.name(frame));
  }

  private key(event: KeyboardEvent): void {
    const at = this.rows.findIndex((row) => this.model.forest.name(row.frame) === this.model.selection.frame);
    const row = this.rows[at];
    const name = row ? this.model.forest.name(row.frame) : "";
    const go = (to: number): void => {
      const next = this.rows[Math.max(0, Math.min(this.rows.length - 1, to))];
      if (next) this.model.select(this.model.forest.name(next.frame));
    };
    if (event.key === "ArrowDown") go(at + 1);
    else if (event.key === "ArrowUp") go(at - 1);
    else if (event.key === "Home") go(0);
    else if (event.key === "End") go(this.rows.length - 1);
    else if (event.key === " " && row) this.model.setHidden([name], this.model.isShown(name));
    else if (event.key === "ArrowLeft" && row?.hasChildren) this.collapsedFrames.add(name);
    else if (event.key === "ArrowRight" && row) this.collapsedFrames.delete(name);
    else return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key.startsWith("Arrow")) this.rebuild();
  }

  /** Scrolls to the selected frame if it is not visible. */
  private reveal(): void {
    const at = this.rows.findIndex((row) => this.model.forest.name(row.frame) === this.model.selection.frame);
    if (at >= 0) {
      const top = at * ROW_PX;
      const { scrollTop, clientHeight } = this.list;
      if (top < scrollTop) this.list.scrollTop = top;
      else if (top + ROW_PX > scrollTop + clientHeight) this.list.scrollTop = top + ROW_PX - clientHeight;
    }
    this.render();
  }
}

function setMark(element: HTMLElement, severity: Severity | undefined): void {
  if (element.dataset.severity === severity) return;
  element.hidden = !severity;
  if (severity) element.dataset.severity = severity;
  else delete element.dataset.severity;
  element.replaceChildren(...(severity ? [severityIcon(severity)] : []));
  element.setAttribute("aria-label", severity ?? "");
}

function ageText(state: string, age: number | null): string {
  if (state === "gone") return age === null ? "gone" : `gone ${format.duration(age)}`;
  return format.duration(age);
}

function describe(
  name: string,
  state: string,
  publisher: string | null,
  samples: number | null,
  gap: number | null,
): string {
  const lines = [name.slice(0, 300), `state: ${state}`];
  if (publisher) lines.push(`publisher: ${publisher}`);
  if (samples !== null) lines.push(`samples: ${samples}`);
  if (gap !== null) lines.push(`longest gap: ${format.duration(gap)}`);
  return lines.join("\n");
}

function legend(): HTMLElement {
  const states = [
    ["fresh", "moving"],
    ["static", "static"],
    ["stale", "stale"],
    ["gone", "gone"],
  ] as const;
  return h(
    "span",
    { class: "legend" },
    ...states.map(([state, text]) =>
      h("span", { data: { state } }, h("span", { class: "dot", aria: { hidden: "true" } }), text),
    ),
  );
}
