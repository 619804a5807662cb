// SPDX-License-Identifier: Apache-2.0
/** The message for errors after which the page cannot continue. */

import { byId, h } from "./dom";

export function showFatalError(title: string, text: string): Error {
  byId("overlay").append(h("div", { class: "empty-scene", role: "alert" }, h("h2", {}, title), h("p", {}, text)));
  return new Error(title);
}
