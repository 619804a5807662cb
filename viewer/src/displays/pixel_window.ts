// SPDX-License-Identifier: Apache-2.0
/** Converts the pixels of images to colors, with a range of values for those that were measured. */

import { ImageFormat, type Image } from "../protocol/messages";

/** The range of values that are shown from black to white. */
export type Range = readonly [low: number, high: number];

/** The ranges of the last images, whose median does not flicker if single values are wrong. */
export class RangeFilter {
  private ranges: Range[] = [];

  /** Adds the range of an image, and returns the medians of the last images. */
  addRange(range: Range, window: number): Range {
    this.ranges = [...this.ranges, range].slice(-Math.max(1, Math.round(window)));
    return [median(this.ranges.map(([low]) => low)), median(this.ranges.map(([, high]) => high))];
  }
}

function median(values: number[]): number {
  return values.sort((a, b) => a - b)[(values.length - 1) >> 1] as number;
}

/** The smallest and largest finite value; 0 and 1 if there is none. */
export function rangeOf(values: Uint16Array | Float32Array): Range {
  let [low, high] = [Infinity, -Infinity];
  for (const value of values) {
    if (!Number.isFinite(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
  }
  return low <= high ? [low, high] : [0, 1];
}

/** The colors of an image that the browser does not decode. Pixels without a value are transparent. */
export function toColors({ format, width, height, data, values }: Image, [low, high]: Range): ImageData {
  const pixels = new ImageData(width, height);
  const out = pixels.data;
  const scale = 255 / Math.max(high - low, 1e-9);
  for (let i = 0, at = 0; i < width * height; i++, at += 4) {
    if (values) {
      const value = values[i] as number;
      out[at] = out[at + 1] = out[at + 2] = (value - low) * scale;
      out[at + 3] = Number.isNaN(value) ? 0 : 255;
    } else if (format === ImageFormat.gray) {
      out[at] = out[at + 1] = out[at + 2] = data[i] as number;
      out[at + 3] = 255;
    } else {
      out[at] = data[i * 3] as number;
      out[at + 1] = data[i * 3 + 1] as number;
      out[at + 2] = data[i * 3 + 2] as number;
      out[at + 3] = 255;
    }
  }
  return pixels;
}

/** The value of a pixel as text; null if the browser has decoded the image. */
export function valueAt({ format, width, data, values }: Image, x: number, y: number): string | null {
  const i = y * width + x;
  if (values) return format === ImageFormat.gray16 ? String(values[i]) : formatNumber(values[i] as number);
  if (format === ImageFormat.gray) return String(data[i]);
  return format === ImageFormat.rgb ? data.subarray(i * 3, i * 3 + 3).join(" ") : null;
}

function formatNumber(value: number): string {
  return Number.isNaN(value) ? "no value" : String(Number(value.toPrecision(5)));
}
