// SPDX-License-Identifier: Apache-2.0
/** A picture of the scene, and a replay that plays without a server. */

import type { Displays } from "../displays/manager";
import { download, h, iconButton } from "../util/dom";
import type { Model } from "../model/model";
import type { RvizPanel } from "./rviz";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const RATE_HZ = 30;

export async function savePicture(view: View, model: Model): Promise<void> {
  try {
    const picture = await view.stage.picture();
    const labelled = await withLabels(picture, view);
    const name = (model.hello?.title || "coframe").replace(/[^\w.-]+/g, "_").slice(0, 60);
    download(`${name}.png`, labelled);
  } catch (error) {
    toast("The picture could not be made.", String(error));
  }
}

/** Names are elements over the canvas; in a picture they have to be drawn. */
async function withLabels(picture: Blob, view: View): Promise<Blob> {
  const image = await createImageBitmap(picture);
  const canvas = document.createElement("canvas");
  canvas.width = image.width;
  canvas.height = image.height;
  const context = canvas.getContext("2d");
  if (!context) return picture;
  context.drawImage(image, 0, 0);
  const scale = image.width / view.stage.width;
  context.scale(scale, scale);
  const stage = view.stage.canvas.getBoundingClientRect();
  for (const label of document.querySelectorAll<HTMLElement>("#labels .label")) {
    const box = label.getBoundingClientRect();
    const style = getComputedStyle(label);
    const [x, y] = [box.left - stage.left, box.top - stage.top];
    context.font = `${style.fontWeight} ${style.fontSize} ${style.fontFamily}`;
    context.textBaseline = "middle";
    context.globalAlpha = Number(style.opacity);
    context.fillStyle = style.backgroundColor;
    context.fillRect(x, y, box.width, box.height);
    const left = x + Number.parseFloat(style.paddingLeft);
    if (style.textShadow !== "none") {
      context.strokeStyle = getComputedStyle(document.documentElement).getPropertyValue("--halo");
      context.lineWidth = 3;
      context.lineJoin = "round";
      context.strokeText(label.textContent ?? "", left, y + box.height / 2);
    }
    context.fillStyle = style.color;
    context.fillText(label.textContent ?? "", left, y + box.height / 2);
  }
  return new Promise((resolve) => canvas.toBlob((blob) => resolve(blob ?? picture), "image/png"));
}

/** What goes into a replay is told to the server first, which then makes the file. */
export class ReplayExport {
  private wanted: URLSearchParams | null = null;

  constructor(
    private readonly model: Model,
    private readonly displays: Displays,
    private readonly rviz: RvizPanel,
    private readonly view: View,
  ) {
    model.on("replay", ({ settings }) => void this.fetch(settings));
  }

  /** Asks the user for the span. */
  ask(): void {
    const { model } = this;
    const span = model.clock.loop ?? model.span;
    if (!span || !(span[1] > span[0])) {
      toast("There is nothing to replay yet.", "Wait until transforms have come for a moment.");
      return;
    }
    const seconds = (span[1] - span[0]) / 1e9;
    const last = h("input", { type: "number", min: "0.1", step: "1", aria: { label: "Seconds" } });
    last.value = String(Math.round(Math.min(seconds, 30) * 10) / 10);
    const rate = h("input", { type: "number", min: "1", max: "60", step: "1", aria: { label: "Pictures a second" } });
    rate.value = String(RATE_HZ);
    const dialog = h("dialog", { aria: { label: "Save a replay" } });
    const save = (): void => {
      const length = Math.max(0.1, Math.min(seconds, last.valueAsNumber || seconds)) * 1e9;
      const end = model.clock.live || model.clock.loop ? span[1] : Math.min(span[1], model.playhead || span[1]);
      const from = Math.max(span[0], end - length);
      this.save(from, Math.min(span[1], from + length), Math.max(1, Math.min(60, rate.valueAsNumber || RATE_HZ)));
      dialog.close();
    };
    dialog.append(
      h(
        "div",
        { class: "sheet-head" },
        h("h2", {}, "Save a replay"),
        iconButton("close", "Close", () => dialog.close()),
      ),
      h(
        "div",
        { class: "sheet-body" },
        h(
          "p",
          { class: "muted" },
          "One HTML file that opens anywhere, without a server: for homework and bug reports.",
        ),
        h(
          "p",
          { class: "muted" },
          "It holds the frames, the robots and the displays that are shown. Large clouds are thinned; the file says by how much.",
        ),
        h("label", { class: "field" }, h("span", {}, model.clock.loop ? "Marked, s" : "Last seconds"), last),
        h("label", { class: "field" }, h("span", {}, "Pictures/s"), rate),
        h("div", { class: "buttons" }, h("button", { type: "button", class: "primary", on: { click: save } }, "Save")),
      ),
    );
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
  }

  private save(from: number, to: number, rate: number): void {
    const { model, displays, rviz } = this;
    this.wanted = new URLSearchParams({
      from: String(Math.round(from)),
      to: String(Math.round(to)),
      rate: String(rate),
      fixed: model.fixed,
    });
    toast("Making the replay…", null, "info");
    model.send({
      type: "replay",
      displays: displays.shownTopics,
      // Far from the origin the camera's place means nothing to another page.
      rviz: {
        displays: displays.save(),
        global: {},
        view: this.view.placement.origin.some(Boolean) ? null : rviz.camera(),
      },
    });
  }

  private async fetch(settings: string): Promise<void> {
    const { wanted } = this;
    this.wanted = null;
    if (!wanted) return;
    wanted.set("settings", settings);
    const url = new URL("replay", location.href);
    url.search = wanted.toString();
    try {
      const answer = await fetch(url);
      if (answer.ok) download("coframe-replay.html", await answer.blob());
      else toast("The replay could not be made.", await answer.text());
    } catch (error) {
      toast("The replay could not be made.", String(error));
    }
  }
}
