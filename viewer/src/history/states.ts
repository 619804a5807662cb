// SPDX-License-Identifier: Apache-2.0
/** The states of one field over time, as spans between changes. */

import type { FieldStates, StateChange } from "../protocol/messages";

/** As many as the server keeps. */
const MAX_CHANGES = 5000;

export interface StateSpan {
  from: number;
  to: number;
  text: string;
}

export class States {
  changes: StateChange[] = [];
  until: number | null = null;
  state: FieldStates["state"] = "waiting";
  text = "";

  constructor(
    readonly id: number,
    readonly field: string,
  ) {}

  receive({ state, text, reset, until, changes }: FieldStates): void {
    this.changes = [...(reset ? [] : this.changes), ...changes].slice(-MAX_CHANGES);
    this.until = until;
    this.state = state;
    this.text = text;
  }

  /** The spans that overlap a part of time. The last one ends with the last message. */
  spans(from: number, to: number): StateSpan[] {
    const end = this.until ?? 0;
    return this.changes.flatMap(({ stamp, text }, i) => {
      const next = this.changes[i + 1]?.stamp ?? Math.max(end, stamp);
      return next >= from && stamp <= to ? [{ from: stamp, to: next, text }] : [];
    });
  }

  /** The state at a time; null before the first message. */
  at(time: number): string | null {
    let [low, high] = [0, this.changes.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if ((this.changes[middle] as StateChange).stamp <= time) low = middle + 1;
      else high = middle;
    }
    return this.changes[low - 1]?.text ?? null;
  }
}

/** Assigns each text a number, in the order in which the texts appear. */
export function numbered(texts: readonly string[]): Map<string, number> {
  const found = new Map<string, number>();
  for (const text of texts) if (!found.has(text)) found.set(text, found.size);
  return found;
}
