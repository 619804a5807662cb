// SPDX-License-Identifier: Apache-2.0
/** The panel for .rviz files: opens and saves them, and lists their unsupported parts. */

import type { Displays } from "../displays/manager";
import { cssColor } from "../displays/options";
import { download, h, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { ToolSettings } from "../model/tools";
import type { JsonObject, RvizConfiguration, RvizView } from "../protocol/messages";
import type { Theme } from "../util/theme";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const MAX_FILE_SIZE = 900_000; // bytes

export class RvizPanel {
  readonly element: HTMLElement;
  private readonly unknown = h("ul", { class: "list", id: "unknown" });
  private readonly unknownSection: HTMLElement;
  private readonly file = h("input", { type: "file", accept: ".rviz,.yaml,.yml", hidden: true });
  private name = "coframe.rviz";

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
      this.unknown,
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
      this.unknownSection,
    );
    model.on("hello", (hello) => {
      if (hello.rviz) this.applyGlobals(hello.rviz);
    });
    model.on("rviz", (rviz) => {
      displays.apply(rviz);
      this.applyGlobals(rviz);
      toast(`Loaded ${rviz.displays.length} displays.`, null, "info");
    });
    model.on("saved", ({ text }) => {
      download(this.name, new Blob([text], { type: "application/yaml" }));
    });
  }

  save(): void {
    const background = this.theme.palette().background;
    const global: JsonObject = {
      fixed_frame: this.model.fixed,
      background: [1, 3, 5].map((at) => Number.parseInt(background.slice(at, at + 2), 16)),
    };
    const tools = this.tools.save();
    this.model.send({ type: "save_rviz", displays: this.displays.save(), global, view: { ...this.camera() }, tools });
  }

  /** The view in the format of .rviz files. */
  camera(): RvizView {
    const camera = this.view.renderer.camera.describe(this.view.followed);
    return { class: camera.class.replace(/^.*\//, ""), options: camera.options };
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
    this.model.send({ type: "load_rviz", text: await file.text() });
  }

  /** Applies everything except the displays: global options, view, hidden frames and the list of unsupported parts. */
  private applyGlobals(rviz: RvizConfiguration): void {
    const { fixed_frame: fixed, background } = rviz.global;
    if (typeof fixed === "string" && fixed) this.model.setFixed(fixed);
    this.theme.setBackground(cssColor(background ?? undefined));
    if (rviz.view) {
      if (this.view.renderer.camera.apply(rviz.view)) this.view.keepCamera();
      const target = rviz.view.options["Target Frame"];
      const name = typeof target === "string" && !target.startsWith("<") ? target : null;
      if (name && name !== fixed) this.view.setFollowed(name);
    }
    this.tools.load(rviz.tools);
    this.hideFrames(rviz);
    this.unknownSection.hidden = rviz.unknown.length === 0;
    this.unknown.replaceChildren(
      ...rviz.unknown
        .slice(0, 500)
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
