// SPDX-License-Identifier: Apache-2.0
/** The timeline: pause, scrub, step, speed, loop, and return to live data. */

import { h, icon, iconButton, select, setText } from "../util/dom";
import * as format from "../util/format";
import type { Model } from "../model/model";
import type { Timeline as TimelineMessage } from "../protocol/messages";
import { bars, decodeEdges, drawRows, prepare, total, type Colors, type Edge } from "./sparklines";
import { storeValue, loadStored } from "../util/storage";
import { TimesDialog } from "./times";

const SPEEDS = ["0.1", "0.25", "0.5", "1", "2", "5", "10"] as const;
const REQUEST_INTERVAL_MS = 2000;
const BINS = 240;
const MIN_ZOOM_NS = 1e6;
const ZOOM = 1.25;

export class Timeline {
  private readonly play: HTMLButtonElement;
  private readonly liveButton: HTMLButtonElement;
  private readonly loop: HTMLButtonElement;
  private readonly sparklinesButton: HTMLButtonElement;
  private readonly time = h("button", { type: "button", class: "time numbers", id: "time" });
  private readonly times: TimesDialog;
  /** The part of the span that is shown after zooming; null for all of it. */
  private zoomedSpan: [number, number] | null = null;
  private readonly canvas = h("canvas", {
    tabindex: "0",
    role: "slider",
    aria: { label: "Time", valuemin: "0", valuemax: "0", valuenow: "0" },
  });
  private readonly playhead = h("div", { class: "playhead", aria: { hidden: "true" } });
  private readonly rows = h("canvas", {
    role: "img",
    aria: { label: "Rates and gaps of each frame over time" },
  });
  private readonly sparklines: HTMLElement;
  private message: TimelineMessage | null = null;
  private edges: Edge[] = [];
  private sum: ArrayLike<number> = [];
  private requestedTime = 0;
  private drawing = 0;
  private dragging: number | null = null;
  /** The start of the loop while the user selects it by dragging with Shift. */
  private loopStart: number | null = null;

  constructor(
    root: HTMLElement,
    private readonly model: Model,
    reset: (() => void) | null,
  ) {
    this.times = new TimesDialog(model, (at) => this.seek(at));
    this.times.onChange(() => this.redraw());
    this.time.addEventListener("click", () => this.times.show());
    this.play = iconButton("pause", "Pause or play (Space)", () => this.toggle());
    this.liveButton = h(
      "button",
      { type: "button", class: "small", title: "Back to live (l)", on: { click: () => this.goLive() } },
      "Live",
    );
    this.loop = iconButton(
      "loop",
      "Loop (o): everything, or a time span selected by dragging with Shift",
      () => this.toggleLoop(),
      "wide-only",
    );
    this.sparklinesButton = iconButton("chevron", "Rates over time (t)", () => this.toggleSparklines(), "wide-only");
    this.sparklines = h("div", { class: "sparklines", hidden: !loadStored("sparks", false) }, this.rows);
    const speed = select(
      "Speed",
      SPEEDS.map((s) => [s, `${s}×`] as const),
      "1",
      (value) => this.model.setClock({ speed: Number(value), live: false }),
    );
    root.append(
      h(
        "div",
        { class: "transport" },
        iconButton("back", "Previous message (,)", () => this.step(-1)),
        this.play,
        iconButton("forward", "Next message (.)", () => this.step(1)),
        this.liveButton,
        ...(reset ? [resetButton(reset)] : []),
        this.loop,
        speed,
        h("div", { class: "scrub" }, this.canvas, this.playhead),
        this.time,
        this.sparklinesButton,
      ),
      this.sparklines,
    );
    this.listen();
    model.on("frames", () => this.followPlayhead());
    model.on("stats", () => this.redraw());
    model.on("clock", ({ live }) => {
      // Otherwise the press that pauses live data would be at another time of the earlier zoom.
      if (live) this.zoomedSpan = null;
      this.updateButtons();
    });
    model.on("hello", () => this.start());
    model.on("timeline", (message) => this.receive(message));
    new ResizeObserver(() => this.redraw()).observe(this.canvas.parentElement as HTMLElement);
    this.updateButtons();
  }

  toggle(): void {
    const { live, playing } = this.model.clock;
    const span = this.model.span;
    const at = this.model.playhead;
    if (live) this.model.setClock({ live: false, playing: false });
    else if (!playing && span && at >= span[1] - 1e6) this.model.setClock({ playing: true }, span[0]);
    else this.model.setClock({ playing: !playing });
  }

  goLive(): void {
    this.model.setClock({ live: true, playing: false });
  }

  step(direction: 1 | -1): void {
    if (this.model.clock.live || this.model.clock.playing) this.model.setClock({ live: false, playing: false });
    this.model.step(direction);
  }

  /** Opens the dialog to go to a time, and for bookmarks. */
  showTimes(): void {
    this.times.show();
  }

  /** The span that the timeline shows. */
  private get shownSpan(): [number, number] | null {
    const { span } = this.model;
    return this.zoomedSpan && span && !this.model.clock.live ? this.zoomedSpan : span;
  }

