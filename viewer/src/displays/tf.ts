// SPDX-License-Identifier: Apache-2.0
/** The TF display: how frames are drawn. */

import { Display } from "./display";
import type { OptionSpec } from "./options";

export const TF_SPECS: readonly OptionSpec[] = [
  { key: "Show Names", kind: "flag", value: true },
  { key: "Show Axes", kind: "flag", value: true },
  { key: "Show Arrows", kind: "flag", value: true },
  { key: "Marker Scale", kind: "number", value: 1, min: 0.01, max: 1000, step: 0.1 },
  { key: "Frame Timeout", kind: "number", value: 15, min: 0, max: 86400, step: 1, unit: "s" },
];

/** The options of the frames, which the view draws. */
export class TfDisplay extends Display {}
