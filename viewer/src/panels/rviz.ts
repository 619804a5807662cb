// SPDX-License-Identifier: Apache-2.0
/** The panel for .rviz files: opens and saves them, and lists their unsupported parts. */

import type { Displays } from "../displays/manager";
import { cssColor } from "../displays/options";
import { download, h, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { ToolSettings } from "../model/tools";
import type { JsonObject, RvizConfiguration, RvizView } from "../protocol/messages";
import type { Theme } from "../util/theme";
import { storeValue, loadStored } from "../util/storage";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

/** How many parts of a file are listed. */
const MAX_LISTED = 500;
const MAX_FILE_SIZE = 900_000; // bytes

export class RvizPanel {
  readonly element: HTMLElement;
  private readonly unknownList = h("ul", { class: "list", id: "unknown" });
  private readonly unknownSection: HTMLElement;
  private readonly views = h("div", { class: "buttons", id: "file-views" });
  private readonly viewsSection = h(
    "div",
    { class: "section", hidden: true },
    h("h3", {}, "Saved views of the file"),
    this.views,
  );
  private readonly ignoredList = h("ul", { class: "list", id: "ignored" });
  private readonly ignoredSection: HTMLElement;
  private readonly file = h("input", { type: "file", accept: ".rviz,.yaml,.yml", hidden: true });
  private name = "coframe.rviz";
  private hasStarted = false;
  /** The text of the file that was opened, also in the last session with these displays; "" if none was. */
  private fileText = loadStored("rviz", "");
  private loadingName: string | null = null;
  /** Whether the displays are those of a file. */
  private isFileLoaded = this.fileText !== "";

  constructor(
    private readonly model: Model,
    private readonly displays: Displays,
    private readonly view: View,
    private readonly theme: Theme,
    private readonly tools: ToolSettings,
    live: boolean,
  ) {
    this.file.addEventListener("change", () => void this.load());
    this.unknownSection = h(
      "div",
      { class: "section", hidden: true },
      h("h3", {}, "Unsupported parts"),
      h("p", {}, "These parts of the file are not displayed. They are preserved when you save the file."),
      this.unknownList,
    );
    this.ignoredSection = h(
      "div",
      { class: "section", hidden: true },
      h("h3", {}, "Options without effect"),
      h(
        "p",
        {},
        "The viewer does not have these options, tools and panels. They are preserved when you save the file.",
      ),
      this.ignoredList,
    );
    this.element = h(
      "section",
      { class: "tab-body" },
      h(
        "div",
        { class: "section" },
        h("h3", {}, "RViz configuration"),
        h(
          "p",
          {},
          "Open an .rviz file of RViz 1 or 2 to apply its displays, options and view. Save the current ones for RViz.",
        ),
        this.file,
        h(
          "div",
          { class: "buttons" },
          h("button", { type: "button", disabled: !live, on: { click: () => this.file.click() } }, "Open…"),
          h("button", { type: "button", disabled: !live, id: "save-rviz", on: { click: () => this.save() } }, "Save"),
        ),
      ),
      this.viewsSection,
      this.unknownSection,
      this.ignoredSection,
    );
    model.on("hello", (hello) => {
      // Later ones, for example after a jump back in time, must not move the camera.
      if (hello.rviz && !this.hasStarted) {
        this.isFileLoaded = true;
        this.fileText = "";
        storeValue("rviz", "");
        this.applyGlobals(hello.rviz);
      } else if (!hello.rviz && this.fileText) {
        // A server that was started again, or another connection, does not have the file, which it needs for saving.
        model.send({ type: "load_rviz", text: this.fileText, restore: true });
      }
      this.hasStarted = true;
    });
    model.on("rviz", (rviz) => {
      this.isFileLoaded = true;
      if (this.loadingName !== null) this.fileText = this.loadingName;
      storeValue("rviz", this.fileText);
      displays.apply(rviz);
      this.applyGlobals(rviz);
      toast(`Loaded ${rviz.displays.length} displays.`, null, "info");
    });
    model.on("saved", ({ text }) => {
      download(this.name, new Blob([text], { type: "application/yaml" }));
    });
  }

  save(): void {
    // The background of the theme is not that of a file.
    const background = this.isFileLoaded ? this.theme.background : this.theme.palette().background;
    const global: JsonObject = { fixed_frame: this.model.fixed };
    if (background) global.background = [1, 3, 5].map((at) => Number.parseInt(background.slice(at, at + 2), 16));
    this.model.send({
      type: "save_rviz",
      displays: this.displays.save(),
      groups: this.displays.groups,
      global,
      view: { ...this.camera() },
      tools: this.tools.save(),
    });
  }

  /** The view in the format of .rviz files. */
  camera(): RvizView {
    return this.view.describeView();
  }

  private async load(): Promise<void> {
    const file = this.file.files?.[0];
    if (!file) return;
    await this.open(file);
    this.file.value = "";
  }

  /** Opens an .rviz file. */
  async open(file: File): Promise<void> {
    if (file.size > MAX_FILE_SIZE) {
      toast(`Cannot open ${file.name}: it has ${file.size} bytes, and .rviz files may have at most ${MAX_FILE_SIZE}.`);
      return;
    }
    this.name = file.name;
    this.loadingName = await file.text();
    this.model.send({ type: "load_rviz", text: this.loadingName });
  }

  /** Applies everything except the displays: global options, view, hidden frames and the list of unsupported parts. */
  private applyGlobals(rviz: RvizConfiguration): void {
    const { fixed_frame: fixed, background } = rviz.global;
    if (typeof fixed === "string" && fixed) this.model.setFixed(fixed);
    this.theme.setBackground(cssColor(background ?? undefined));
    if (rviz.view) this.view.setView(rviz.view, true);
    this.listSavedViews(rviz);
    this.tools.load(rviz.tools);
    this.hideFrames(rviz);
    this.listIgnored(rviz);
    this.unknownSection.hidden = rviz.unknown.length === 0;
    this.unknownList.replaceChildren(
      ...rviz.unknown
        .slice(0, MAX_LISTED)
        .map(({ path, class: kind, name }) =>
          h(
            "li",
            {},
            shorten(name || kind || path, 80),
            h("div", { class: "muted mono" }, shorten(`${path} ${kind}`, 120)),
          ),
        ),
    );
  }

  private listSavedViews(rviz: RvizConfiguration): void {
    this.viewsSection.hidden = rviz.saved_views.length === 0;
    const buttons = rviz.saved_views.map(({ name, view }) =>
      h("button", { type: "button", class: "small", on: { click: () => this.view.setView(view) } }, shorten(name, 60)),
    );
    this.views.replaceChildren(...buttons);
  }

  private listIgnored(rviz: RvizConfiguration): void {
    this.ignoredSection.hidden = rviz.ignored.length === 0;
    const rows = rviz.ignored.slice(0, MAX_LISTED).map(({ path, name, value }) => {
      const detail = shorten(`${path}: ${value}`, 120);
      return h("li", {}, shorten(name, 80), h("div", { class: "muted mono" }, detail));
    });
    this.ignoredList.replaceChildren(...rows);
  }

  /** Hides the frames that the TF display disables: `Frames: {All Enabled: true, some_frame: {Value: false}}`. */
  private hideFrames(rviz: RvizConfiguration): void {
    const tf = rviz.displays.find((display) => display.class.endsWith("TF"));
    const frames = tf?.options["Frames"];
    if (!frames || typeof frames !== "object" || Array.isArray(frames)) return;
    const hidden = Object.entries(frames).filter(([, value]) => {
      const shown = value && typeof value === "object" && !Array.isArray(value) ? value["Value"] : value;
      return shown === false;
    });
    this.model.setHidden(
      hidden.map(([name]) => name).filter((name) => name !== "All Enabled"),
      true,
    );
  }
}
