// SPDX-License-Identifier: Apache-2.0
/** Exports an image of the scene, or a replay that plays without a server. */

import type { Displays } from "../displays/manager";
import { download, h, iconButton } from "../util/dom";
import type { Model } from "../model/model";
import type { RvizPanel } from "./rviz";
import { toast } from "../util/toast";
import type { View } from "../scene/view";

const DEFAULT_RATE_HZ = 30;

export async function saveImage(view: View, model: Model): Promise<void> {
  try {
    const image = await view.renderer.image();
    const labeled = await withLabels(image, view);
    download(`${fileName(model)}.png`, labeled);
  } catch (error) {
    toast("Cannot save the image.", String(error));
  }
}

/** The name of a file with what the page shows, without its ending. */
export function fileName(model: Model): string {
  return (model.hello?.title || "coframe").replace(/[^\w.-]+/g, "_").slice(0, 60);
}

/** Draws the labels into an image of the canvas. */
async function withLabels(blob: Blob, view: View): Promise<Blob> {
  const image = await createImageBitmap(blob);
  const canvas = document.createElement("canvas");
  canvas.width = image.width;
  canvas.height = image.height;
  const context = canvas.getContext("2d");
  if (!context) return blob;
  context.drawImage(image, 0, 0);
  drawLabels(context, view, image.width / Math.max(1, view.renderer.canvas.clientWidth));
  return new Promise((resolve) => canvas.toBlob((result) => resolve(result ?? blob), "image/png"));
}

/** Draws the labels, which are HTML elements above the canvas, onto a copy of the canvas. */
export function drawLabels(context: CanvasRenderingContext2D, view: View, scale: number): void {
  context.scale(scale, scale);
  const bounds = view.renderer.canvas.getBoundingClientRect();
  for (const label of document.querySelectorAll<HTMLElement>("#labels .label")) {
    const box = label.getBoundingClientRect();
    const style = getComputedStyle(label);
    const [x, y] = [box.left - bounds.left, box.top - bounds.top];
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
  context.globalAlpha = 1;
}

/** Saves a replay: sends its settings to the server, then downloads the file. */
export class ReplayExport {
  private parameters: URLSearchParams | null = null;

  constructor(
    private readonly model: Model,
    private readonly displays: Displays,
    private readonly rviz: RvizPanel,
    private readonly view: View,
  ) {
    model.on("replay", ({ settings }) => void this.fetch(settings));
  }

  /** Opens the dialog for the time span and the rate. */
  open(): void {
    const { model } = this;
    const span = model.clock.loop ?? model.span;
    if (!span || !(span[1] > span[0])) {
      toast("Cannot save a replay yet.", "The time span is empty. Wait until transforms were received for a moment.");
      return;
    }
    const seconds = (span[1] - span[0]) / 1e9;
    const last = h("input", { type: "number", min: "0.1", step: "1", aria: { label: "Seconds" } });
    last.value = String(Math.round(Math.min(seconds, 30) * 10) / 10);
    const rate = h("input", { type: "number", min: "1", max: "60", step: "1", aria: { label: "Frames per second" } });
    rate.value = String(DEFAULT_RATE_HZ);
    const dialog = h("dialog", { aria: { label: "Save a replay" } });
    const save = (): void => {
      const length = Math.max(0.1, Math.min(seconds, last.valueAsNumber || seconds)) * 1e9;
      const end = model.clock.live || model.clock.loop ? span[1] : Math.min(span[1], model.playhead || span[1]);
      const from = Math.max(span[0], end - length);
      this.save(
        from,
        Math.min(span[1], from + length),
        Math.max(1, Math.min(60, rate.valueAsNumber || DEFAULT_RATE_HZ)),
      );
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
        { class: "sheet-body", tabindex: "0" },
        h("p", { class: "muted" }, "A single HTML file that plays in any browser, without a server."),
        h(
          "p",
          { class: "muted" },
          "It contains the frames, the robots and the visible displays. Large clouds are thinned; the replay shows by how much.",
        ),
        h("label", { class: "field" }, h("span", {}, model.clock.loop ? "Loop, s" : "Last seconds"), last),
        h("label", { class: "field" }, h("span", {}, "Frames per second"), rate),
        h("div", { class: "buttons" }, h("button", { type: "button", class: "primary", on: { click: save } }, "Save")),
      ),
    );
    dialog.addEventListener("close", () => dialog.remove());
    document.body.append(dialog);
    dialog.showModal();
  }

  private save(from: number, to: number, rate: number): void {
    const { model, displays, rviz } = this;
    this.parameters = new URLSearchParams({
      from: String(Math.round(from)),
      to: String(Math.round(to)),
      rate: String(rate),
      fixed: model.fixed,
    });
    toast("Saving the replay…", null, "info");
    model.send({
      type: "replay",
      displays: displays.shownTopics,
      // After the scene's origin has moved, the camera's position is not valid in another page.
      rviz: {
        displays: displays.save(),
        global: {},
        view: this.view.framePoses.origin.some(Boolean) ? null : rviz.camera(),
      },
    });
  }

  private async fetch(settings: string): Promise<void> {
    const { parameters } = this;
    this.parameters = null;
    if (!parameters) return;
    parameters.set("settings", settings);
    const url = new URL("replay", location.href);
    url.search = parameters.toString();
    try {
      const response = await fetch(url);
      if (response.ok) download("coframe-replay.html", await response.blob());
      else toast("Cannot save the replay.", await response.text());
    } catch (error) {
      toast("Cannot save the replay.", String(error));
    }
  }
}
