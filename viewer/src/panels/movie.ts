// SPDX-License-Identifier: Apache-2.0
/** Records a movie of the scene with its labels, and downloads it. */

import type { Model } from "../model/model";
import type { View } from "../scene/view";
import { download, h, setText } from "../util/dom";
import { toast } from "../util/toast";
import { drawLabels, fileName } from "./export";

const FPS = 30;
const MAX_SECONDS = 600;
const FORMATS = ["video/mp4;codecs=avc1", "video/webm;codecs=vp9", "video/webm"] as const;

export class MovieRecorder {
  private readonly button = h("button", {
    type: "button",
    class: "movie small",
    id: "stop-movie",
    hidden: true,
    title: "Stop, and download the movie",
    on: { click: () => this.stop() },
  });
  private readonly canvas = h("canvas");
  private recorder: MediaRecorder | null = null;
  private timer = 0;
  private started = 0;

  constructor(
    root: HTMLElement,
    private readonly model: Model,
    private readonly view: View,
  ) {
    root.append(this.button);
    view.onDrawn(() => this.draw());
  }

  /** Starts a movie, or stops the current one and downloads it. */
  toggle(): void {
    if (this.recorder) this.stop();
    else this.start();
  }

  private start(): void {
    const format =
      typeof MediaRecorder === "undefined" ? undefined : FORMATS.find((one) => MediaRecorder.isTypeSupported(one));
    if (!format) {
      toast("This browser cannot record movies.", "It has no MediaRecorder with MP4 or WebM.");
      return;
    }
    const { canvas } = this.view.renderer;
    // Codecs need even numbers. The size stays that of the start.
    this.canvas.width = canvas.width & ~1;
    this.canvas.height = canvas.height & ~1;
    const parts: Blob[] = [];
    const recorder = new MediaRecorder(this.canvas.captureStream(FPS), { mimeType: format });
    recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    recorder.addEventListener("error", () => {
      toast("The browser cannot continue the movie.", "What was recorded so far is downloaded.");
      if (this.recorder === recorder) this.stop();
    });
    recorder.addEventListener("stop", () => {
      const type = format.split(";")[0] as string;
      const movie = new Blob(parts, { type });
      if (movie.size) download(`${fileName(this.model)}.${type.split("/")[1]}`, movie);
      else toast("The movie is empty.", "Record it while the scene is visible.");
    });
    recorder.start(1000);
    this.recorder = recorder;
    this.started = performance.now();
    this.view.refresh();
    this.timer = window.setInterval(() => this.showTime(), 500);
    this.showTime();
  }

  private stop(): void {
    clearInterval(this.timer);
    this.button.hidden = true;
    this.recorder?.stop();
    this.recorder = null;
  }

  private showTime(): void {
    const seconds = Math.floor((performance.now() - this.started) / 1000);
    this.button.hidden = false;
    setText(this.button, `Stop the movie · ${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`);
    if (seconds < MAX_SECONDS) return;
    this.stop();
    toast(`The movie ended after ${MAX_SECONDS / 60} minutes.`, "Movies are kept in memory until they end.", "info");
  }

  /** Copies what was just drawn. Later, the browser would have discarded the pixels. */
  private draw(): void {
    const context = this.recorder && this.canvas.getContext("2d");
    if (!context) return;
    const { canvas } = this.view.renderer;
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(canvas, 0, 0, this.canvas.width, this.canvas.height);
    drawLabels(context, this.view, this.canvas.width / Math.max(1, canvas.clientWidth));
  }
}
