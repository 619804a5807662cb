// SPDX-License-Identifier: Apache-2.0
/** Curves over time: live as they arrive, or of a whole recording. */

import { CompletedInput, MAX_TEXT } from "../dock/completion";
import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import { copyText, h, iconButton, select, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { link, linked } from "../util/link";
import { isString, loadList, loadStored, storeValue } from "../util/storage";
import type { Theme } from "../util/theme";
import { toast } from "../util/toast";
import { Chart, TIME_AXIS_PX, valueText, type ChartEvents, type ChartStyle } from "./chart";
import { COLORS } from "./colors";
import { Curve } from "./curve";
import { saveCsv, savePng } from "./export";
import { computeShownRange, WINDOWS, zoomRange, type Range } from "./range";

const MAX_CURVES = 32;
const DRAW_INTERVAL_MS = 100;
const REQUEST_DELAY_MS = 150;
const MIN_CHART_PX = 70;

export class PlotsPane implements Pane {
  readonly id = "plots";
  readonly title = "Plots";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly input: CompletedInput;
  private readonly list = h("ul", { class: "curves", id: "curves", aria: { label: "Curves" } });
  private readonly area = h("div", { class: "charts", id: "charts" });
  private readonly window: HTMLSelectElement;
  private readonly values = new Map<number, HTMLElement>();
  private curves: Curve[] = [];
  private charts: Chart[] = [];
  private nextId = 1;
  private isOpen = false;
  private seconds: number;
  private zoom: Range | null = null;
  /** The part of a recording that was requested; null for all of it. */
  private fetchedRange: Range | null = null;
  private hoveredTime: number | null = null;
  private lastDrawTime = 0;
  private drawTimer = 0;
  private requestTimer = 0;

  constructor(
    private readonly model: Model,
    theme: Theme,
  ) {
    this.seconds = Number(linked("window")[0] ?? loadStored("plot-window", -1));
    const expressions = linked("plot").length ? linked("plot") : loadList("plots", isString);
    for (const expression of expressions.slice(0, MAX_CURVES))
      if (expression.length <= MAX_TEXT) this.insert(expression);
    this.input = new CompletedInput(
      model,
      "expression",
      "Expression to plot",
      "odom:base_link.x, /scan.ranges[0], /tf.rate …",
      (text) => this.addTyped(text),
    );
    this.window = select("Window", [], "", (value) => this.setWindow(Number(value)));
    this.controls = [
      this.window,
      iconButton("plus", "Zoom in", () => this.zoomBy(0.5)),
      iconButton("minus", "Zoom out", () => this.zoomBy(2)),
      iconButton("fit", "Show the whole window (double-click)", () => this.setZoom(null)),
      iconButton("link", "Copy a link to these plots", () => void this.copyLink()),
      h("button", { type: "button", class: "small", on: { click: () => saveCsv(this.curves) } }, "CSV"),
      h("button", { type: "button", class: "small", on: { click: () => void this.savePng() } }, "PNG"),
    ];
    this.body = h(
      "div",
      { class: "plots" },
      h("div", { class: "plots-side" }, this.input.element, this.list),
      this.area,
    );
    model.on("plot", (expression) => this.add(expression));
    model.on("curve", (status) => {
      const curve = this.curves.find(({ id }) => id === status.id);
      if (!curve) return;
      const moved = curve.status?.axis !== status.axis;
      curve.status = status;
      if (moved) this.rebuild();
      else this.showList();
    });
    model.on("curves", ({ curves }) => {
      for (const points of curves) this.curves.find(({ id }) => id === points.id)?.receive(points);
      this.schedule();
    });
    model.on("frames", () => this.schedule());
    model.on("clock", () => this.schedule());
    model.on("hello", () => this.start());
    theme.onChange(() => this.isOpen && this.rebuild());
    new ResizeObserver(() => this.schedule()).observe(this.area);
  }

  open(): void {
    this.isOpen = true;
    this.start();
    if (!this.curves.length) this.input.input.focus();
  }

  close(): void {
    this.isOpen = false;
    this.model.send({ type: "curves", curves: [] });
    this.rebuild();
  }

  private get isRecorded(): boolean {
    return this.model.hello?.mode === "recording";
  }

  /** Requests everything again: the server forgets its curves with each `hello`. */
  private start(): void {
    if (!this.isOpen || !this.model.hello) return;
    const windows = this.isRecorded ? [[0, "Whole recording"] as const, ...WINDOWS] : WINDOWS;
    if (!windows.some(([seconds]) => seconds === this.seconds)) this.seconds = this.isRecorded ? 0 : 10;
    this.window.replaceChildren(...windows.map(([seconds, text]) => new Option(text, String(seconds))));
    this.window.value = String(this.seconds);
    this.zoom = this.fetchedRange = null;
    this.curves = this.curves.map((curve) => this.copy(curve));
    this.rebuild();
    this.request();
  }

  private copy(curve: Curve): Curve {
    const copy = new Curve(this.nextId++, curve.expression, curve.color);
    copy.visible = curve.visible;
    return copy;
  }

  private addTyped(text: string): void {
    this.add(text);
    this.input.input.value = "";
  }

  private add(expression: string): void {
    if (this.curves.some((curve) => curve.expression === expression)) return;
    if (expression.length > MAX_TEXT) {
      toast(`An expression has at most ${MAX_TEXT} characters, and this one has ${expression.length}.`);
      return;
    }
    if (this.curves.length >= MAX_CURVES) {
      toast(`The plots show at most ${MAX_CURVES} curves.`, "Remove a curve first.");
      return;
    }
    this.insert(expression);
    this.notifyChange();
  }

  private insert(expression: string): void {
    const used = new Set(this.curves.map(({ color }) => color));
    let color = 0;
    while (used.has(color)) color++;
    this.curves.push(new Curve(this.nextId++, expression, color));
  }

  private remove(curve: Curve): void {
    this.curves = this.curves.filter((one) => one !== curve);
    this.notifyChange();
  }

  private notifyChange(): void {
    const expressions = this.curves.map(({ expression }) => expression);
    storeValue("plots", expressions);
    link("plot", expressions);
    this.rebuild();
    this.request();
  }

  private setWindow(seconds: number): void {
    this.seconds = seconds;
    storeValue("plot-window", seconds);
    link("window", [String(seconds)]);
    this.setZoom(null);
  }

  private setZoom(range: Range | null): void {
    this.zoom = range;
    if (this.isRecorded) this.requestSoon();
    this.schedule();
  }

  private zoomBy(factor: number): void {
    const range = this.range();
    if (range) this.setZoom(zoomRange(range, factor));
  }

  private range(): Range | null {
    const { span, playhead, clock } = this.model;
    return computeShownRange({ span, playhead, live: clock.live, recorded: this.isRecorded }, this.seconds, this.zoom);
  }

  private requestSoon(): void {
    clearTimeout(this.requestTimer);
    this.requestTimer = window.setTimeout(() => this.request(), REQUEST_DELAY_MS);
  }

  /** Requests the curves; of a recording, the displayed part and as much again on both sides. */
  private request(): void {
    if (!this.isOpen) return;
    const range = this.range();
    const whole = !this.isRecorded || !range || (!this.zoom && this.seconds === 0);
    this.fetchedRange = whole ? null : zoomRange(range, 3);
    const points = Math.max(1000, 2 * this.area.clientWidth) * (whole ? 1 : 3);
    this.model.send({
      type: "curves",
      curves: this.curves.map(({ id, expression }) => ({ id, expression })),
      span: this.fetchedRange,
      points,
    });
  }

  /** Makes the plots again: one for each title of an axis. */
  private rebuild(): void {
    for (const chart of this.charts) chart.destroy();
    const titles = new Map<string, Curve[]>();
    for (const curve of this.isOpen ? this.curves : []) {
      const title = curve.status?.axis;
      if (title) titles.set(title, [...(titles.get(title) ?? []), curve]);
    }
    const style = this.style();
    const events: ChartEvents = {
      zoom: (range) => this.setZoom(range),
      reset: () => this.setZoom(null),
      seek: (time) => this.model.setClock({ live: false, playing: false }, time),
      hover: (time) => this.showValuesAt(time),
      timeText: (time, digits) => this.timeText(time, digits),
    };
    this.charts = [...titles].map(
      ([title, curves], i) => new Chart(shorten(title, 40), curves, i === titles.size - 1, style, events),
    );
    this.area.replaceChildren(...this.charts.map((chart) => chart.element));
    this.showList();
    this.schedule();
  }

  private style(): ChartStyle {
    const style = getComputedStyle(document.documentElement);
    const read = (name: string): string => style.getPropertyValue(name).trim();
    return { text: read("--muted"), line: read("--line"), cursor: read("--text"), colors: COLORS };
  }

  private timeText(time: number, digits: number): string {
    const text = format.stamp(this.model.origin, time);
    if (text.endsWith(" s")) return `${Number.parseFloat(text).toFixed(digits)}`;
    return digits ? text.slice(0, 9 + Math.min(3, digits)) : text.slice(0, 8);
  }

  /** Draws at most ten times per second, and only while the panel is open. */
  private schedule(): void {
    if (!this.isOpen || this.drawTimer) return;
    const wait = Math.max(0, DRAW_INTERVAL_MS - (performance.now() - this.lastDrawTime));
    this.drawTimer = window.setTimeout(() => {
      this.drawTimer = 0;
      this.lastDrawTime = performance.now();
      if (this.isOpen && !document.hidden) this.draw();
    }, wait);
  }

  private draw(): void {
    const range = this.range();
    if (!range) return;
    const { fetchedRange: fetched } = this;
    if (fetched && (range[0] < fetched[0] || range[1] > fetched[1])) this.requestSoon();
    const width = this.area.clientWidth;
    const room = (this.area.clientHeight - TIME_AXIS_PX) / Math.max(1, this.charts.length);
    const height = Math.max(MIN_CHART_PX, Math.floor(room) - 1);
    if (width < 80) return;
    for (const chart of this.charts) chart.draw(range, this.model.playhead, width, height);
    this.showValues();
  }

  private showValuesAt(time: number | null): void {
    if (time === this.hoveredTime) return;
    this.hoveredTime = time;
    this.showValues();
  }

  private showValues(): void {
    const time = this.hoveredTime ?? this.model.playhead;
    for (const curve of this.curves) {
      const cell = this.values.get(curve.id);
      // Live, the newest values are a little older or newer than the playhead.
      const at = this.hoveredTime === null && this.model.clock.live ? Infinity : time;
      if (cell) setText(cell, valueText(curve.valueAt(at)));
    }
  }

  private showList(): void {
    this.values.clear();
    this.list.replaceChildren(...this.curves.map((curve) => this.row(curve)));
    this.showValues();
  }

  private row(curve: Curve): HTMLElement {
    const { status, expression } = curve;
    const name = shorten(expression, 80);
    const swatch = h("i", { class: "swatch", aria: { hidden: "true" } });
    swatch.style.background = COLORS[curve.color % COLORS.length] ?? "";
    const value = h("span", { class: "numbers curve-value" });
    this.values.set(curve.id, value);
    const show = h(
      "button",
      {
        type: "button",
        class: "curve-name",
        title: `${expression.slice(0, 300)}\nShow or hide`,
        aria: { pressed: String(curve.visible) },
        on: { click: () => this.toggleCurve(curve) },
      },
      swatch,
      h("span", { class: "mono" }, name),
    );
    const text = status && (status.state !== "ok" || status.text) ? `${status.text} ${status.hint}`.trim() : "";
    return h(
      "li",
      { class: "curve", data: { state: status?.state ?? "waiting", expression: expression.slice(0, 300) } },
      show,
      value,
      iconButton("close", `Remove ${name}`, () => this.remove(curve)),
      text ? h("p", { class: "curve-problem" }, shorten(text, 400)) : null,
    );
  }

  private toggleCurve(curve: Curve): void {
    curve.visible = !curve.visible;
    this.rebuild();
  }

  private async copyLink(): Promise<void> {
    link(
      "plot",
      this.curves.map(({ expression }) => expression),
    );
    link("window", [String(this.seconds)]);
    link("panel", [this.id]);
    const ok = await copyText(location.href);
    toast(
      ok ? "Copied a link to these plots." : "The browser does not allow this page to use the clipboard.",
      null,
      "info",
    );
  }

  private savePng(): Promise<void> {
    const style = getComputedStyle(document.documentElement);
    const colors = ["--panel", "--text"].map((name) => style.getPropertyValue(name).trim());
    return this.charts.length ? savePng(this.charts, COLORS, colors) : Promise.resolve();
  }
}
