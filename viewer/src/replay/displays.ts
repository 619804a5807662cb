// SPDX-License-Identifier: Apache-2.0
/** The recorded displays of a replay. */

import { compose, type Pose } from "../util/math";
import {
  decode,
  type DisplayMessage,
  type DisplayPose,
  type DisplayStatus,
  type ReplayDisplayBlock,
  type Vector,
} from "../protocol/messages";

/** The pose of the recorded fixed frame relative to the selected one at a stamp; null if there is none. */
export type PoseAt = (stamp: number) => Pose | null;

export const DAMAGED = "The recording in this file is damaged. Save the replay again.";

export class ReplayDisplay {
  readonly changes: Uint32Array;
  private readonly starts: Uint32Array;
  private readonly sequences: Uint32Array;
  private readonly poses: Float32Array;
  private readonly stamps: Float64Array;

  constructor(readonly block: ReplayDisplayBlock) {
    this.changes = new Uint32Array(bytes(block.changes, 4));
    this.starts = cumulativeSums(new Uint32Array(bytes(block.counts, 4)));
    this.sequences = new Uint32Array(bytes(block.sequences, 4));
    this.poses = new Float32Array(bytes(block.poses, 4));
    this.stamps = new Float64Array(bytes(block.stamps, 8));
    const rows = this.sequences.length;
    const consistent = this.changes.length === this.starts.length - 1 && this.starts.at(-1) === rows;
    if (!consistent || this.poses.length !== rows * 7 || this.stamps.length !== rows) throw new Error(DAMAGED);
  }

  /** The visible messages at a sample, as in a frame update of the server. */
  at(sample: number, id: number, poseAt: PoseAt): DisplayPose[] {
    const listing = lastUpTo(this.changes, sample);
    const visible: DisplayPose[] = [];
    if (listing < 0) return visible;
    for (let row = this.starts[listing] as number; row < (this.starts[listing + 1] as number); row++) {
      const pose = this.poses.slice(row * 7, row * 7 + 7);
      const base = poseAt(this.stamps[row] as number);
      const ok = base !== null && pose.every(Number.isFinite);
      if (ok) {
        const [x, y, z, ...quaternion] = pose as unknown as [number, number, number, number, number, number, number];
        const moved = compose(base, { position: [x, y, z] as Vector, quaternion });
        pose.set([...moved.position, ...moved.quaternion]);
      }
      visible.push({ id, sequence: this.sequences[row] as number, frame: -1, pose, ok });
    }
    return visible;
  }

  /** A recorded message for a display of the page; null if the replay does not contain it. */
  message(sequence: number, id: number): DisplayMessage | null {
    const packed = this.block.drawings[String(sequence)];
    if (packed === undefined) return null;
    const decoded = decode(bytes(packed, 1));
    if (!("sequence" in decoded)) return null;
    return { ...decoded, id, sequence };
  }

  /** The status of the display at a sample. */
  status(sample: number): [DisplayStatus["state"], string] {
    const [, state, text] = this.block.statuses.filter(([from]) => from <= sample).at(-1) ?? [0, "waiting", ""];
    return [state, text];
  }

  /** A short description of what was omitted; empty if nothing was. */
  get note(): string {
    return this.block.every > 1 ? `1 of ${this.block.every} frames` : "";
  }
}

/** The index of the last value up to a limit in ascending values; -1 if all are larger. */
export function lastUpTo(values: ArrayLike<number>, limit: number): number {
  let low = -1;
  let high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((values[middle] as number) <= limit) low = middle;
    else high = middle - 1;
  }
  return low;
}

function cumulativeSums(counts: Uint32Array): Uint32Array {
  const sums = new Uint32Array(counts.length + 1);
  counts.forEach((count, i) => (sums[i + 1] = (sums[i] as number) + count));
  return sums;
}

export function bytes(base64: string, unit: number): ArrayBuffer {
  const text = atob(base64);
  if (text.length % unit !== 0) throw new Error(DAMAGED);
  const out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) out[i] = text.charCodeAt(i);
  return out.buffer;
}
