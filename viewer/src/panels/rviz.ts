// SPDX-License-Identifier: Apache-2.0
/** .rviz files: read one, see what of it is not known here, write one back. */

import type { Displays } from "../displays/manager";
import { cssColour } from "../displays/options";
import { download, h, shorten } from "../util/dom";
import type { Model } from "../model/model";
import type { JsonObject, RvizConfiguration, RvizView } from "../protocol/messages";
import type { Theme } from "../util/theme";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const LARGEST = 900_000;

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
    live: boolean,
  ) {
    this.file.addEventListener("change", () => void this.load());
    this.unknownSection = h(
      "div",
      { class: "section", hidden: true },
      h("h3", {}, "Not shown here"),
      h("p", {}, "These parts of the file are kept and written back as they were."),
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
          "Displays, options and view of an .rviz file of RViz 1 or 2. What you change here can be saved for RViz.",
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
      if (hello.rviz) this.applyRest(hello.rviz);
    });
    model.on("rviz", (rviz) => {
      displays.apply(rviz);
      this.applyRest(rviz);
      toast(`Read ${rviz.displays.length} displays`, null, "info");
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
    this.model.send({ type: "save_rviz", displays: this.displays.save(), global, view: { ...this.camera() } });
  }

  /** The view, as an .rviz file has it. */
  camera(): RvizView {
    const camera = this.view.stage.camera.describe(this.view.followed);
    return { class: camera.class.replace(/^.*\//, ""), options: camera.options };
  }

  private async load(): Promise<void> {
    const file = this.file.files?.[0];
    if (!file) return;
    this.file.value = "";
    if (file.size > LARGEST) {
      toast(`${file.name} is too large for an .rviz file.`);
      return;
    }
    this.name = file.name;
    this.model.send({ type: "load_rviz", text: await file.text() });
  }

  /** All but the displays: the global options, the view, hidden frames, and the list of what is not known. */
  private applyRest(rviz: RvizConfiguration): void {
    const { fixed_frame: fixed, background } = rviz.global;
    if (typeof fixed === "string" && fixed) this.model.setFixed(fixed);
    this.theme.setBackground(cssColour(background ?? undefined));
    if (rviz.view) {
      if (this.view.stage.camera.apply(rviz.view)) this.view.keepCamera();
      const target = rviz.view.options["Target Frame"];
      const name = typeof target === "string" && !target.startsWith("<") ? target : null;
      if (name && name !== fixed) this.view.setFollowed(name);
    }
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

  /** TF: Frames: {All Enabled: true, some_frame: {Value: false}}. */
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
