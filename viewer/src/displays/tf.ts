// SPDX-License-Identifier: Apache-2.0
/** The TF display: how frames are drawn. */

import { Display } from "./display";

/** The options of the frames, which the view draws. */
export class TfDisplay extends Display<"TF"> {}
