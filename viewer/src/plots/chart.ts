// SPDX-License-Identifier: Apache-2.0
/** One plot: the curves whose axis has the same title, drawn by uPlot. */

import uPlot from "uplot";
import { h } from "../util/dom";
import { formatFixed } from "../util/format";
import type { Curve } from "./curve";
import type { Range } from "./range";

export interface ChartStyle {
  text: string;
  line: string;
  cursor: string;
  colors: readonly string[];
}

export interface ChartEvents {
  /** The user has selected a part of time, in nanoseconds. */
  zoom(range: Range): void;
  reset(): void;
  /** The user has clicked a time, in nanoseconds. */
  seek(time: number): void;
  /** The pointer is at a time, in nanoseconds; null if it is not on a plot. */
  hover(time: number | null): void;
  /** The text of a time in nanoseconds on the axis, with the given number of digits. */
  timeText(time: number, digits: number): string;
}

const CLICK_PX = 4;
const AXIS_WIDTH = 62;
/** The height of the axis with the times, which only the lowest plot has. */
export const TIME_AXIS_PX = 26;
const SYNC = "coframe-time";

export class Chart {
  readonly element = h("div", { class: "chart" });
  /** The playhead in seconds. */
  private playhead = NaN;
  private readonly plot: uPlot;

  constructor(
    readonly title: string,
    readonly curves: readonly Curve[],
    private readonly isLowest: boolean,
    style: ChartStyle,
    private readonly events: ChartEvents,
  ) {
    const font = "11px system-ui, sans-serif";
    const axis = {
      font,
      labelFont: font,
      stroke: style.text,
      grid: { stroke: style.line, width: 1 },
      ticks: { stroke: style.line, width: 1 },
    };
    this.plot = new uPlot(
      {
        width: 300,
        height: 120,
        legend: { show: false },
        // The plots are aligned although only the lowest one has a time axis.
        padding: [8, 14, isLowest ? 0 : 4, 0],
        cursor: { sync: { key: SYNC }, drag: { x: true, y: false, setScale: false }, bind: { dblclick: () => null } },
        scales: { x: { time: false, auto: false }, y: { range: valueRange } },
        axes: [
          {
            ...axis,
            size: isLowest ? TIME_AXIS_PX : 0,
            values: (_, splits, __, ___, step) => splits.map((x) => (isLowest ? this.timeText(x, step) : "")),
          },
          { ...axis, size: AXIS_WIDTH, label: title, labelSize: 18, labelGap: 0 },
        ],
        series: [
          {},
          ...curves.map((curve) => ({
            label: curve.expression,
            stroke: style.colors[curve.color % style.colors.length] ?? style.text,
            width: 1.5,
            show: curve.visible,
          })),
        ],
        hooks: {
          draw: [(plot) => this.drawPlayhead(plot, style.cursor)],
          setSelect: [(plot) => this.select(plot)],
          setCursor: [(plot) => this.notifyHover(plot)],
        },
      },
      [[], ...curves.map(() => [])],
      this.element,
    );
    this.listen();
  }

  /** Draws the curves in a part of time, in nanoseconds. */
  draw(range: Range, playhead: number, width: number, heightOfCurves: number): void {
    const { plot } = this;
    const height = heightOfCurves + (this.isLowest ? TIME_AXIS_PX : 0);
    this.playhead = playhead / 1e9;
    if (plot.width !== width || plot.height !== height) plot.setSize({ width, height });
    const tables = this.curves.map((curve) => curve.table(range[0], range[1], 2 * width));
    const data = tables.length === 1 ? (tables[0] as uPlot.AlignedData) : uPlot.join(tables as uPlot.AlignedData[]);
    plot.batch(() => {
      plot.setData(data, false);
      plot.setScale("x", { min: range[0] / 1e9, max: range[1] / 1e9 });
    });
  }

  get canvas(): HTMLCanvasElement {
    return this.plot.ctx.canvas;
  }

  destroy(): void {
    this.plot.destroy();
    this.element.remove();
  }

  private timeText(seconds: number, step: number): string {
    const digits = step > 0 && step < 1 ? Math.min(6, Math.ceil(-Math.log10(step))) : 0;
    return this.events.timeText(seconds * 1e9, digits);
  }

  private drawPlayhead(plot: uPlot, color: string): void {
    const { min, max } = plot.scales.x ?? {};
    if (!(this.playhead >= (min ?? Infinity) && this.playhead <= (max ?? -Infinity))) return;
    const x = Math.round(plot.valToPos(this.playhead, "x", true)) + 0.5;
    const { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = color;
    ctx.lineWidth = Math.max(1, devicePixelRatio);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  private select(plot: uPlot): void {
    const { left, width } = plot.select;
    if (width < CLICK_PX) return;
    const at = (x: number): number => plot.posToVal(x, "x") * 1e9;
    const range: Range = [at(left), at(left + width)];
    plot.setSelect({ left: 0, top: 0, width: 0, height: 0 }, false);
    this.events.zoom(range);
  }

  private notifyHover(plot: uPlot): void {
    const { left } = plot.cursor;
    this.events.hover(left === undefined || left < 0 ? null : plot.posToVal(left, "x") * 1e9);
  }

  private listen(): void {
    const { over } = this.plot;
    let pressed = NaN;
    over.addEventListener("pointerdown", (event) => (pressed = event.clientX));
    over.addEventListener("click", (event) => {
      // The first click of a double-click may have moved the plot.
      if (event.detail > 1 || Math.abs(event.clientX - pressed) >= CLICK_PX) return;
      this.events.seek(this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x") * 1e9);
    });
    over.addEventListener("dblclick", () => this.events.reset());
  }
}

/** Leaves a margin, and room around a constant value. */
function valueRange(_: uPlot, min: number | null, max: number | null): uPlot.Range.MinMax {
  if (min === null || max === null || !Number.isFinite(min) || !Number.isFinite(max)) return [0, 1];
  const margin = max > min ? 0.06 * (max - min) : Math.max(1e-3, 0.1 * Math.abs(max));
  return [min - margin, max + margin];
}

export function valueText(value: number): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (Number.isInteger(value) && size >= 1000 && size < 1e15) return formatFixed(value, 0);
  if (size !== 0 && (size >= 1e6 || size < 1e-4)) return value.toExponential(3).replace("-", "−");
  return formatFixed(value, size >= 1000 ? 1 : 4);
}
