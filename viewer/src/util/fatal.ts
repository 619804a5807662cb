// SPDX-License-Identifier: Apache-2.0
/** What is said where the page cannot go on. */

import { byId, h } from "./dom";

export function fatal(title: string, text: string): Error {
  byId("overlay").append(h("div", { class: "nothing", role: "alert" }, h("h2", {}, title), h("p", {}, text)));
  return new Error(title);
}
