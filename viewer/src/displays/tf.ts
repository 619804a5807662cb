// SPDX-License-Identifier: Apache-2.0
/** The TF display: how frames are drawn. */

import { Display } from "./display";

const MAX_PATTERN = 200;
/** Repetitions of a group that contains a repetition may take forever on some names. */
const NESTED_REPETITION = /\([^()]*[+*{][^()]*\)[+*{]/;

/** The options of the frames, which the view draws. */
export class TfDisplay extends Display<"TF"> {
  /** Returns a function that decides whether the filters show a frame; sets the status if one of them is invalid. */
  filter(): (name: string) => boolean {
    this.status = { state: "ok", text: "" };
    const shown = this.pattern("Filter (whitelist)");
    const hidden = this.pattern("Filter (blacklist)");
    return (name) => (!shown || shown.test(name)) && !hidden?.test(name);
  }

  private pattern(key: "Filter (whitelist)" | "Filter (blacklist)"): RegExp | null {
    const text = this.options.text(key);
    if (!text) return null;
    try {
      if (text.length > MAX_PATTERN || NESTED_REPETITION.test(text)) throw new Error("it is too complex");
      return new RegExp(text);
    } catch (error) {
      const reason = error instanceof Error ? error.message : String(error);
      this.status = { state: "error", text: `${key} is not used: ${reason}` };
      return null;
    }
  }
}
