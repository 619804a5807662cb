// SPDX-License-Identifier: Apache-2.0
/** The numbers of the view as fields, and saved views, which can be shared as links. */

import type { Model } from "../model/model";
import type { JsonObject } from "../protocol/messages";
import type { View as CameraView } from "../scene/camera";
import { ANY_DIRECTION, DIRECTIONS } from "../scene/look_controls";
import type { View } from "../scene/view";
import { copyText, fillSelect, h, iconButton, shorten } from "../util/dom";
import { link, linked } from "../util/link";
import { loadList, storeValue } from "../util/storage";
import { toast } from "../util/toast";
import { currentLayout, storeLayout } from "./layout";

const UPDATE_MS = 250;
const MAX_VIEWS = 50;
const MAX_NAME = 80;
const DEGREES = 180 / Math.PI;
const ANGLES = new Set(["Pitch", "Yaw", "Roll", "Angle"]);
const LOCK = "Lock Camera";
const DIRECTION = "Point towards";
const START: CameraView = {
  class: "rviz_default_plugins/Orbit",
  options: { Distance: 5, "Focal Point": { X: 0, Y: 0, Z: 0 }, Pitch: 0.6, Yaw: 0.8 },
};

interface SavedView {
  name: string;
  view: CameraView;
  /** The panels; views of earlier versions do not contain them. */
  layout?: JsonObject;
}

export class ViewsPanel {
  private readonly element: HTMLElement;
  private readonly fields = h("div", { class: "view-fields" });
  private readonly list = h("ul", { class: "list", id: "saved-views" });
  private readonly name = h("input", { type: "text", placeholder: "Name", maxlength: String(MAX_NAME) });
  private readonly inputs = new Map<string, HTMLInputElement>();
  private readonly locked = h("input", { type: "checkbox", aria: { label: LOCK } });
  private readonly direction = h("select", { aria: { label: DIRECTION } });
  /** The options that only RViz's FrameAligned view has. */
  private readonly aligned = h(
    "div",
    { class: "view-fields", hidden: true },
    h("label", { class: "field" }, h("span", {}, DIRECTION), this.direction),
    h("label", { class: "field" }, h("span", {}, LOCK), this.locked),
  );
  private saved: SavedView[];
  private updated = 0;

  constructor(
    root: HTMLElement,
    model: Model,
    private readonly view: View,
    private readonly restoreLayout: () => void,
  ) {
    this.saved = loadList("views", isSavedView);
    this.name.setAttribute("aria-label", "Name of the view");
    const button = (text: string, act: () => void): HTMLElement =>
      h("button", { type: "button", class: "small", on: { click: act } }, text);
    this.element = h(
      "section",
      { class: "view-sheet", id: "views", hidden: true, aria: { label: "View" } },
      h(
        "div",
        { class: "inspector-head" },
        h("h2", {}, "View"),
        iconButton("close", "Close (w)", () => this.toggle()),
      ),
      this.fields,
      this.aligned,
      h(
        "div",
        { class: "buttons" },
        button("Zero", () => this.apply(START)),
        button("Copy link", () => void this.share()),
      ),
      h("h3", {}, "Saved views"),
      h(
        "form",
        {
          class: "toolbar",
          on: {
            submit: (event) => {
              event.preventDefault();
              this.save();
            },
          },
        },
        this.name,
        h("button", { type: "submit", class: "small" }, "Save"),
      ),
      this.list,
    );
    const directions = [ANY_DIRECTION, ...DIRECTIONS.keys()];
    fillSelect(
      this.direction,
      directions.map((name) => [name, name] as const),
      ANY_DIRECTION,
    );
    this.direction.addEventListener("change", () => this.look(this.direction.value));
    this.locked.addEventListener("change", () => this.change({ [LOCK]: this.locked.checked }));
    root.append(this.element);
    view.onDrawn(() => this.update());
    model.on("hello", () => this.openLinked());
    this.showList();
  }

  toggle(): void {
    this.element.hidden = !this.element.hidden;
    this.updated = 0;
    this.update();
  }

  /** Shows the view of the link with which the page was opened. */
  private openLinked(): void {
    this.openPart("view", (view) => isView(view) && this.apply(view));
    this.openPart("layout", (layout) => isObject(layout) && this.applyLayout(layout));
  }

  /** Removes a part from the address and applies it, which returns whether it is valid. */
  private openPart(key: "view" | "layout", apply: (value: unknown) => boolean): void {
    const [text] = linked(key);
    link(key, []);
    if (text === undefined) return;
    let isValid = false;
    try {
      isValid = apply(JSON.parse(text));
    } catch {
      // It is not JSON, or a camera with these numbers cannot exist.
    }
    if (!isValid)
      toast(`The ${key} in the address of the page is not valid.`, "Copy the link again in the other page.");
  }

