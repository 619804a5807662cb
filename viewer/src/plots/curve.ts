// SPDX-License-Identifier: Apache-2.0
/** The points of one curve on the page, and what is drawn of them. */

import type { CurvePoints, CurveStatus } from "../protocol/messages";

/** As many as the server keeps. */
const CAPACITY = 20_000;

/** uPlot computes differences of values, which would be infinite for larger ones. */
const MAX_DRAWN_VALUE = 1e300;

/** Times in seconds, and values; null is a gap. */
export type Table = [x: number[], y: (number | null)[]];

export class Curve {
  status: CurveStatus | null = null;
  visible = true;
  private times = new Float64Array(1024);
  private values = new Float64Array(1024);
  private count = 0;

  constructor(
    readonly id: number,
    readonly expression: string,
    readonly color: number,
  ) {}

  get length(): number {
    return this.count;
  }

  get firstTime(): number {
    return this.count ? (this.times[0] as number) : NaN;
  }

  get lastTime(): number {
    return this.count ? (this.times[this.count - 1] as number) : NaN;
  }

  receive({ reset, times, values }: CurvePoints): void {
    if (reset) this.count = 0;
    const total = this.count + times.length;
    if (total > this.times.length) {
      const size = Math.min(2 * CAPACITY, Math.max(total, 2 * this.times.length));
      const dropped = Math.max(0, total > size ? total - CAPACITY : 0);
      this.times = enlarge(this.times.subarray(dropped, this.count), size);
      this.values = enlarge(this.values.subarray(dropped, this.count), size);
      this.count -= dropped;
    }
    const room = this.times.length - this.count;
    this.times.set(times.subarray(Math.max(0, times.length - room)), this.count);
    this.values.set(values.subarray(Math.max(0, values.length - room)), this.count);
    this.count += Math.min(times.length, room);
  }

  /** The value at the last point at or before a time in nanoseconds. */
  valueAt(time: number): number {
    const i = this.countUpTo(time) - 1;
    return i < 0 ? NaN : (this.values[i] as number);
  }

  /** The points between two times, and one more on each side; of many, the extremes of equal parts. */
  table(from: number, to: number, maxPoints: number): Table {
    const begin = Math.max(0, this.countUpTo(from) - 1);
    const end = Math.min(this.count, this.countUpTo(to) + 1);
    const indices = findExtremes(this.values, begin, end, maxPoints);
    const x: number[] = [];
    const y: (number | null)[] = [];
    for (const i of indices) {
      const value = this.values[i] as number;
      x.push((this.times[i] as number) / 1e9);
      y.push(Math.abs(value) <= MAX_DRAWN_VALUE ? value : null); // null for NaN
    }
    return [x, y];
  }

  /** The number of points at or before a time. */
  private countUpTo(time: number): number {
    let [low, high] = [0, this.count];
    while (low < high) {
      const middle = (low + high) >>> 1;
      if ((this.times[middle] as number) <= time) low = middle + 1;
      else high = middle;
    }
    return low;
  }
}

function enlarge(values: Float64Array, size: number): Float64Array<ArrayBuffer> {
  const larger = new Float64Array(size);
  larger.set(values);
  return larger;
}

/** The indices of the smallest and the largest value of each of many equal parts, so that no peak is lost. */
export function findExtremes(values: ArrayLike<number>, begin: number, end: number, maxPoints: number): number[] {
  const indices: number[] = [];
  if (end - begin <= maxPoints) {
    for (let i = begin; i < end; i++) indices.push(i);
    return indices;
  }
  const size = Math.ceil(((end - begin) * 2) / maxPoints);
  for (let start = begin; start < end; start += size) {
    let [low, high] = [start, start];
    for (let i = start; i < Math.min(end, start + size); i++) {
      const value = values[i] as number;
      if (value < (values[low] as number) || Number.isNaN(values[low])) low = i;
      if (value > (values[high] as number) || Number.isNaN(values[high])) high = i;
    }
    if (low === high) indices.push(low);
    else indices.push(Math.min(low, high), Math.max(low, high));
  }
  return indices;
}
