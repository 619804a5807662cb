// SPDX-License-Identifier: Apache-2.0
/** Detects a page that is older than its server, and reloads it once. */

import { PROTOCOL_VERSION } from "../generated/protocol";

const KEY = "coframe.reloaded";

export type Verdict = "current" | "reload" | "different";

/**
 * What to do about the version in the server's `hello`.
 *
 * A page is reloaded at most once per server version: if the versions still differ afterwards, another reload would not
 * help. Without a storage to remember the reload, the page is not reloaded at all.
 */
export function compareVersion(
  version: unknown,
  storage: Pick<Storage, "getItem" | "setItem" | "removeItem">,
): Verdict {
  try {
    if (version === PROTOCOL_VERSION) {
      storage.removeItem(KEY);
      return "current";
    }
    if (storage.getItem(KEY) === String(version)) return "different";
    storage.setItem(KEY, String(version));
    return "reload";
  } catch {
    return version === PROTOCOL_VERSION ? "current" : "different";
  }
}