  /** Shows a larger or smaller part of the span around a time. */
  private zoom(at: number, factor: number): void {
    const [span, shown] = [this.model.span, this.shownSpan];
    if (!span || !shown || this.model.clock.live) return;
    const from = Math.max(span[0], at - (at - shown[0]) * factor);
    const to = Math.min(span[1], at + (shown[1] - at) * factor);
    if (to - from < MIN_ZOOM_NS) return;
    this.zoomedSpan = from <= span[0] && to >= span[1] ? null : [from, to];
    this.requestedTime = 0;
    this.redraw();
    this.followPlayhead();
  }

  /** Moves the playhead by seconds. */
  jump(seconds: number): void {
    const at = this.model.playhead;
    if (Number.isFinite(at)) this.seek(at + seconds * 1e9);
  }

  toggleLoop(): void {
    const span = this.model.span;
    this.model.setClock({ loop: this.model.clock.loop || !span ? null : [...span], live: false });
  }

  toggleSparklines(): void {
    this.sparklines.hidden = !this.sparklines.hidden;
    storeValue("sparks", !this.sparklines.hidden);
    this.updateButtons();
    this.requestedTime = 0;
    this.redraw();
  }

  /** Recordings have no live data; they are paused at their start. */
  private start(): void {
    const { hello } = this.model;
    this.message = null;
    this.zoomedSpan = null;
    const recorded = hello?.mode === "recording" || hello?.mode === "replay";
    this.liveButton.hidden = recorded;
    const [span, at] = [hello?.span, this.model.playhead];
    const isOutside = !span || !(at >= span[0] && at <= span[1]);
    if (recorded && (this.model.clock.live || isOutside))
      this.model.setClock({ live: false, playing: false }, hello?.span?.[0] ?? 0);
    else if (!this.model.clock.live) this.model.sendClock();
  }

  private seek(at: number): void {
    const span = this.model.span;
    const limited = span ? Math.max(span[0], Math.min(span[1], at)) : at;
    this.model.setClock({ live: false, playing: this.model.clock.playing && this.dragging === null }, limited);
  }

  private receive(message: TimelineMessage): void {
    this.message = message;
    this.edges = decodeEdges(message);
    this.sum = total(this.edges, Math.min(message.bins, 10_000));
    this.redraw();
  }

  private followPlayhead(): void {
    const update = this.model.frameUpdate;
    const span = this.model.span;
    if (!update || !span) return;
    const now = performance.now();
    const [from, to] = this.shownSpan ?? span;
    const { message } = this;
    const isShown = this.zoomedSpan === null || (message?.from === Math.round(from) && message.to === Math.round(to));
    const current = message?.revision === this.model.forest.revision && isShown;
    if (now - this.requestedTime > REQUEST_INTERVAL_MS && to > from && (this.model.clock.live || !current)) {
      this.requestedTime = now;
      this.model.send({ type: "timeline", from: Math.round(from), to: Math.round(to), bins: BINS });
    }
    setText(this.time, format.stamp(this.model.origin, update.time));
    this.time.title = `${format.offset(update.time - span[0])} of ${format.offset(span[1] - span[0])}`;
    this.placePlayhead();
  }

  private placePlayhead(): void {
    const span = this.shownSpan;
    const at = this.dragging ?? this.model.frameUpdate?.time ?? NaN;
    const part = span && span[1] > span[0] ? (at - span[0]) / (span[1] - span[0]) : NaN;
    const isOutside = this.zoomedSpan !== null && !(part >= 0 && part <= 1);
    this.playhead.hidden = (!Number.isFinite(part) || isOutside) && !this.model.clock.live;
    const shown = this.model.clock.live ? 1 : Math.max(0, Math.min(1, part));
    this.playhead.style.left = `${(shown * 100).toFixed(3)}%`;
    if (!span || !Number.isFinite(part)) return;
    this.canvas.setAttribute("aria-valuemax", ((span[1] - span[0]) / 1e9).toFixed(1));
    this.canvas.setAttribute("aria-valuenow", ((at - span[0]) / 1e9).toFixed(1));
  }

  private updateButtons(): void {
    const { live, playing, loop } = this.model.clock;
    const running = live || playing;
    this.play.replaceChildren(icon(running ? "pause" : "play"));
    this.play.setAttribute("aria-label", running ? "Pause" : "Play");
    this.liveButton.setAttribute("aria-pressed", String(live));
    this.loop.setAttribute("aria-pressed", String(loop !== null));
    this.sparklinesButton.setAttribute("aria-expanded", String(!this.sparklines.hidden));
    this.sparklinesButton.style.transform = this.sparklines.hidden ? "rotate(-90deg)" : "rotate(90deg)";
    this.redraw();
  }

  private colors(): Colors {
    const style = getComputedStyle(document.documentElement);
    const read = (name: string): string => style.getPropertyValue(name).trim();
    return {
      text: read("--text"),
      muted: read("--muted"),
      bar: read("--accent"),
      gap: `${read("--bad")}44`,
      line: read("--line"),
    };
  }

