// SPDX-License-Identifier: Apache-2.0
/** The states of fields over time: strings, flags and enums, as colored spans. */

import { CompletedInput, MAX_TEXT } from "../dock/completion";
import type { Pane } from "../dock/dock";
import type { Model } from "../model/model";
import { COLORS } from "../plots/colors";
import { computeShownRange, WINDOWS, zoomRange, type Range } from "../plots/range";
import { h, iconButton, select, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { isString, loadList, loadStored, storeValue } from "../util/storage";
import { toast } from "../util/toast";
import { numbered, States } from "./states";

const MAX_FIELDS = 16;
const DRAW_INTERVAL_MS = 100;
const ROW_PX = 26;
const MIN_TEXT_PX = 24;
const ZOOM = 1.25;

interface Line {
  states: States;
  element: HTMLElement;
  value: HTMLElement;
  canvas: HTMLCanvasElement;
}

export class StatesPane implements Pane {
  readonly id = "states";
  readonly title = "States";
  readonly body: HTMLElement;
  readonly controls: HTMLElement[];
  private readonly input: CompletedInput;
  private readonly window: HTMLSelectElement;
  private readonly list = h("ul", { class: "states", id: "states", aria: { label: "States over time" } });
  private lines: Line[] = [];
  private nextId = 1;
  private seconds = loadStored("states-window", -1);
  private zoom: Range | null = null;
  private isOpen = false;
  private timer = 0;

  constructor(private readonly model: Model) {
    const label = "Field with states";
    this.input = new CompletedInput(
      model,
      "expression",
      label,
      "/state.data …",
      (text) => this.add(text),
      "completion-states",
    );
    this.window = select("Window", [], "", (value) => {
      this.seconds = Number(value);
      this.zoom = null;
      storeValue("states-window", this.seconds);
      this.schedule();
    });
    this.controls = [
      this.window,
      iconButton("fit", "Show the whole window (double-click)", () => {
        this.zoom = null;
        this.schedule();
      }),
    ];
    this.body = h("div", { class: "states-body" }, this.input.element, this.list);
    for (const field of loadList("states", isString).slice(0, MAX_FIELDS))
      if (field.length <= MAX_TEXT) this.insert(field);
    model.on("states", (message) => {
      this.lines.find(({ states }) => states.id === message.id)?.states.receive(message);
      this.schedule();
    });
    model.on("frames", () => this.schedule());
    model.on("clock", () => this.schedule());
    model.on("hello", () => this.start());
    new ResizeObserver(() => this.schedule()).observe(this.list);
  }

  open(): void {
    this.isOpen = true;
    this.start();
    if (!this.lines.length) this.input.input.focus();
  }

  close(): void {
    this.isOpen = false;
    this.model.send({ type: "states", fields: [] });
  }

  private get recorded(): boolean {
    return this.model.hello?.mode === "recording";
  }

  /** Requests all fields again: the server forgets them with each `hello`. */
  private start(): void {
    if (!this.isOpen || !this.model.hello) return;
    const windows = this.recorded ? [[0, "Whole recording"] as const, ...WINDOWS] : WINDOWS;
    if (!windows.some(([seconds]) => seconds === this.seconds)) this.seconds = this.recorded ? 0 : 30;
    this.window.replaceChildren(...windows.map(([seconds, text]) => new Option(text, String(seconds))));
    this.window.value = String(this.seconds);
    const fields = this.lines.map(({ states }) => states.field);
    this.lines = [];
    this.list.replaceChildren();
    for (const field of fields) this.insert(field);
    this.request();
  }

  private request(): void {
    if (!this.isOpen) return;
    const fields = this.lines.map(({ states: { id, field } }) => ({ id, expression: field }));
    this.model.send({ type: "states", fields });
    this.schedule();
  }

  private add(text: string): void {
    const field = text.trim();
    this.input.input.value = "";
    if (!field || this.lines.some(({ states }) => states.field === field)) return;
    if (this.lines.length >= MAX_FIELDS) {
      toast(`The panel shows the states of at most ${MAX_FIELDS} fields.`, "Remove a field first.");
      return;
    }
    this.insert(field.slice(0, MAX_TEXT));
    this.changed();
  }

  private changed(): void {
    storeValue(
      "states",
      this.lines.map(({ states }) => states.field),
    );
    this.request();
  }

  private insert(field: string): void {
    const states = new States(this.nextId++, field);
    const name = shorten(field, 80);
    const value = h("span", { class: "mono state-value" });
    const canvas = h("canvas", { role: "img", aria: { label: `States of ${name} over time` } });
    const remove = iconButton("close", `Remove ${name}`, () => {
      this.lines = this.lines.filter((other) => other !== line);
      line.element.remove();
      this.changed();
    });
    const head = h("div", { class: "state-head" }, h("span", { class: "mono", title: field }, name), value, remove);
    const element = h("li", { data: { field } }, head, h("div", { class: "state-canvas" }, canvas));
    const line: Line = { states, element, value, canvas };
    this.listen(line);
    this.lines.push(line);
    this.list.append(element);
  }

  private listen({ states, canvas }: Line): void {
    const timeAt = (event: MouseEvent): number | null => {
      const [range, bounds] = [this.range(), canvas.getBoundingClientRect()];
      return range && range[0] + ((event.clientX - bounds.left) / bounds.width) * (range[1] - range[0]);
    };
    canvas.addEventListener("click", (event) => {
      if (event.detail > 1) return; // The first click of a double-click may have moved the range.
      const at = timeAt(event);
      if (at !== null) this.model.setClock({ live: false, playing: false }, at);
    });
    canvas.addEventListener("dblclick", () => {
      this.zoom = null;
      this.schedule();
    });
    canvas.addEventListener("mousemove", (event) => {
      const at = timeAt(event);
      const span = at === null ? undefined : states.spans(at, at).at(-1);
      const length = span ? format.duration((span.to - span.from) / 1e9) : "";
      canvas.title = span ? `${span.text}\n${format.stamp(this.model.origin, span.from)}, for ${length}` : "";
    });
    canvas.addEventListener(
      "wheel",
      (event) => {
        const [at, range] = [timeAt(event), this.range()];
        if (at === null || !range) return;
        event.preventDefault();
        this.zoom = zoomRange(range, event.deltaY < 0 ? 1 / ZOOM : ZOOM, at);
        this.schedule();
      },
      { passive: false },
    );
  }

  private range(): Range | null {
    const { span, playhead, clock } = this.model;
    return computeShownRange({ span, playhead, live: clock.live, recorded: this.recorded }, this.seconds, this.zoom);
  }

  private schedule(): void {
    if (!this.isOpen) return;
    this.timer ||= window.setTimeout(() => {
      this.timer = 0;
      this.draw();
    }, DRAW_INTERVAL_MS);
  }

  private draw(): void {
    const range = this.range();
    const playhead = this.model.clock.live ? Infinity : this.model.playhead;
    for (const line of this.lines) {
      const { states, element, value } = line;
      element.dataset.state = states.state;
      const current = states.state === "error" ? null : states.at(playhead);
      setText(value, shorten([current, states.text].filter(Boolean).join(" · ") || "–", 300));
      value.title = states.text;
      if (range) this.drawLine(line, range, playhead);
    }
  }

  private drawLine({ states, canvas }: Line, [from, to]: Range, playhead: number): void {
    const width = canvas.parentElement?.clientWidth ?? 0;
    const ratio = devicePixelRatio;
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(ROW_PX * ratio);
    const context = canvas.getContext("2d");
    if (!context || !(to > from)) return;
    context.scale(ratio, ratio);
    const x = (time: number): number => ((time - from) / (to - from)) * width;
    const colors = numbered(states.changes.map(({ text }) => text));
    context.font = "12px system-ui, sans-serif";
    context.textBaseline = "middle";
    for (const span of states.spans(from, to)) {
      const [left, right] = [Math.max(0, x(span.from)), Math.min(width, x(span.to))];
      context.fillStyle = COLORS[(colors.get(span.text) ?? 0) % COLORS.length] as string;
      context.fillRect(left, 0, Math.max(1, right - left), ROW_PX);
      if (right - left < MIN_TEXT_PX) continue;
      context.save();
      context.beginPath();
      context.rect(left, 0, right - left - 4, ROW_PX);
      context.clip();
      context.fillStyle = "#ffffff";
      context.fillText(shorten(span.text, 60), left + 5, ROW_PX / 2);
      context.restore();
    }
    if (!Number.isFinite(playhead)) return;
    context.fillStyle = getComputedStyle(canvas).getPropertyValue("--text");
    context.fillRect(x(playhead) - 0.5, 0, 1, ROW_PX);
  }
}
