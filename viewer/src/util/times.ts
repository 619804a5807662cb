// SPDX-License-Identifier: Apache-2.0
/** Reads a time that a user has typed. */

/** Larger numbers are stamps since 1970, smaller ones seconds since the start of the timeline. */
const MIN_STAMP_S = 1e8;
const DAY_NS = 86_400_000_000_000n;

/**
 * Returns a time relative to the origin, or null: seconds ("12.5") or minutes ("1:30") since the start of the span, a
 * local time of day ("14:05:07") inside the span, or a stamp in seconds.
 */
export function parseTime(text: string, span: readonly [number, number], origin: bigint): number | null {
  const trimmed = text.trim();
  if (/^\d+(\.\d+)?$/.test(trimmed)) {
    const seconds = Number(trimmed);
    if (seconds < MIN_STAMP_S) return span[0] + seconds * 1e9;
    const [whole, part = ""] = trimmed.split(".");
    return Number(BigInt(whole as string) * 1_000_000_000n + BigInt(part.padEnd(9, "0").slice(0, 9)) - origin);
  }
  const found = /^(\d+):(\d{1,2})(?::(\d{1,2}(?:\.\d+)?))?$/.exec(trimmed);
  if (!found) return null;
  const [first, second] = [Number(found[1]), Number(found[2])];
  if (found[3] === undefined) return span[0] + (first * 60 + second) * 1e9;
  const start = origin + BigInt(Math.round(span[0]));
  const day = new Date(Number(start / 1_000_000n));
  day.setHours(first, second, 0, 0);
  let at = BigInt(day.getTime()) * 1_000_000n + BigInt(Math.round(Number(found[3]) * 1e9));
  if (at < start - DAY_NS / 2n) at += DAY_NS; // after midnight
  return Number(at - origin);
}
