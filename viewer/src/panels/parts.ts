// SPDX-License-Identifier: Apache-2.0
/** The selected parts of the scene with their values, and what can be done with them. */

import type { Model } from "../model/model";
import type { PickedGroup, PickedPart } from "../model/picked";
import type { PartDetails } from "../protocol/messages";
import { copyText, h, iconButton, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const MAX_VALUE = 300;

export class PartsPanel {
  private readonly title = h("h2");
  private readonly list = h("div", { class: "part-list" });
  private readonly details = h("div", { id: "part" });
  private chosenPart: PickedPart | null = null;
  private answer: PartDetails | null = null;

  /** In a replay, which is not `live`, no server has more values of a part. */
  constructor(
    private readonly root: HTMLElement,
    private readonly model: Model,
    private readonly view: View,
    private readonly live: boolean,
  ) {
    root.append(
      h(
        "div",
        { class: "inspector-head" },
        this.title,
        iconButton("close", "Close (Esc)", () => model.emit("parts", [])),
      ),
      this.list,
      this.details,
    );
    model.on("parts", (groups) => this.show(groups));
    model.on("picked", (answer) => this.receive(answer));
  }

  private show(groups: readonly PickedGroup[]): void {
    this.root.hidden = groups.length === 0;
    const all = groups.reduce((sum, { count }) => sum + count, 0);
    setText(this.title, all === 1 ? "Selection" : `Selection: ${format.count(all)}`);
    this.list.replaceChildren(...(all > 1 ? groups.map((group) => this.group(group)) : []));
    this.choose(groups[0]?.parts[0] ?? null);
  }

  private group({ display, count, parts }: PickedGroup): HTMLElement {
    const more = count > parts.length ? `, the first ${parts.length} are listed` : "";
    return h(
      "details",
      { class: "part-group" },
      h("summary", {}, `${shorten(display, 60)}: ${format.count(count)}${more}`),
      h("ul", { class: "list" }, ...parts.map((part) => h("li", {}, this.button(part)))),
    );
  }

  private button(part: PickedPart): HTMLElement {
    const text = `${shorten(part.title, 60)} · ${coordinates(part)}`;
    return h("button", { type: "button", class: "small", on: { click: () => this.choose(part) } }, text);
  }

  private choose(part: PickedPart | null): void {
    this.chosenPart = part;
    this.answer = null;
    if (part?.source && this.live) {
      this.model.send({ type: "pick", ...part.source });
    }
    this.fill();
  }

  private receive(answer: PartDetails): void {
    const source = this.chosenPart?.source;
    if (answer.id !== source?.id || answer.sequence !== source.sequence) return;
    this.answer = answer;
    this.fill();
  }

  private fill(): void {
    const { chosenPart: part, answer } = this;
    if (!part) {
      this.details.replaceChildren();
      return;
    }
    const stamp = part.stamp ?? answer?.stamp ?? null;
    const frame = part.frame ?? answer?.frame ?? "";
    const rows: (readonly [string, string])[] = [
      ["display", part.display],
      ["topic", part.topic ?? ""],
      ["type", answer?.message_type ?? ""],
      ["frame", frame],
      ["stamp", stamp === null ? "" : format.stamp(this.model.origin, stamp)],
      [`in ${this.model.fixed}`, coordinates(part)],
      ...part.rows,
      ...(answer?.fields ?? []).map(({ name, text }) => [name, text] as const),
    ];
    this.details.replaceChildren(
      h("h3", { class: "part-title" }, shorten(part.title, 100)),
      h(
        "dl",
        { class: "facts" },
        ...rows
          .filter(([, value]) => value)
          .map(([name, value]) =>
            h(
              "div",
              { data: { name } },
              h("dt", {}, shorten(name, 40)),
              h("dd", { class: "mono" }, shorten(value, MAX_VALUE)),
            ),
          ),
      ),
      h("div", { class: "buttons" }, ...this.actions(part, frame)),
    );
  }

  private actions(part: PickedPart, frame: string): HTMLElement[] {
    const button = (text: string, act: () => void, title = text): HTMLElement =>
      h("button", { type: "button", class: "small", title, on: { click: act } }, text);
    const { topic } = part;
    const curves = this.live ? (this.answer?.curves ?? []) : [];
    return [
      button("Look at it", () => this.view.lookAt(part.position)),
      button("Copy position", () => void copyText(part.position.map(format.formatPlain).join(" ")).then(confirm)),
      ...(topic && this.live ? [button("Inspect", () => this.model.emit("inspect", topic), `Inspect ${topic}`)] : []),
      ...(this.model.forest.index.has(frame) ? [button("Select frame", () => this.model.select(frame), frame)] : []),
      ...curves.map((curve) => button(`Plot ${shorten(curve, 48)}`, () => this.model.emit("plot", curve), curve)),
      ...(part.frame && this.live && part.frame !== this.model.fixed
        ? [button("Plot x", () => this.model.emit("plot", `${this.model.fixed}->${part.frame}.x`))]
        : []),
    ];
  }
}

function confirm(ok: boolean): void {
  toast(ok ? "Copied: position" : "The browser does not allow this page to use the clipboard.", null, "info");
}

function coordinates({ position }: PickedPart): string {
  return position.map((value) => format.formatFixed(value, 3)).join(", ");
}
