// SPDX-License-Identifier: Apache-2.0
/** The part of time that the plots show. */

export type Range = [from: number, to: number];

/** Window lengths in seconds; 0 is the whole recording. */
export const WINDOWS: readonly (readonly [seconds: number, text: string])[] = [
  [5, "5 s"],
  [10, "10 s"],
  [30, "30 s"],
  [60, "1 min"],
  [300, "5 min"],
  [600, "10 min"],
];

export interface TimeState {
  /** The span of the source in nanoseconds. */
  span: Range | null;
  playhead: number;
  live: boolean;
  recorded: boolean;
}

/**
 * The displayed part of time: the zoomed part; or the whole recording, or a window around the playhead; or the window
 * that ends with the newest data.
 */
export function computeShownRange(state: TimeState, seconds: number, zoom: Range | null): Range | null {
  if (zoom) return zoom;
  const { span, playhead } = state;
  if (state.recorded && (seconds === 0 || !Number.isFinite(playhead))) return span && widen(span);
  const length = (seconds || 10) * 1e9;
  if (state.recorded) return [playhead - length / 2, playhead + length / 2];
  const newest = span ? Math.max(span[1], state.live ? playhead || span[1] : span[1]) : playhead;
  if (!Number.isFinite(newest)) return null;
  // While the time is paused, the window follows the playhead only as far as it has to.
  const end = state.live || playhead >= newest - length ? newest : playhead + length / 2;
  return [end - length, end];
}

export function zoomRange(range: Range, factor: number, at = (range[0] + range[1]) / 2): Range {
  const least = 1e6;
  const length = Math.max(least, (range[1] - range[0]) * factor);
  const part = (at - range[0]) / (range[1] - range[0]);
  return [at - part * length, at + (1 - part) * length];
}

function widen([from, to]: Range): Range {
  return to > from ? [from, to] : [from - 1e9, to + 1e9];
}
