// SPDX-License-Identifier: Apache-2.0
/** The Displays panel: the displays with their options, and a list of displays to add. */

import { MessageDisplay, type Display } from "../displays/display";
import type { Displays } from "../displays/manager";
import { MarkersDisplay } from "../displays/markers";
import { rvizColor } from "../displays/options";
import { DISPLAYS, type OptionSpec } from "../generated/displays";
import { AddDisplay } from "./add_display";
import { fillSelect, h, iconButton, select, setText, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { RvizGroup } from "../protocol/messages";

interface Card {
  display: Display;
  element: HTMLElement;
  head: HTMLElement;
  name: HTMLElement;
  box: HTMLInputElement;
  detail: HTMLElement;
  status: HTMLElement;
  body: HTMLElement | null;
  /** Hides the options that have no effect. */
  hideOptions: () => void;
}

const MAX_OMITTED = 40;
const NEW_GROUP = "new";

export class DisplaysPanel {
  readonly element: HTMLElement;
  private readonly cards = h("div");
  private readonly omitted = h("button", { type: "button", class: "small link", id: "omitted", hidden: true });
  private readonly groupBodies = new Map<RvizGroup, HTMLElement>();
  private readonly cardsById = new Map<number, Card>();

  constructor(
    private readonly model: Model,
    private readonly displays: Displays,
  ) {
    const dialog = new AddDisplay(model, displays);
    const add = (): void => dialog.show();
    this.omitted.addEventListener("click", add);
    this.element = h(
      "section",
      { class: "tab-body" },
      h(
        "div",
        { class: "toolbar" },
        h("button", { type: "button", id: "add-display", on: { click: add } }, "Add a display…"),
        this.omitted,
      ),
      this.cards,
    );
    displays.onChange(() => this.render());
    model.on("topics", () => this.showOmitted());
    setInterval(() => this.updateCards(), 500);
  }

  /** Says how many topics are not displayed. */
  private showOmitted(): void {
    const { omittedTopics: omitted } = this.displays;
    this.omitted.hidden = omitted.length === 0;
    const topics = omitted.length === 1 ? "1 topic is" : `${omitted.length} topics are`;
    setText(this.omitted, `${topics} not displayed`);
    this.omitted.title = omitted
      .slice(0, MAX_OMITTED)
      .map(({ topic }) => shorten(topic, 80))
      .join("\n");
  }

  private render(): void {
    const current = new Set(this.displays.list.map((display) => display.id));
    // A display that was made again, for example by undoing a change, keeps its open options.
    const open = new Set<string>();
    for (const [id, card] of this.cardsById)
      if (!current.has(id)) {
        if (card.body) open.add(card.display.config.name);
        card.element.remove();
        this.cardsById.delete(id);
      }
    const placed = new Map<HTMLElement, number>();
    for (const display of this.displays.list) {
      const card = this.cardsById.get(display.id) ?? this.makeCard(display, open.has(display.config.name));
      this.place(card.element, display.config.group, placed);
    }
    for (const [group, body] of this.groupBodies)
      if (!this.displays.groups.includes(group)) {
        body.parentElement?.remove();
        this.groupBodies.delete(group);
      }
    this.updateCards();
    this.showOmitted();
  }

  /** Places a card in the order of the list, below the head of its group, which appears with its first display. */
  private place(card: HTMLElement, source: string | undefined, placedCounts: Map<HTMLElement, number>): void {
    const group = source ? this.displays.groups.find((other) => other.source === source) : undefined;
    const body = group ? this.groupBody(group) : this.cards;
    if (group && !placedCounts.has(body)) this.place(body.parentElement as HTMLElement, group.group, placedCounts);
    const at = placedCounts.get(body) ?? 0;
    const there = body.children[at] ?? null;
    if (there !== card) body.insertBefore(card, there);
    placedCounts.set(body, at + 1);
  }

  /** The element that contains the cards of a group, which is made when it is first used. */
  private groupBody(group: RvizGroup): HTMLElement {
    const known = this.groupBodies.get(group);
    if (known) return known;
    const box = h("input", {
      type: "checkbox",
      aria: { label: `Show the group ${group.name}` },
      on: { change: () => this.displays.setGroupEnabled(group, box.checked) },
    });
    box.checked = group.enabled;
    const body = h("div", { class: "group-body" });
    const name = h("input", { type: "text", aria: { label: "Name of the group" }, maxlength: "100" });
    name.value = group.name;
    name.addEventListener("change", () => {
      this.displays.renameGroup(group, name.value);
      name.value = group.name;
    });
    h(
      "div",
      { class: "display-group", data: { group: group.name } },
      h("div", { class: "group-head" }, box, name),
      body,
    );
    this.groupBodies.set(group, body);
    return body;
  }

  private makeCard(display: Display, isOpen: boolean): Card {
    const { config } = display;
    const name = h("span");
    const box = h("input", {
      type: "checkbox",
      aria: { label: `Show ${config.name}` },
      on: { change: () => this.displays.setEnabled(display, box.checked) },
    });
    const detail = h("small");
    const title = h(
      "button",
      {
        type: "button",
        class: "card-title",
        aria: { expanded: "false" },
        on: { click: () => this.toggleOptions(card, title) },
      },
      name,
      h("span", {}, detail),
    );
    const head = h(
      "div",
      { class: "card-head" },
      box,
      title,
      iconButton("close", `Remove ${config.name}`, () => this.displays.remove(display)),
    );
    const status = h("div", { class: "status", role: "status", hidden: true });
    const element = h("div", { class: "card", data: { display: config.name } }, head, status);
    const card: Card = { display, element, head, name, box, detail, status, body: null, hideOptions: () => {} };
    this.cardsById.set(display.id, card);
    if (isOpen) this.toggleOptions(card, title);
    return card;
  }

  private toggleOptions(card: Card, title: HTMLElement): void {
    if (card.body) {
      card.body.remove();
      card.body = null;
    } else {
      card.body = this.options(card);
      card.element.append(card.body);
    }
    title.setAttribute("aria-expanded", String(card.body !== null));
  }

  private updateCards(): void {
    for (const card of this.cardsById.values()) {
      const { display, element, name, box, head, detail, status } = card;
      if (card.body) card.hideOptions();
      setText(name, shorten(display.config.name, 60));
      element.dataset.display = display.config.name;
      element.classList.toggle("in-disabled-group", !this.displays.groupsEnabled(display.config.group));
      box.setAttribute("aria-label", `Show ${display.config.name}`);
      box.checked = display.config.checked ?? display.config.enabled;
      const { state, text } = display.config.enabled ? display.status : { state: "ok", text: "" };
      if (head.dataset.state !== state) head.dataset.state = state;
      const { kind } = display;
      const what = display.config.topic ?? (kind === display.config.name ? "" : kind);
      const label = state === "error" ? "Status: Error" : state === "waiting" ? "Status: Warn" : "";
      const facts = [label, what, display.note, display.omitted].filter(Boolean).join(" · ");
      setText(detail, shorten(facts || kind, 300));
      status.hidden = state === "ok" || !text;
      setText(status, shorten(text, 1000));
    }
  }

  private options(card: Card): HTMLElement {
    const { display } = card;
    const body = h("div", { class: "card-body" }, this.ownFields(display));
    if (display instanceof MessageDisplay) body.append(this.topicField(display));
    const specs: readonly OptionSpec[] = DISPLAYS[card.display.kind].options;
    const fields = specs.map((spec) => ({ spec, element: this.field(display, spec) }));
    card.hideOptions = (): void => {
      // Only publishers have a quality of service.
      const live = this.model.hello?.mode === "live";
      for (const { spec, element } of fields)
        element.hidden = !display.options.hasEffect(spec) || (!live && isQuality(spec));
    };
    card.hideOptions();
    body.append(...fields.map(({ element }) => element));
    body.addEventListener("change", card.hideOptions);
    if (display instanceof MarkersDisplay) body.append(this.namespaces(display));
    return body;
  }

  /** The name and the place of a display. */
  private ownFields(display: Display): HTMLElement {
    const input = h("input", { type: "text", aria: { label: "Name" }, maxlength: "100" });
    input.value = display.config.name;
    input.addEventListener("change", () => {
      this.displays.rename(display, input.value);
      input.value = display.config.name;
    });
    const button = (text: string, title: string, act: () => void): HTMLElement =>
      h("button", { type: "button", class: "small", title, on: { click: act } }, text);
    return h(
      "div",
      {},
      field("Name", input),
      field("Group", this.groupField(display)),
      h(
        "div",
        { class: "buttons" },
        button("Duplicate", "Add a display with the same topic and options", () => this.displays.duplicate(display)),
        button("Up", "Move up in the list", () => this.displays.move(display, -1)),
        button("Down", "Move down in the list", () => this.displays.move(display, 1)),
      ),
    );
  }

  /** The groups that the display can be in. They are listed again when the list opens, because others can be added. */
  private groupField(display: Display): HTMLElement {
    const choices = (): [string, string][] => [
      ["", "None"],
      ...this.displays.groups.map(({ source, name }): [string, string] => [source, name]),
      [NEW_GROUP, "New group…"],
    ];
    const list = select("Group", choices(), display.config.group ?? "", (value) => {
      this.displays.setGroup(display, value === NEW_GROUP ? null : value);
      fillSelect(list, choices(), display.config.group ?? "");
    });
    list.addEventListener("focus", () => fillSelect(list, choices(), display.config.group ?? ""));
    return list;
  }

  /** A checkbox for each namespace; new namespaces are added when they are received. */
  private namespaces(display: MarkersDisplay): HTMLElement {
    const list = h("fieldset", { class: "namespaces" }, h("legend", {}, "Namespaces"));
    const known = new Set<string>();
    const render = (): void => {
      for (const name of [...display.namespaces].sort()) {
        if (known.has(name)) continue;
        known.add(name);
        const box = h("input", { type: "checkbox" });
        box.checked = display.isShown(name);
        box.addEventListener("change", () => {
          display.show(name, box.checked);
          this.displays.optionChanged(display);
        });
        list.append(h("label", {}, box, h("span", {}, shorten(name, 60) || "(empty)")));
      }
      list.hidden = known.size === 0;
    };
    render();
    display.onNamespace = render;
    return list;
  }

  /** The topics that the display can show. They are listed again when the list opens, because others may appear. */
  private topicField(display: Display): HTMLElement {
    const types: readonly string[] = DISPLAYS[display.kind].types;
    const element = h("select", { aria: { label: "Topic" } });
    const fill = (): void => {
      const available = this.model.topics.filter(({ type }) => types.includes(type)).map(({ topic }) => topic);
      const current = display.config.topic ?? "";
      const names = [...new Set([current, ...available])];
      fillSelect(
        element,
        names.map((name) => [name, name || "Choose a topic…"] as const),
        current,
      );
    };
    fill();
    element.addEventListener("focus", fill);
    element.addEventListener("change", () => {
      this.displays.setEnabled(display, false);
      display.config.topic = element.value || null;
      this.displays.setEnabled(display, true);
    });
    return field("Topic", element);
  }

  private field(display: Display, spec: OptionSpec): HTMLElement {
    const label = spec.label ?? spec.key;
    const change = (value: string | number | boolean): void => {
      display.options.set(spec.key, value);
      this.displays.optionChanged(display);
    };
    const { options } = display;
    switch (spec.kind) {
      case "flag": {
        const box = h("input", { type: "checkbox", aria: { label } });
        box.checked = options.flagOf(spec);
        box.addEventListener("change", () => change(box.checked));
        return field(label, box);
      }
      case "number": {
        const input = h("input", {
          type: "number",
          aria: { label },
          step: String(spec.step),
          min: String(spec.min),
          max: String(spec.max),
        });
        input.value = String(options.numberOf(spec));
        input.addEventListener("change", () => {
          if (Number.isFinite(input.valueAsNumber)) change(input.valueAsNumber);
        });
        return field(spec.unit ? `${label} (${spec.unit})` : label, input);
      }
      case "color": {
        const input = h("input", { type: "color", aria: { label } });
        input.value = options.colorOf(spec) || "#808890";
        input.addEventListener("input", () => change(rvizColor(input.value)));
        return field(label, input);
      }
      case "choice": {
        const input = h("select", { aria: { label } });
        fillSelect(
          input,
          spec.choices.map((choice) => [choice, choice] as const),
          options.choiceOf(spec),
        );
        input.addEventListener("change", () => change(input.value));
        return field(label, input);
      }
      case "text": {
        const input = h("input", { type: "text", aria: { label }, placeholder: spec.value });
        input.value = options.textOf(spec);
        input.addEventListener("change", () => change(input.value.trim() || spec.value));
        return field(label, input);
      }
    }
  }
}

function isQuality({ sets }: OptionSpec): boolean {
  return sets === "reliability" || sets === "durability" || sets === "depth";
}

function field(label: string, control: HTMLElement): HTMLElement {
  return h("label", { class: "field" }, h("span", {}, label), control);
}
