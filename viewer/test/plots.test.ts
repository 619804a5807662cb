// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { Curve, findExtremes } from "../src/plots/curve";
import { computeShownRange, zoomRange } from "../src/plots/range";

const S = 1e9;
const curveOf = (times: number[], values: number[]): Curve => {
  const curve = new Curve(1, "a:b.x", 0);
  curve.receive({ id: 1, reset: true, times: Float64Array.from(times), values: Float64Array.from(values) });
  return curve;
};

describe("a curve", () => {
  it("has the value of the last point at or before a time", () => {
    const curve = curveOf([1 * S, 2 * S, 3 * S], [10, 20, NaN]);
    expect([0.5, 1, 2.9].map((time) => curve.valueAt(time * S))).toEqual([NaN, 10, 20]);
    expect(curve.valueAt(Infinity)).toBe(NaN);
  });

  it("is drawn with a point on each side of the displayed part, and with gaps", () => {
    const curve = curveOf(
      [0, 1, 2, 3, 4, 5].map((t) => t * S),
      [0, 1, NaN, 3, 4, 5],
    );
    expect(curve.table(1.5 * S, 3.5 * S, 100)).toEqual([
      [1, 2, 3, 4],
      [1, null, 3, 4],
    ]);
  });

  it("keeps as many points as the server", () => {
    const curve = curveOf([], []);
    for (let k = 0; k < 100; k++) {
      const times = Float64Array.from({ length: 1000 }, (_, i) => k * 1000 + i);
      curve.receive({ id: 1, reset: false, times, values: times });
    }
    expect(curve.length).toBeGreaterThanOrEqual(20_000);
    expect(curve.length).toBeLessThanOrEqual(40_000);
    expect([curve.lastTime, curve.valueAt(Infinity), curve.valueAt(curve.firstTime)]).toEqual([
      99_999,
      99_999,
      curve.firstTime,
    ]);
    curve.receive({ id: 1, reset: true, times: new Float64Array([7]), values: new Float64Array([8]) });
    expect([curve.length, curve.firstTime, curve.valueAt(7)]).toEqual([1, 7, 8]);
  });

  it("does not lose peaks when it is thinned", () => {
    const values = Float64Array.from({ length: 10_000 }, () => 0);
    values[1234] = 5;
    values[4321] = -5;
    values.fill(NaN, 5000, 5003);
    const kept = findExtremes(values, 0, values.length, 200);
    expect(kept.length).toBeLessThanOrEqual(201);
    expect(kept).toContain(1234);
    expect(kept).toContain(4321);
    expect(kept).toEqual([...kept].sort((a, b) => a - b));
  });
});

describe("the displayed part of time", () => {
  const state = { span: [0, 100 * S] as [number, number], playhead: 50 * S, live: false, recorded: true };

  it("is the whole recording, a window around the playhead, or the zoomed part", () => {
    expect(computeShownRange(state, 0, null)).toEqual([0, 100 * S]);
    expect(computeShownRange(state, 10, null)).toEqual([45 * S, 55 * S]);
    expect(computeShownRange(state, 10, [1, 2])).toEqual([1, 2]);
  });

  it("ends with the newest data of a live source, unless the playhead is before it", () => {
    const live = { ...state, recorded: false, live: true, playhead: 100 * S };
    expect(computeShownRange(live, 10, null)).toEqual([90 * S, 100 * S]);
    expect(computeShownRange({ ...live, live: false, playhead: 95 * S }, 10, null)).toEqual([90 * S, 100 * S]);
    expect(computeShownRange({ ...live, live: false, playhead: 30 * S }, 10, null)).toEqual([25 * S, 35 * S]);
    expect(computeShownRange({ ...live, span: null, playhead: NaN }, 10, null)).toBeNull();
  });

  it("is zoomed around a time", () => {
    expect(zoomRange([0, 10 * S], 0.5)).toEqual([2.5 * S, 7.5 * S]);
    expect(zoomRange([0, 10 * S], 2, 0)).toEqual([0, 20 * S]);
  });
});

it("the plots of the page and of `coframe plot` use the same uPlot", () => {
  const read = (path: string): string => readFileSync(join(import.meta.dirname, path), "utf8");
  expect(read("../node_modules/uplot/dist/uPlot.iife.min.js")).toBe(read("../../src/coframe/plotting/uplot.min.js"));
});
