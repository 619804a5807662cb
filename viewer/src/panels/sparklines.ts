// SPDX-License-Identifier: Apache-2.0
/** Draws the rate of each transform over time as bars on a canvas, and marks gaps. */

import { shorten } from "../util/dom";
import type { Forest } from "../model/model";
import type { Timeline } from "../protocol/messages";

export const ROW_PX = 18;
const NAME_PX = 150;
const MAX_ROWS = 400;

export interface Colors {
  text: string;
  muted: string;
  bar: string;
  gap: string;
  line: string;
}

export interface Edge {
  frame: number;
  counts: Uint16Array;
  gaps: [number, number][];
}

export function decodeCounts(text: string, bins: number): Uint16Array {
  const counts = new Uint16Array(bins);
  let bytes: string;
  try {
    bytes = atob(text);
  } catch {
    return counts;
  }
  for (let i = 0; i < bins && i * 2 + 1 < bytes.length; i++)
    counts[i] = bytes.charCodeAt(i * 2) | (bytes.charCodeAt(i * 2 + 1) << 8);
  return counts;
}

export function decodeEdges(timeline: Timeline): Edge[] {
  return timeline.edges.map(({ frame, counts, gaps }) => ({
    frame,
    counts: decodeCounts(counts, Math.min(timeline.bins, 10_000)),
    gaps,
  }));
}

/** The sum of all edges, for the timeline. */
export function total(edges: Edge[], bins: number): Float64Array {
  const sum = new Float64Array(bins);
  for (const { counts } of edges) for (let i = 0; i < bins; i++) sum[i] = (sum[i] as number) + (counts[i] ?? 0);
  return sum;
}

export function sparkWidth(width: number): number {
  return Math.max(20, width - NAME_PX);
}

/** Draws one row per edge: name, bars and gaps. */
export function drawRows(
  canvas: HTMLCanvasElement,
  edges: Edge[],
  timeline: Timeline,
  forest: Forest,
  colors: Colors,
): void {
  const rows = edges.slice(0, MAX_ROWS);
  const width = canvas.parentElement?.clientWidth ?? 300;
  const context = prepare(canvas, width, Math.max(1, rows.length * ROW_PX));
  if (!context) return;
  const span = timeline.to - timeline.from || 1;
  const plot = sparkWidth(width);
  context.font = "11px system-ui, sans-serif";
  context.textBaseline = "middle";
  rows.forEach(({ frame, counts, gaps }, row) => {
    const top = row * ROW_PX;
    context.fillStyle = colors.muted;
    context.fillText(shorten(forest.name(frame), 28), 2, top + ROW_PX / 2, NAME_PX - 8);
    context.fillStyle = colors.gap;
    for (const [from, to] of gaps) {
      const x = NAME_PX + ((from - timeline.from) / span) * plot;
      context.fillRect(x, top + 2, Math.max(1, ((to - from) / span) * plot), ROW_PX - 4);
    }
    context.fillStyle = colors.bar;
    bars(context, counts, NAME_PX, top + 2, plot, ROW_PX - 4);
    context.fillStyle = colors.line;
    context.fillRect(0, top + ROW_PX - 1, width, 1);
  });
}

export function bars(
  context: CanvasRenderingContext2D,
  counts: ArrayLike<number>,
  left: number,
  top: number,
  width: number,
  height: number,
): void {
  let highest = 1;
  for (let i = 0; i < counts.length; i++) highest = Math.max(highest, counts[i] as number);
  const step = width / Math.max(1, counts.length);
  for (let i = 0; i < counts.length; i++) {
    const barHeight = ((counts[i] as number) / highest) * height;
    if (barHeight > 0) context.fillRect(left + i * step, top + height - barHeight, Math.max(1, step - 0.5), barHeight);
  }
}

/** Clears a canvas and sets its size. Returns a context in CSS pixels that is sharp on high-resolution screens. */
export function prepare(canvas: HTMLCanvasElement, width: number, height: number): CanvasRenderingContext2D | null {
  const ratio = devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.height = `${height}px`;
  const context = canvas.getContext("2d");
  context?.scale(ratio, ratio);
  return context;
}
