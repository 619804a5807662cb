// SPDX-License-Identifier: Apache-2.0
/** A plot of a program as an SVG: curves over a common axis, with their names and ranges. */

import { h, shorten } from "../util/dom";

const SVG = "http://www.w3.org/2000/svg";
const WIDTH = 280;
const HEIGHT = 120;
const COLORS = [
  "#3f7bf5",
  "#e5484d",
  "#30a46c",
  "#f5a524",
  "#8e4ec6",
  "#12a594",
  "#e93d82",
  "#978365",
  "#0090ff",
  "#889096",
];

interface Plot {
  x: (number | null)[];
  x_label: string;
  curves: Record<string, (number | null)[]>;
}

export function smallPlot(content: string): HTMLElement {
  const { x, x_label: label, curves } = JSON.parse(content) as Plot;
  const names = Object.keys(curves);
  const [left, right] = range(x);
  const [low, high] = range(names.flatMap((name) => curves[name] ?? []));
  const svg = document.createElementNS(SVG, "svg");
  svg.setAttribute("viewBox", `0 0 ${WIDTH} ${HEIGHT}`);
  svg.setAttribute("role", "img");
  svg.setAttribute("aria-label", `${names.join(", ")} from ${formatPlain(low)} to ${formatPlain(high)}`);
  names.forEach((name, i) => {
    const path = document.createElementNS(SVG, "path");
    path.setAttribute("d", pathOf(x, curves[name] ?? [], left, right, low, high));
    path.setAttribute("fill", "none");
    path.setAttribute("stroke", color(i));
    path.setAttribute("stroke-width", "1.5");
    path.dataset.curve = name;
    svg.append(path);
  });
  const legend = names.map((name, i) => {
    const dot = h("i", { class: "plot-dot" });
    dot.style.background = color(i);
    return h("span", {}, dot, shorten(name, 40));
  });
  return h(
    "figure",
    {},
    h("div", { class: "plot-range numbers" }, formatPlain(high)),
    svg as unknown as HTMLElement,
    h("div", { class: "plot-range numbers" }, formatPlain(low)),
    h("div", { class: "plot-range numbers" }, `${formatPlain(left)} to ${formatPlain(right)} ${shorten(label, 60)}`),
    h("figcaption", {}, ...legend),
  );
}

function pathOf(
  x: readonly (number | null)[],
  y: readonly (number | null)[],
  left: number,
  right: number,
  low: number,
  high: number,
): string {
  let text = "";
  let isDrawing = false;
  x.forEach((at, i) => {
    const value = y[i];
    if (at === null || value === null || value === undefined) {
      isDrawing = false;
      return;
    }
    const [px, py] = [((at - left) / (right - left)) * WIDTH, (1 - (value - low) / (high - low)) * HEIGHT];
    text += `${isDrawing ? "L" : "M"}${px.toFixed(2)} ${py.toFixed(2)}`;
    isDrawing = true;
  });
  return text;
}

/** The smallest and the largest number; never the same. */
function range(values: readonly (number | null)[]): [number, number] {
  const numbers = values.filter((value): value is number => value !== null);
  const low = numbers.reduce((a, b) => Math.min(a, b), Infinity);
  const high = numbers.reduce((a, b) => Math.max(a, b), -Infinity);
  if (!(low <= high)) return [0, 1];
  return low < high ? [low, high] : [low - 0.5, high + 0.5];
}

function color(i: number): string {
  return COLORS[i % COLORS.length] as string;
}

function formatPlain(value: number): string {
  return String(Number(value.toPrecision(5)));
}
