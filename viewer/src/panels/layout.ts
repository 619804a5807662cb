// SPDX-License-Identifier: Apache-2.0
/** Which panels are open, where and how large: the settings of the last session, which saved views contain too. */

import type { JsonObject } from "../protocol/messages";
import { kindOf, loadStored, storeValue } from "../util/storage";

const DEFAULTS: JsonObject = {
  "panel-shown": true,
  "panel-width": 340,
  tab: "",
  panes: [],
  "dock-side": false,
  "dock-width": 460,
  "dock-height": 300,
};

export function currentLayout(): JsonObject {
  return Object.fromEntries(Object.entries(DEFAULTS).map(([key, value]) => [key, loadStored(key, value)]));
}

/** Stores a layout. The panels read it when they are restored. */
export function storeLayout(layout: JsonObject): void {
  for (const [key, value] of Object.entries(DEFAULTS))
    if (kindOf(layout[key]) === kindOf(value)) storeValue(key, layout[key]);
}
