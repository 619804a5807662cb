// SPDX-License-Identifier: Apache-2.0
/** The side panel: tabs, an adjustable width, can be hidden. On a phone it slides over the scene. */

import { h, iconButton } from "../util/dom";
import { storeValue, loadStored } from "../util/storage";

const MIN_WIDTH_PX = 260;
const MAX_WIDTH_PX = 640;
const KEY_STEP_PX = 20;
const PHONE = "(max-width: 760px)";

export interface Tab {
  id: string;
  title: string;
  body: HTMLElement;
}

export class Panel {
  private readonly buttons: HTMLButtonElement[];
  private readonly handle = h("div", {
    class: "panel-handle",
    role: "separator",
    tabindex: "0",
    aria: {
      label: "Width of the panel",
      orientation: "vertical",
      valuemin: String(MIN_WIDTH_PX),
      valuemax: String(MAX_WIDTH_PX),
    },
  });
  private width = 0;

  constructor(
    root: HTMLElement,
    private readonly tabs: Tab[],
  ) {
    this.buttons = tabs.map((tab, i) =>
      h(
        "button",
        {
          type: "button",
          role: "tab",
          id: `tab-${tab.id}`,
          aria: { controls: `body-${tab.id}` },
          on: { click: () => this.choose(tab.id), keydown: (event) => this.key(event, i) },
        },
        tab.title,
      ),
    );
    for (const tab of tabs) {
      tab.body.id = `body-${tab.id}`;
      tab.body.setAttribute("role", "tabpanel");
      tab.body.setAttribute("aria-labelledby", `tab-${tab.id}`);
    }
    root.append(
      h(
        "div",
        { class: "tabs", role: "tablist" },
        ...this.buttons,
        iconButton("close", "Close the panel", () => this.show(false), "narrow-only"),
      ),
      ...tabs.map((tab) => tab.body),
      this.handle,
    );
    this.listen();
    this.restore();
  }

  /** Shows the panel as in the last session or in a saved view. */
  restore(): void {
    this.setWidth(loadStored("panel-width", 340));
    this.show(!matchMedia(PHONE).matches && loadStored("panel-shown", true));
    this.choose(loadStored("tab", this.tabs[0]?.id ?? ""));
  }

  choose(id: string): void {
    const chosen = this.tabs.some((tab) => tab.id === id) ? id : this.tabs[0]?.id;
    this.tabs.forEach((tab, i) => {
      const selected = tab.id === chosen;
      tab.body.hidden = !selected;
      this.buttons[i]?.setAttribute("aria-selected", String(selected));
      if (this.buttons[i]) this.buttons[i].tabIndex = selected ? 0 : -1;
    });
    storeValue("tab", chosen);
  }

  /** Shows or hides a tab. Returns whether this has changed something. */
  setAvailable(id: string, available: boolean): boolean {
    const button = this.buttons[this.tabs.findIndex((tab) => tab.id === id)];
    if (!button || button.hidden === !available) return false;
    button.hidden = !available;
    if (!available && button.getAttribute("aria-selected") === "true") this.choose("");
    return true;
  }

  setTitle(id: string, title: string): void {
    const button = this.buttons[this.tabs.findIndex((tab) => tab.id === id)];
    if (button) button.textContent = title;
  }

  open(id: string): void {
    this.show(true);
    this.choose(id);
  }

  toggle(): void {
    this.show(document.body.classList.contains("no-panel"));
  }

  private show(isShown: boolean): void {
    document.body.classList.toggle("no-panel", !isShown);
    if (!matchMedia(PHONE).matches) storeValue("panel-shown", isShown);
  }

  private key(event: KeyboardEvent, i: number): void {
    const step = event.key === "ArrowRight" ? 1 : event.key === "ArrowLeft" ? -1 : 0;
    if (!step) return;
    const next = (i + step + this.tabs.length) % this.tabs.length;
    this.choose(this.tabs[next]?.id ?? "");
    this.buttons[next]?.focus();
    event.stopPropagation();
  }

  private setWidth(width: number): void {
    this.width = Math.max(MIN_WIDTH_PX, Math.min(MAX_WIDTH_PX, width));
    document.documentElement.style.setProperty("--panel-width", `${this.width}px`);
    this.handle.setAttribute("aria-valuenow", String(Math.round(this.width)));
  }

  private listen(): void {
    const { handle } = this;
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      const move = (at: PointerEvent): void => this.setWidth(at.clientX);
      handle.addEventListener("pointermove", move);
      handle.addEventListener(
        "pointerup",
        (at) => {
          handle.removeEventListener("pointermove", move);
          storeValue("panel-width", at.clientX);
        },
        { once: true },
      );
    });
    handle.addEventListener("keydown", (event) => {
      const step = event.key === "ArrowRight" ? KEY_STEP_PX : event.key === "ArrowLeft" ? -KEY_STEP_PX : 0;
      if (!step) return;
      this.setWidth(this.width + step);
      storeValue("panel-width", this.width);
      event.preventDefault();
    });
  }
}
