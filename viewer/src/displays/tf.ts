// SPDX-License-Identifier: Apache-2.0
/** TF: how frames themselves are drawn. */

import { Display } from "./display";
import type { OptionSpec } from "./options";

export const TF_SPECS: readonly OptionSpec[] = [
  { key: "Show Names", kind: "flag", value: true },
  { key: "Show Axes", kind: "flag", value: true },
  { key: "Show Arrows", label: "Show lines", kind: "flag", value: true },
  { key: "Marker Scale", kind: "number", value: 1, min: 0.01, max: 1000, step: 0.1 },
  { key: "Frame Timeout", kind: "number", value: 15, min: 0, max: 86400, step: 1, unit: "s" },
];

/** The frames are drawn by the view; this holds what it is to draw. */
export class TfDisplay extends Display {}
