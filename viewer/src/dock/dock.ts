// SPDX-License-Identifier: Apache-2.0
/** The panels below or beside the scene. Those that are closed do nothing. */

import { h, iconButton } from "../util/dom";
import { storeValue, loadStored } from "../util/storage";

const PHONE = "(max-width: 760px)";
const MIN_SIZE_PX = 120;
const KEY_STEP_PX = 20;
/** The share of the window that the scene keeps. */
const SCENE_SHARE = 0.25;

export interface Pane {
  readonly id: string;
  readonly title: string;
  readonly body: HTMLElement;
  /** Controls in the head of the panel. */
  readonly controls: HTMLElement[];
  open(): void;
  close(): void;
}

export class Dock {
  private readonly sections = new Map<string, HTMLElement>();
  private readonly handle = h("div", {
    class: "dock-handle",
    role: "separator",
    tabindex: "0",
    aria: { label: "Size of the panels" },
  });
  private size = 0;

  constructor(
    private readonly root: HTMLElement,
    private readonly panes: readonly Pane[],
    private readonly onChange: (shown: string[]) => void,
  ) {
    for (const pane of panes) this.sections.set(pane.id, this.section(pane));
    root.append(this.handle, ...this.sections.values());
    this.setSide(loadStored("dock-side", false));
    this.listen();
  }

  isShown(id: string): boolean {
    return this.sections.get(id)?.hidden === false;
  }

  show(id: string, isShown: boolean): void {
    const pane = this.panes.find((one) => one.id === id);
    const section = this.sections.get(id);
    if (!pane || !section || isShown === this.isShown(id)) return;
    // There is room for one panel on a phone.
    if (isShown && matchMedia(PHONE).matches) for (const other of this.panes) this.show(other.id, false);
    section.hidden = !isShown;
    this.root.hidden = ![...this.sections.values()].some((one) => !one.hidden);
    if (isShown) pane.open();
    else pane.close();
    this.onChange(this.panes.map((one) => one.id).filter((one) => this.isShown(one)));
  }

  toggleSide(): void {
    this.setSide(!document.body.classList.contains("dock-side"));
  }

  /** Shows exactly these panels, at the place and with the size of the last session or of a saved view. */
  restore(wanted: readonly string[]): void {
    this.setSide(loadStored("dock-side", false));
    for (const { id } of this.panes) this.show(id, wanted.includes(id));
  }

  private setSide(side: boolean): void {
    document.body.classList.toggle("dock-side", side);
    storeValue("dock-side", side);
    this.handle.setAttribute("aria-orientation", side ? "vertical" : "horizontal");
    this.setSize(loadStored(side ? "dock-width" : "dock-height", side ? 460 : 300));
  }

  private section(pane: Pane): HTMLElement {
    const head = h(
      "header",
      { class: "pane-head" },
      h("h2", { id: `pane-title-${pane.id}` }, pane.title),
      h("div", { class: "pane-controls" }, ...pane.controls),
      iconButton("close", `Close: ${pane.title}`, () => this.show(pane.id, false)),
    );
    return h(
      "section",
      { class: "pane", id: `pane-${pane.id}`, hidden: true, aria: { labelledby: `pane-title-${pane.id}` } },
      head,
      pane.body,
    );
  }

  private setSize(size: number): void {
    const side = document.body.classList.contains("dock-side");
    const most = (1 - SCENE_SHARE) * (side ? innerWidth : innerHeight);
    this.size = Math.max(MIN_SIZE_PX, Math.min(most, size));
    this.handle.setAttribute("aria-valuenow", String(Math.round(this.size)));
    document.documentElement.style.setProperty(side ? "--dock-width" : "--dock-height", `${this.size}px`);
  }

  private listen(): void {
    const { handle } = this;
    const sizeAt = (event: PointerEvent): number => {
      const bounds = this.root.getBoundingClientRect();
      return document.body.classList.contains("dock-side")
        ? bounds.right - event.clientX
        : bounds.bottom - event.clientY;
    };
    handle.addEventListener("keydown", (event) => {
      const side = document.body.classList.contains("dock-side");
      const [larger, smaller] = side ? ["ArrowLeft", "ArrowRight"] : ["ArrowUp", "ArrowDown"];
      const step = event.key === larger ? KEY_STEP_PX : event.key === smaller ? -KEY_STEP_PX : 0;
      if (!step) return;
      this.setSize(this.size + step);
      storeValue(side ? "dock-width" : "dock-height", this.size);
      event.preventDefault();
    });
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      const move = (at: PointerEvent): void => this.setSize(sizeAt(at));
      handle.addEventListener("pointermove", move);
      handle.addEventListener(
        "pointerup",
        (at) => {
          handle.removeEventListener("pointermove", move);
          const side = document.body.classList.contains("dock-side");
          storeValue(side ? "dock-width" : "dock-height", sizeAt(at));
        },
        { once: true },
      );
    });
  }
}
