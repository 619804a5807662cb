// SPDX-License-Identifier: Apache-2.0
/** The top bar: title, Fixed Frame, connection state and menus. */

import { fillSelect, h, iconButton, select, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import type { Model } from "../model/model";
import { storeValue, loadStored } from "../util/storage";

/** Seconds without data after which the page no longer says "Live". */
const MAX_SILENCE_S = 3;

type MenuItem = readonly [text: string, detail: string, act: () => void];

export interface BarActions {
  toggleTheme(): void;
  toggleDistinct(): void;
  help(): void;
  open(): void;
  togglePanel(): void;
  saveImage(): void;
  recordMovie(): void;
  saveReplay(): void;
  /** The panels beside the scene. */
  panes: readonly MenuItem[];
}

export class Bar {
  private readonly title = h("span", { class: "source-title" });
  private readonly state = h("span");
  private readonly pill = h("span", { class: "pill", role: "status", data: { state: "off" } });
  private readonly fixedFrameSelect: HTMLSelectElement;
  private shownNames = "";
  /** The Fixed Frame of the user's last session, until this frame exists. */
  private lastSessionFrame = "";
  /** The Fixed Frame that the user has chosen in this session. */
  private chosenFrame = "";

  constructor(
    root: HTMLElement,
    private readonly model: Model,
    actions: BarActions,
    live: boolean,
  ) {
    this.fixedFrameSelect = select("Fixed Frame", [], "", (frame) => {
      model.setFixed(frame);
      this.chosenFrame = frame;
      storeValue("fixed", frame);
    });
    this.fixedFrameSelect.id = "fixed";
    this.pill.append(h("span", { class: "dot" }), this.state);
    root.append(
      iconButton("menu", "Show or hide the panel (b)", actions.togglePanel),
      h("h1", { class: "brand" }, brandMark(), h("span", { class: "wide-only" }, "coframe")),
      this.title,
      h("span", { class: "spacer" }),
      h("label", {}, h("span", {}, "Fixed Frame"), this.fixedFrameSelect),
      this.pill,
      ...(live ? [iconButton("folder", "Open a file", actions.open)] : []),
      ...(actions.panes.length ? [menu("chart", "Panels", actions.panes)] : []),
      menu("download", "Export", [
        ["Image (PNG)", "The scene as it is displayed", actions.saveImage],
        ["Movie", "Record the scene, until you stop it. Key: Shift m", actions.recordMovie],
        ...(live
          ? ([["Replay (HTML)", "A single file that plays without a server", actions.saveReplay]] as const)
          : []),
      ]),
      menu("sun", "Appearance", [
        ["Dark or light theme", "Key: d", actions.toggleTheme],
        ["Color-blind safe palette", "On or off", actions.toggleDistinct],
      ]),
      iconButton("help", "Keyboard shortcuts (?)", actions.help, "wide-only"),
    );
    model.on("hello", (hello) => {
      const title = shorten(hello.title, 200);
      setText(this.title, title);
      document.title = title ? `${title} – coframe` : "coframe";
      this.lastSessionFrame = this.chosenFrame || (hello.fixed_is_given ? "" : loadStored("fixed", ""));
    });
    model.on("tree", () => this.rebuildOptions());
    model.on("fixed", () => this.rebuildOptions());
    for (const event of ["connected", "silent", "pulse", "clock", "hello"] as const)
      model.on(event, () => this.showState());
    this.showState();
    this.rebuildOptions();
  }

  private rebuildOptions(): void {
    const { forest, fixed } = this.model;
    if (this.lastSessionFrame && this.lastSessionFrame !== fixed && forest.index.has(this.lastSessionFrame)) {
      const frame = this.lastSessionFrame;
      this.lastSessionFrame = "";
      this.model.setFixed(frame);
      return;
    }
    const names = format.sortNames(forest.frames.map((frame) => frame.name));
    if (fixed && !forest.index.has(fixed)) names.unshift(fixed);
    const key = JSON.stringify(names);
    if (key !== this.shownNames) {
      this.shownNames = key;
      const options = names.map((name) => [name, name] as const);
      fillSelect(this.fixedFrameSelect, options.length ? options : [["", "No frames yet"]], fixed);
    }
    this.fixedFrameSelect.value = fixed;
  }

  private showState(): void {
    const [state, text] = connectionState(this.model);
    this.pill.dataset.state = state;
    setText(this.state, text);
  }
}

/** What the page shows of the connection and of the data; "Live" means that data arrives. */
function connectionState({ connected, silent, hello, clock, pulse }: Model): [state: string, text: string] {
  if (hello?.mode === "replay") return ["paused", "Replay"];
  if (!connected) return ["off", "Not connected"];
  if (silent) return ["off", "No response"];
  if (!clock.live) return ["paused", clock.playing ? "Playing" : "Paused"];
  if (hello?.mode === "recording") return ["live", "Recording"];
  if (pulse?.clock === "paused") return ["paused", "Simulation paused"];
  const silence = pulse?.silence ?? 0;
  return silence > MAX_SILENCE_S ? ["paused", `No data for ${format.duration(Math.round(silence))}`] : ["live", "Live"];
}

function menu(iconName: "chart" | "download" | "sun", label: string, items: readonly MenuItem[]): HTMLElement {
  const list = h("div", { class: "menu-list", role: "menu", hidden: true });
  const open = (shown: boolean): void => {
    list.hidden = !shown;
    button.setAttribute("aria-expanded", String(shown));
  };
  const button = iconButton(iconName, label, () => open(list.hidden === true));
  button.setAttribute("aria-haspopup", "menu");
  for (const [text, detail, act] of items)
    list.append(
      h(
        "button",
        {
          type: "button",
          role: "menuitem",
          on: {
            click: () => {
              open(false);
              act();
            },
          },
        },
        text,
        h("small", {}, detail),
      ),
    );
  const element = h("div", { class: "menu" }, button, list);
  document.addEventListener("pointerdown", (event) => {
    if (!element.contains(event.target as Node)) open(false);
  });
  element.addEventListener("keydown", (event) => {
    if (event.key === "Escape") open(false);
  });
  return element;
}

function brandMark(): SVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 20 20");
  svg.setAttribute("fill", "none");
  svg.setAttribute("stroke-width", "2.6");
  svg.setAttribute("stroke-linecap", "round");
  svg.setAttribute("aria-hidden", "true");
  for (const [d, color] of [
    ["M8 12V2.5", "#4a8df8"],
    ["M8 12l9.5 3", "#e5484d"],
    ["M8 12l-5 5.5", "#30a46c"],
  ] as const) {
    const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
    path.setAttribute("d", d);
    path.setAttribute("stroke", color);
    svg.append(path);
  }
  return svg;
}
