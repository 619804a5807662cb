// SPDX-License-Identifier: Apache-2.0
/** An input whose text the server completes, with the keyboard behavior of a combobox. */

import { h, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { CompletionKind } from "../protocol/messages";

/** The most characters of an expression, or of the name of a topic; those of the server. */
export const MAX_TEXT = 1000;

let lastId = 0;

export class CompletedInput {
  readonly element: HTMLElement;
  readonly input: HTMLInputElement;
  private readonly list: HTMLElement;
  private items: string[] = [];
  private chosenIndex = -1;
  private lastRequest = 0;
  /** The last request whose answer has arrived. */
  private answeredRequest = 0;
  /** Whether the user has pressed Enter before the answer. */
  private enters = false;

  /** `act` is called with the text when the user presses Enter or chooses a complete item. */
  constructor(
    private readonly model: Model,
    private readonly kind: CompletionKind,
    label: string,
    placeholder: string,
    private readonly act: (text: string) => void,
    id = `completion-${kind}`,
  ) {
    this.list = h("ul", { class: "completions", id, role: "listbox", hidden: true });
    this.input = h("input", {
      type: "text",
      placeholder,
      autocomplete: "off",
      maxlength: String(MAX_TEXT),
      role: "combobox",
      aria: { label, controls: id, expanded: "false", autocomplete: "list" },
    });
    this.input.spellcheck = false;
    this.element = h("div", { class: "completed-input" }, this.input, this.list);
    this.input.addEventListener("input", () => this.request());
    this.input.addEventListener("focus", () => this.request());
    this.input.addEventListener("blur", () => this.show([]));
    this.input.addEventListener("keydown", (event) => this.key(event));
    model.on("completions", ({ id, items }) => {
      if (id !== this.lastRequest || document.activeElement !== this.input) return;
      this.answeredRequest = id;
      this.show(items);
      if (this.enters) this.enter();
    });
  }

  private request(): void {
    this.lastRequest = ++lastId;
    this.enters = false;
    this.model.send({ type: "complete", id: this.lastRequest, subject: this.kind, text: this.input.value });
  }

  private show(items: string[]): void {
    this.items = items.length === 1 && items[0] === this.input.value ? [] : items;
    this.chosenIndex = -1;
    this.list.hidden = this.items.length === 0;
    this.input.setAttribute("aria-expanded", String(!this.list.hidden));
    this.input.removeAttribute("aria-activedescendant");
    this.list.replaceChildren(
      ...this.items.map((item, i) => {
        const option = h("li", { id: `${this.list.id}-${i}`, role: "option" }, shorten(item, 120));
        option.addEventListener("pointerdown", (event) => {
          event.preventDefault(); // The input keeps the focus.
          this.acceptItem(item);
        });
        return option;
      }),
    );
  }

  private key(event: KeyboardEvent): void {
    event.stopPropagation();
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      if (this.items.length) this.choose(this.chosenIndex + (event.key === "ArrowDown" ? 1 : -1));
    } else if (event.key === "Tab" && this.chosenIndex >= 0) {
      event.preventDefault();
      this.acceptItem(this.items[this.chosenIndex] ?? "");
    } else if (event.key === "Enter") {
      const item = this.items[this.chosenIndex];
      if (item !== undefined) this.acceptItem(item);
      else this.enter();
    } else if (event.key === "Escape") {
      if (this.list.hidden) this.input.blur();
      this.show([]);
    }
  }

  /** Uses the text, or the first suggestion if the text is only a part of one. Waits for suggestions on their way. */
  private enter(): void {
    const text = this.input.value.trim();
    this.enters = this.model.connected && this.answeredRequest !== this.lastRequest;
    if (this.enters) return;
    const first = this.items[0];
    if (text && first !== undefined && !this.items.includes(text)) this.acceptItem(first);
    else this.finish();
  }

  private choose(i: number): void {
    this.chosenIndex = (i + this.items.length) % this.items.length;
    [...this.list.children].forEach((option, k) =>
      option.setAttribute("aria-selected", String(k === this.chosenIndex)),
    );
    const option = this.list.children[this.chosenIndex];
    option?.scrollIntoView({ block: "nearest" });
    this.input.setAttribute("aria-activedescendant", option?.id ?? "");
  }

  /** Takes an item. One that ends with a separator is only the beginning of an expression. */
  private acceptItem(item: string): void {
    this.input.value = item;
    if (this.kind === "expression" && /[.:]$/.test(item)) this.request();
    else this.finish();
  }

  private finish(): void {
    const text = this.input.value.trim();
    this.lastRequest = 0;
    this.show([]);
    if (text) this.act(text);
  }
}
