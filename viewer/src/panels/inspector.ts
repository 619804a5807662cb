// SPDX-License-Identifier: Apache-2.0
/** The inspector: the pose of the selected frame relative to another frame, their chain, or why there is no transform. */

import { copyText, fillSelect, h, iconButton, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import type { Model } from "../model/model";
import type { Relation } from "../protocol/messages";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const REQUEST_INTERVAL_MS = 200;
const RESPONSE_TIMEOUT_MS = 2000;
const MAX_TEXT = 1000;

export class Inspector {
  private readonly title = h("h2");
  private readonly reference = h("select", { aria: { label: "Relative to" } });
  private readonly distance = h("div", { class: "big numbers", id: "distance" });
  private readonly age = h("span", { class: "muted numbers" });
  private readonly results = h("div");
  private readonly problem = h("div", { class: "problem", role: "alert" });
  private readonly problemText = h("div");
  private readonly problemHint = h("p");
  private readonly chain = h("ol", { class: "chain", aria: { label: "Chain of frames" } });
  private readonly blocks: Record<"xyz" | "quaternion" | "rpy" | "matrix", HTMLElement[]>;
  private readonly command = h("pre", { class: "command" });
  private relation: Relation | null = null;
  private lastRequest = 0;
  private isWaiting = false;
  private requestId = 0;
  private chainText = "";
  private shownNames = "";

  constructor(
    private readonly root: HTMLElement,
    private readonly model: Model,
    view: View,
  ) {
    this.reference.addEventListener("change", () =>
      this.model.select(model.selection.frame, this.reference.value || null),
    );
    this.problem.append(this.problemText, this.problemHint);
    this.blocks = {
      xyz: this.block("Translation, m", ["x", "y", "z"], "", (r) => r.translation),
      quaternion: this.block("Quaternion", ["x", "y", "z", "w"], "", (r) => r.quaternion),
      rpy: this.block("Roll, pitch, yaw, degrees", ["r", "p", "y"], "", (r) => r.rpy_deg),
      matrix: this.block("Matrix", [], "matrix", (r) => r.matrix),
    };
    this.results.append(
      h(
        "div",
        { class: "block" },
        this.head("Command", () => this.relation?.static_command ?? ""),
        this.command,
      ),
    );
    root.append(
      h(
        "div",
        { class: "inspector-head" },
        this.title,
        iconButton("target", "Follow with the camera (f)", () =>
          view.setFollowed(view.followed === model.selection.frame ? null : model.selection.frame),
        ),
        iconButton("close", "Close (Esc)", () => model.select(null)),
      ),
      h("label", { class: "field" }, h("span", {}, "Relative to"), this.reference),
      h("div", { class: "field" }, h("span", {}, "Distance"), this.distance),
      h("div", { class: "field" }, h("span", {}, "Stamp"), this.age),
      this.problem,
      h("div", { class: "block" }, h("div", { class: "block-head" }, "Chain"), this.chain),
      this.results,
      h(
        "div",
        { class: "block buttons" },
        h("button", { type: "button", class: "small", on: { click: () => this.useAsFixed() } }, "Use as Fixed Frame"),
        h("button", { type: "button", class: "small", on: { click: () => this.swapFrames() } }, "Swap frames"),
      ),
    );
    model.on("selection", () => this.open());
    model.on("tree", () => this.fillReference());
    model.on("fixed", () => this.request(true));
    model.on("relation", (relation) => this.receive(relation));
    model.on("connected", () => (this.isWaiting = false));
    view.onDrawn((update) => {
      if (update) this.request(false);
    });
  }

  private get targetFrame(): string {
    return this.model.selection.reference ?? this.model.fixed;
  }

  private open(): void {
    const { frame } = this.model.selection;
    this.root.hidden = frame === null;
    if (frame === null) return;
    setText(this.title, shorten(frame, 100));
    this.title.title = frame.slice(0, 300);
    this.fillReference();
    this.request(true);
  }

  private fillReference(): void {
    const { forest, selection } = this.model;
    const names = format.sortNames(forest.frames.map((frame) => frame.name));
    const key = JSON.stringify(names);
    if (key !== this.shownNames) {
      this.shownNames = key;
      fillSelect(this.reference, [["", "Fixed Frame"], ...names.map((name) => [name, name] as const)], "");
    }
    this.reference.value = selection.reference ?? "";
  }

  /** Requests the relation of the two frames. At most one request is pending, so that a slow server is not overloaded. */
  private request(now: boolean): void {
    const { frame } = this.model.selection;
    const time = performance.now();
    if (
      frame === null ||
      (!now &&
        (this.isWaiting
          ? time - this.lastRequest < RESPONSE_TIMEOUT_MS
          : time - this.lastRequest < REQUEST_INTERVAL_MS))
    )
      return;
    this.lastRequest = time;
    this.isWaiting = true;
    this.model.send({ type: "relate", id: ++this.requestId, target: this.targetFrame, source: frame });
  }

  private receive(relation: Relation): void {
    if (relation.id === this.requestId) this.isWaiting = false;
    if (relation.source !== this.model.selection.frame || relation.target !== this.targetFrame) return;
    this.relation = relation;
    const t = relation.translation;
    setText(this.distance, t ? format.meters(Math.hypot(...t)) : "–");
    setText(this.age, relation.stamp === null ? "static" : format.stamp(this.model.origin, relation.stamp));
    this.problem.hidden = relation.ok;
    setText(this.problemText, relation.ok ? "" : shorten(relation.error ?? "No transform is available.", MAX_TEXT));
    setText(this.problemHint, shorten(relation.hint ?? "", MAX_TEXT));
    this.results.hidden = !relation.ok;
    this.fill("xyz", t, 4);
    this.fill("quaternion", relation.quaternion, 4);
    this.fill("rpy", relation.rpy_deg, 2);
    this.fill("matrix", relation.matrix, 3);
    setText(this.command, shorten(relation.static_command ?? "", MAX_TEXT));
    this.showChain(relation);
  }

  private fill(name: keyof Inspector["blocks"], values: number[] | null, digits: number): void {
    this.blocks[name].forEach((cell, i) => setText(cell, values ? format.formatFixed(values[i] ?? NaN, digits) : "–"));
  }

  private showChain(relation: Relation): void {
    const text = JSON.stringify([relation.chain, relation.broken_at]);
    if (text === this.chainText) return;
    this.chainText = text;
    this.chain.replaceChildren(
      ...relation.chain.slice(0, 500).map((name) => {
        const broken = name === relation.broken_at;
        const button = h(
          "button",
          { type: "button", title: name.slice(0, 300), on: { click: () => this.model.select(name) } },
          shorten(name, 60),
        );
        return h("li", { class: broken ? "broken" : "" }, button, broken ? " – the chain ends here" : null);
      }),
    );
  }

  private block(
    title: string,
    labels: string[],
    className: string,
    values: (relation: Relation) => number[] | null,
  ): HTMLElement[] {
    const cells = Array.from({ length: className === "matrix" ? 16 : labels.length }, () => h("span"));
    const row = h("div", { class: `values ${className}` });
    cells.forEach((cell, i) => {
      const value = h("b");
      value.style.fontWeight = "inherit";
      if (labels[i]) cell.append(h("i", {}, labels[i]));
      cell.append(value);
      row.append(cell);
    });
    const clipboardText = (): string => {
      const numbers = (this.relation && values(this.relation)) ?? [];
      return numbers.length === 16
        ? [0, 4, 8, 12]
            .map((at) =>
              numbers
                .slice(at, at + 4)
                .map(format.formatPlain)
                .join(" "),
            )
            .join("\n")
        : numbers.map(format.formatPlain).join(" ");
    };
    this.results.append(h("div", { class: "block" }, this.head(title, clipboardText), row));
    return cells.map((cell) => cell.lastElementChild as HTMLElement);
  }

  private head(title: string, text: () => string): HTMLElement {
    const button = iconButton("copy", `Copy: ${title}`, () => {
      copyText(text()).then(
        (ok) =>
          toast(
            ok ? `Copied: ${title.toLowerCase()}` : "The browser does not allow this page to use the clipboard.",
            null,
            "info",
          ),
        () => {},
      );
    });
    return h("div", { class: "block-head" }, h("span", {}, title), button);
  }

  private useAsFixed(): void {
    if (this.model.selection.frame) this.model.setFixed(this.model.selection.frame);
  }

  private swapFrames(): void {
    const { frame } = this.model.selection;
    if (frame) this.model.select(this.targetFrame, frame);
  }
}