  /** Schedules a redraw; several calls before it cause only one. */
  private redraw(): void {
    this.drawing ||= requestAnimationFrame(() => {
      this.drawing = 0;
      this.draw();
    });
  }

  private draw(): void {
    this.placePlayhead();
    const { clientWidth: width, clientHeight: height } = this.canvas.parentElement ?? this.canvas;
    const context = prepare(this.canvas, width, height);
    const span = this.shownSpan;
    if (!context || width === 0) return;
    const colors = this.colors();
    context.fillStyle = getComputedStyle(document.documentElement).getPropertyValue("--raised");
    context.fillRect(0, 0, width, height);
    if (!span || !(span[1] > span[0])) return;
    const x = (ns: number): number => ((ns - span[0]) / (span[1] - span[0])) * width;
    this.drawDensity(context, colors, x, height);
    const { loop } = this.model.clock;
    if (loop) {
      context.fillStyle = `${colors.bar}33`;
      context.fillRect(x(loop[0]), 0, Math.max(1, x(loop[1]) - x(loop[0])), height);
    }
    for (const { at } of this.times.bookmarks) drawMark(context, colors.text, x(at));
    if (!this.sparklines.hidden && this.message)
      drawRows(this.rows, this.edges, this.message, this.model.forest, colors);
  }

  private drawDensity(
    context: CanvasRenderingContext2D,
    colors: Colors,
    x: (ns: number) => number,
    height: number,
  ): void {
    const { message } = this;
    if (!message || message.revision !== this.model.forest.revision) return;
    // Live bars are up to two seconds old. They are stretched to the full width rather than ending early.
    const { live } = this.model.clock;
    const width = context.canvas.clientWidth;
    const toX = live ? (ns: number): number => ((ns - message.from) / (message.to - message.from)) * width : x;
    const [from, to] = [toX(message.from), toX(message.to)];
    context.globalAlpha = 0.55;
    context.fillStyle = colors.bar;
    bars(context, this.sum, from, 4, to - from, height - 4);
    context.globalAlpha = 1;
    context.fillStyle = colors.gap.slice(0, 7);
    for (const { gaps } of this.edges)
      for (const [a, b] of gaps) context.fillRect(toX(a), 0, Math.max(1.5, toX(b) - toX(a)), 3);
  }

  private listen(): void {
    const { canvas } = this;
    const timeAt = (event: PointerEvent): number | null => {
      const span = this.shownSpan;
      if (!span) return null;
      const bounds = canvas.getBoundingClientRect();
      const part = Math.max(0, Math.min(1, (event.clientX - bounds.left) / bounds.width));
      return span[0] + part * (span[1] - span[0]);
    };
    canvas.addEventListener(
      "wheel",
      (event) => {
        const bounds = canvas.getBoundingClientRect();
        const span = this.shownSpan;
        if (!span) return;
        event.preventDefault();
        const at = span[0] + ((event.clientX - bounds.left) / bounds.width) * (span[1] - span[0]);
        this.zoom(at, event.deltaY < 0 ? 1 / ZOOM : ZOOM);
      },
      { passive: false },
    );
    canvas.addEventListener("dblclick", () => {
      this.zoomedSpan = null;
      this.requestedTime = 0;
      this.redraw();
    });
    canvas.addEventListener("pointerdown", (event) => {
      const at = timeAt(event);
      if (at === null) return;
      canvas.setPointerCapture(event.pointerId);
      this.dragging = at;
      if (event.shiftKey) this.loopStart = at;
      else this.seek(at);
    });
    canvas.addEventListener("pointermove", (event) => {
      const at = timeAt(event);
      if (this.dragging === null || at === null) return;
      this.dragging = at;
      if (this.loopStart !== null) {
        const ends: [number, number] = [Math.min(this.loopStart, at), Math.max(this.loopStart, at)];
        if (ends[1] > ends[0]) this.model.setClock({ live: false, loop: ends }, ends[0]);
      } else this.seek(at);
    });
    const end = (): void => {
      this.dragging = null;
      this.loopStart = null;
    };
    canvas.addEventListener("pointerup", end);
    canvas.addEventListener("pointercancel", end);
    canvas.addEventListener("keydown", (event) => {
      const seconds = { ArrowLeft: -1, ArrowRight: 1, PageDown: -10, PageUp: 10 }[event.key];
      if (seconds === undefined) return;
      this.jump(seconds * (event.shiftKey ? 0.1 : 1));
      event.preventDefault();
      event.stopPropagation();
    });
  }
}

function resetButton(reset: () => void): HTMLElement {
  const title = "Reset (Shift r): start again without the data received so far";
  return h("button", { type: "button", class: "small", title, id: "reset", on: { click: reset } }, "Reset");
}

/** Draws a bookmark: a triangle at the upper edge. */
function drawMark(context: CanvasRenderingContext2D, color: string, x: number): void {
  context.fillStyle = color;
  context.beginPath();
  context.moveTo(x - 5, 0);
  context.lineTo(x + 5, 0);
  context.lineTo(x, 8);
  context.fill();
}
