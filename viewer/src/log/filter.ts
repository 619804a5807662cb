// SPDX-License-Identifier: Apache-2.0
/** Which log messages the filters let through. */

import type { LogEntry, LogLevel } from "../protocol/messages";

export const LEVELS: readonly LogLevel[] = ["debug", "info", "warning", "error", "fatal"];

export interface LogFilter {
  /** The lowest level that is shown. */
  level: LogLevel;
  /** The node, or "" for all. */
  node: string;
  /** A part of the text, or "". */
  text: string;
}

export function matchesFilter(entry: LogEntry, { level, node, text }: LogFilter): boolean {
  if (LEVELS.indexOf(entry.level) < LEVELS.indexOf(level)) return false;
  if (node && entry.node !== node) return false;
  return !text || `${entry.text}\n${entry.place}`.toLowerCase().includes(text.toLowerCase());
}

/** The index of the last entry at or before a time, or -1; the entries need not be in order. */
export function lastBefore(entries: readonly LogEntry[], time: number): number {
  for (let i = entries.length - 1; i >= 0; i--) if ((entries[i] as LogEntry).stamp <= time) return i;
  return -1;
}
