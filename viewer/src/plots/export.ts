// SPDX-License-Identifier: Apache-2.0
/** Saves the plots as an image, and all points of the curves as CSV. */

import { download, h } from "../util/dom";
import type { Chart } from "./chart";
import type { Curve } from "./curve";

const LINE_PX = 18;

/** The server writes the file, because it has all points, without thinning. */
export function saveCsv(curves: readonly Curve[]): void {
  const url = new URL("curves.csv", location.href);
  url.hash = "";
  url.search = new URLSearchParams(curves.map((curve) => ["curve", curve.expression])).toString();
  const anchor = h("a");
  anchor.href = url.href;
  anchor.download = "coframe-curves.csv";
  anchor.click();
}

export async function savePng(charts: readonly Chart[], colors: readonly string[], style: string[]): Promise<void> {
  const [background = "#fff", text = "#000"] = style;
  const scale = devicePixelRatio;
  const line = LINE_PX * scale;
  const width = Math.max(...charts.map((chart) => chart.canvas.width));
  const height = charts.reduce((sum, chart) => sum + chart.canvas.height + (chart.curves.length + 1) * line, 0);
  const canvas = h("canvas");
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  if (!context) return;
  context.fillStyle = background;
  context.fillRect(0, 0, width, height);
  context.font = `${12 * scale}px sans-serif`;
  let y = 0;
  for (const chart of charts) {
    for (const curve of chart.curves) {
      y += line;
      context.fillStyle = colors[curve.color % colors.length] ?? text;
      context.fillRect(8 * scale, y - 9 * scale, 14 * scale, 4 * scale);
      context.fillStyle = text;
      context.fillText(curve.expression, 28 * scale, y - 3 * scale);
    }
    context.drawImage(chart.canvas, 0, y);
    y += chart.canvas.height + line;
  }
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
  if (blob) download("coframe-plot.png", blob);
}
