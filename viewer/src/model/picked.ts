// SPDX-License-Identifier: Apache-2.0
/** The parts of the scene that the user has selected: points, markers, links, cells and frames. */

import type { Vector } from "../protocol/messages";

/** The message of a display that contains a part, of which the server has more values. */
export interface PickedSource {
  /** The display. */
  id: number;
  sequence: number;
  /** In the coordinates of the drawing. */
  local: Vector;
}

export interface PickedPart {
  /** What it is, such as "Point" or "Link camera_link". */
  title: string;
  /** The name of the display, or "TF". */
  display: string;
  topic: string | null;
  frame: string | null;
  /** Nanoseconds relative to hello.origin; null if it is unknown or there is none. */
  stamp: number | null;
  /** In the fixed frame. */
  position: Vector;
  rows: (readonly [name: string, value: string])[];
  source: PickedSource | null;
}

/** The parts in a rectangle: all of them are counted, the first ones are listed. */
export interface PickedGroup {
  display: string;
  count: number;
  parts: PickedPart[];
}
