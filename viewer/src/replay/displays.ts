// SPDX-License-Identifier: Apache-2.0
/** The displays of a replay: what the server would have sent of each, picture after picture. */

import { compose, type Pose } from "../util/math";
import {
  decode,
  type DisplayMessage,
  type DisplayPose,
  type DisplayStatus,
  type ReplayDisplayBlock,
  type Vector,
} from "../protocol/messages";

/** Where the frame that everything is recorded in was at a time, seen from the one that is looked from now. */
export type Seen = (stamp: number) => Pose | null;

export const DAMAGED = "the recording in this file is damaged";

export class ReplayDisplay {
  readonly changes: Uint32Array;
  private readonly starts: Uint32Array;
  private readonly sequences: Uint32Array;
  private readonly poses: Float32Array;
  private readonly stamps: Float64Array;

  constructor(readonly block: ReplayDisplayBlock) {
    this.changes = new Uint32Array(bytes(block.changes, 4));
    this.starts = ends(new Uint32Array(bytes(block.counts, 4)));
    this.sequences = new Uint32Array(bytes(block.sequences, 4));
    this.poses = new Float32Array(bytes(block.poses, 4));
    this.stamps = new Float64Array(bytes(block.stamps, 8));
    const rows = this.sequences.length;
    const whole = this.changes.length === this.starts.length - 1 && this.starts.at(-1) === rows;
    if (!whole || this.poses.length !== rows * 7 || this.stamps.length !== rows) throw new Error(DAMAGED);
  }

  /** What is to be seen at a picture, as a tick of the server says it. */
  at(picture: number, id: number, seen: Seen): DisplayPose[] {
    const listing = lastUpTo(this.changes, picture);
    const shown: DisplayPose[] = [];
    if (listing < 0) return shown;
    for (let row = this.starts[listing] as number; row < (this.starts[listing + 1] as number); row++) {
      const pose = this.poses.slice(row * 7, row * 7 + 7);
      const base = seen(this.stamps[row] as number);
      const ok = base !== null && pose.every(Number.isFinite);
      if (ok) {
        const [x, y, z, ...quaternion] = pose as unknown as [number, number, number, number, number, number, number];
        const moved = compose(base, { position: [x, y, z] as Vector, quaternion });
        pose.set([...moved.position, ...moved.quaternion]);
      }
      shown.push({ id, sequence: this.sequences[row] as number, pose, ok });
    }
    return shown;
  }

  /** A drawing, as it would have come for a display of the page; null where the file holds none. */
  drawing(sequence: number, id: number): DisplayMessage | null {
    const packed = this.block.drawings[String(sequence)];
    if (packed === undefined) return null;
    const message = decode(bytes(packed, 1));
    return message.kind === "tick" ? null : { ...message, id, sequence };
  }

  /** What became of the display by a picture. */
  status(picture: number): [DisplayStatus["state"], string] {
    const [, state, text] = this.block.statuses.filter(([from]) => from <= picture).at(-1) ?? [0, "waiting", ""];
    return [state, text];
  }

  /** What was left out of it, in a few words. */
  get note(): string {
    return this.block.every > 1 ? `1 of ${this.block.every} pictures` : "";
  }
}

/** The index of the last value that is not larger; -1 where all are. */
export function lastUpTo(values: ArrayLike<number>, wanted: number): number {
  let low = -1;
  let high = values.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if ((values[middle] as number) <= wanted) low = middle;
    else high = middle - 1;
  }
  return low;
}

function ends(counts: Uint32Array): Uint32Array {
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