  private open({ view, layout }: SavedView): void {
    this.apply(view);
    if (isObject(layout)) this.applyLayout(layout);
  }

  private applyLayout(layout: JsonObject): boolean {
    storeLayout(layout);
    link("panel", []); // The panels of the layout, not those of the address.
    this.restoreLayout();
    return true;
  }

  private get current(): CameraView {
    return this.view.savedView;
  }

  private apply(view: CameraView): boolean {
    return this.view.setView(view);
  }

  private update(): void {
    const now = performance.now();
    if (this.element.hidden || now - this.updated < UPDATE_MS) return;
    this.updated = now;
    const { options } = this.current;
    this.aligned.hidden = !(DIRECTION in options);
    this.locked.checked = options[LOCK] === true;
    if (this.direction !== document.activeElement) this.direction.value = String(options[DIRECTION]);
    const numbers = numbersOf(options);
    if ([...numbers.keys()].join() !== [...this.inputs.keys()].join()) this.makeFields([...numbers.keys()]);
    for (const [path, value] of numbers) {
      const input = this.inputs.get(path);
      const shown = String(Number((ANGLES.has(path) ? value * DEGREES : value).toFixed(3)));
      if (input && input !== document.activeElement && input.value !== shown) input.value = shown;
    }
  }

  private makeFields(paths: string[]): void {
    this.inputs.clear();
    const rows = paths.map((path) => {
      const label = ANGLES.has(path) ? `${path} (°)` : path.replace(/^(Focal Point|Position)\//, "");
      const input = h("input", { type: "number", step: "any", aria: { label } });
      input.addEventListener("change", () => this.set(path, input.valueAsNumber));
      this.inputs.set(path, input);
      return h("label", { class: "field" }, h("span", {}, label), input);
    });
    this.fields.replaceChildren(...rows);
  }

  private set(path: string, value: number): void {
    if (!Number.isFinite(value)) return;
    const changed = structuredClone(this.current.options);
    const [outer, inner] = path.split("/") as [string, string?];
    const number = ANGLES.has(path) ? value / DEGREES : value;
    if (inner === undefined) changed[outer] = number;
    else (changed[outer] as JsonObject)[inner] = number;
    this.change(changed);
  }

  private change(changed: JsonObject): void {
    const { class: kind, options } = this.current;
    this.apply({ class: kind, options: { ...options, ...changed } });
  }

  /** Looks along an axis of the frame, from its origin, as RViz does. */
  private look(direction: string): void {
    const { class: kind, options } = this.current;
    if (!DIRECTIONS.has(direction)) return;
    const kept = { "Target Frame": options["Target Frame"] ?? "", [LOCK]: options[LOCK] ?? false };
    this.apply({ class: kind, options: { ...kept, [DIRECTION]: direction } });
  }

  private save(): void {
    const name = this.name.value.trim() || `View ${this.saved.length + 1}`;
    this.saved = [
      ...this.saved.filter((one) => one.name !== name),
      { name, view: this.current, layout: currentLayout() },
    ].slice(-MAX_VIEWS);
    this.name.value = "";
    this.store();
  }

  private store(): void {
    storeValue("views", this.saved);
    this.showList();
  }

  private showList(): void {
    this.list.replaceChildren(
      ...this.saved.map((one) =>
        h(
          "li",
          {},
          h(
            "button",
            { type: "button", class: "small", on: { click: () => this.open(one) } },
            shorten(one.name, MAX_NAME),
          ),
          iconButton("close", `Delete ${shorten(one.name, MAX_NAME)}`, () => {
            this.saved = this.saved.filter((other) => other !== one);
            this.store();
          }),
        ),
      ),
    );
  }

  private async share(): Promise<void> {
    link("view", [JSON.stringify(this.current)]);
    link("layout", [JSON.stringify(currentLayout())]);
    const address = location.href;
    link("view", []);
    link("layout", []);
    const ok = await copyText(address);
    toast(
      ok ? "Copied: a link to this view" : "The browser does not allow this page to use the clipboard.",
      null,
      "info",
    );
  }
}

/** The numbers of a view by their paths, such as "Focal Point/X". */
function numbersOf(options: JsonObject, prefix = ""): Map<string, number> {
  const found = new Map<string, number>();
  for (const [key, value] of Object.entries(options))
    if (typeof value === "number") found.set(prefix + key, value);
    else if (value && typeof value === "object" && !Array.isArray(value) && !prefix)
      for (const [path, number] of numbersOf(value, `${key}/`)) found.set(path, number);
  return found;
}

function isObject(value: unknown): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

function isView(value: unknown): value is CameraView {
  const view = value as Partial<CameraView> | null;
  return typeof view?.class === "string" && isObject(view.options);
}

function isSavedView(value: unknown): value is SavedView {
  const saved = value as Partial<SavedView> | null;
  return typeof saved?.name === "string" && isView(saved.view);
}
