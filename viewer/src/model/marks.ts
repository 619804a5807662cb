// SPDX-License-Identifier: Apache-2.0
/** The marks of frames that findings of the doctor affect. */

import type { FindingEntry, Severity } from "../protocol/messages";
import { shorten } from "../util/dom";

/** The mark of a frame: the highest severity, and a line for each finding. */
export interface Mark {
  severity: Severity;
  lines: string[];
}

/** Most severe first. */
const SEVERITIES: readonly Severity[] = ["error", "warning", "note"];
const MAX_LINES = 8;

/** Returns the marks by frame. */
export function marksOf(findings: readonly FindingEntry[]): Map<string, Mark> {
  const marks = new Map<string, Mark>();
  const all = findings.flatMap((finding) => [finding, ...finding.explains]);
  for (const severity of SEVERITIES)
    for (const finding of all.filter((one) => one.severity === severity))
      for (const frame of finding.frames) {
        const mark = marks.get(frame) ?? { severity, lines: [] };
        if (mark.lines.length < MAX_LINES) mark.lines.push(headline(finding));
        marks.set(frame, mark);
      }
  return marks;
}

/** A finding in one line: code, severity and text. */
export function headline({ code, severity, text }: FindingEntry): string {
  return `${code} ${severity}: ${shorten(text, 200)}`;
}
