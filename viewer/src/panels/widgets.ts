// SPDX-License-Identifier: Apache-2.0
/** One widget that a program has added. All pages show the same value. */

import type { ClientMessage, Widget } from "../protocol/messages";
import { smallPlot } from "./small_plot";
import { fillSelect, h, setText, shorten } from "../util/dom";

type Send = (message: ClientMessage) => void;
type Value = Pick<ClientMessage & { type: "widget" }, "number" | "text" | "flag">;

const MAX_LABEL = 100;
const SEND_INTERVAL_MS = 40;
/** Values from the server are not shown this long after the user's last change, which may be newer. */
const HOLD_MS = 400;

/** The controls of a widget. */
interface Controls {
  elements: HTMLElement[];
  /** Shows a value. */
  show(widget: Widget): void;
}

export class WidgetRow {
  readonly element: HTMLElement;
  /** Where the widgets of a folder are; null for other widgets. */
  readonly content: HTMLElement | null = null;
  private readonly controls: Controls;
  private readonly label = h("span");
  private widget: Widget;
  private changeTime = -Infinity;
  private holdTimer = 0;
  private sendTimer = 0;
  private unsentValue: Value | null = null;

  constructor(
    widget: Widget,
    private readonly send: Send,
  ) {
    this.widget = widget;
    this.controls = this.makeControls(widget);
    const data = { widget: String(widget.id), kind: widget.kind, label: widget.label };
    if (widget.kind === "folder") {
      this.content = h("div", { class: "widgets" });
      this.element = h("details", { class: "folder", data }, h("summary", {}, this.label), this.content);
      (this.element as HTMLDetailsElement).open = widget.flag ?? true;
    } else if (widget.kind === "button") {
      this.element = h("div", { class: "widget", data }, ...this.controls.elements);
    } else {
      this.element = h("label", { class: `widget ${widget.kind}`, data }, this.label, ...this.controls.elements);
    }
  }

  set(widget: Widget): void {
    this.widget = widget;
    const label = shorten(widget.label, MAX_LABEL);
    setText(widget.kind === "button" ? (this.controls.elements[0] as HTMLElement) : this.label, label);
    this.element.title = widget.hint || widget.label;
    this.element.hidden = !widget.visible;
    for (const element of this.controls.elements) (element as HTMLInputElement).disabled = widget.disabled;
    this.showWhenIdle();
  }

  private showWhenIdle(): void {
    const wait = this.changeTime + HOLD_MS - performance.now();
    window.clearTimeout(this.holdTimer);
    if (wait > 0) this.holdTimer = window.setTimeout(() => this.showWhenIdle(), wait);
    else this.controls.show(this.widget);
  }

  /** Sends what the user did, at a limited rate. */
  private use(value: Value): void {
    this.changeTime = performance.now();
    this.unsentValue = value;
    this.sendTimer ||= window.setTimeout(() => {
      this.sendTimer = 0;
      if (this.unsentValue) this.send({ type: "widget", id: this.widget.id, ...this.unsentValue });
      this.unsentValue = null;
    }, SEND_INTERVAL_MS);
  }

  private makeControls(widget: Widget): Controls {
    switch (widget.kind) {
      case "button":
        return this.button();
      case "slider":
        return this.slider(widget);
      case "number":
        return this.number(widget);
      case "dropdown":
        return this.dropdown();
      case "text":
        return this.text();
      case "checkbox":
        return this.checkbox();
      case "image":
        return image();
      case "plot":
        return plot();
      case "folder":
        return { elements: [], show: () => {} };
    }
  }

  private button(): Controls {
    const press = (): void => this.send({ type: "widget", id: this.widget.id });
    return { elements: [h("button", { type: "button", on: { click: press } })], show: () => {} };
  }

  private slider(widget: Widget): Controls {
    const range = h("input", { type: "range", aria: { label: widget.label }, ...limits(widget) });
    const { element, show } = this.numberField(widget);
    range.addEventListener("input", () => {
      element.value = formatNumber(range.valueAsNumber);
      this.use({ number: range.valueAsNumber });
    });
    element.addEventListener("input", () => (range.value = element.value));
    return {
      elements: [element, range],
      show: (now) => {
        range.value = String(now.number);
        show(now);
      },
    };
  }

  private number(widget: Widget): Controls {
    const { element, show } = this.numberField(widget);
    return { elements: [element], show };
  }

  private numberField(widget: Widget): { element: HTMLInputElement; show: Controls["show"] } {
    const element = h("input", { type: "number", aria: { label: `${widget.label}, number` }, ...limits(widget) });
    element.addEventListener("change", () => {
      if (Number.isFinite(element.valueAsNumber)) this.use({ number: element.valueAsNumber });
      else this.controls.show(this.widget);
    });
    return { element, show: ({ number }) => setUnlessTyping(element, formatNumber(number ?? 0)) };
  }

  private dropdown(): Controls {
    const element = h("select");
    let options = "";
    element.addEventListener("change", () => this.use({ text: element.value }));
    return {
      elements: [element],
      show: (widget) => {
        const key = JSON.stringify(widget.options);
        if (key !== options)
          fillSelect(
            element,
            widget.options.map((option) => [option, option]),
            "",
          );
        options = key;
        element.value = widget.text ?? "";
      },
    };
  }

  private text(): Controls {
    const element = h("input", { type: "text", maxlength: "1000", autocomplete: "off" });
    element.addEventListener("change", () => this.use({ text: element.value }));
    return { elements: [element], show: ({ text }) => setUnlessTyping(element, text ?? "") };
  }

  private checkbox(): Controls {
    const element = h("input", { type: "checkbox" });
    element.addEventListener("change", () => this.use({ flag: element.checked }));
    return { elements: [element], show: ({ flag }) => (element.checked = flag ?? false) };
  }
}

function image(): Controls {
  const element = h("img", { class: "widget-image" });
  return {
    elements: [element],
    show: ({ content, label }) => {
      // Only images in the message itself, never from an address.
      if (content.startsWith("data:image/png;base64,") && element.src !== content) element.src = content;
      element.alt = label;
    },
  };
}

function plot(): Controls {
  const element = h("div", { class: "widget-plot" });
  let shown = "";
  return {
    elements: [element],
    show: ({ content }) => {
      if (content === shown) return;
      shown = content;
      element.replaceChildren(smallPlot(content));
    },
  };
}

/** Sets the value of a field, unless the user has begun to change it. */
function setUnlessTyping(element: HTMLInputElement, value: string): void {
  const typing = document.activeElement === element && element.value !== element.defaultValue;
  if (typing) return;
  element.value = value;
  element.defaultValue = value;
}

function limits({ lower, upper, step }: Widget): { min?: string; max?: string; step: string } {
  return {
    ...(lower === null ? {} : { min: String(lower) }),
    ...(upper === null ? {} : { max: String(upper) }),
    step: step === null ? "any" : String(step),
  };
}

/** A number without the digits that only binary fractions have. */
function formatNumber(value: number): string {
  return String(Number(value.toPrecision(12)));
}
