// SPDX-License-Identifier: Apache-2.0
/** A notification at the edge of the page that disappears by itself. */

import { byId, h, iconButton, shorten } from "./dom";

const SHOWN_MS = 8000;
const MAX_TOASTS = 4;

export function toast(text: string, hint: string | null = null, kind: "problem" | "info" = "problem"): void {
  const box = byId("toasts");
  const shown = shorten(text, 600);
  for (const old of [...box.children]) if (old.firstElementChild?.firstChild?.textContent === shown) old.remove();
  while (box.children.length >= MAX_TOASTS) box.firstElementChild?.remove();
  const element: HTMLElement = h(
    "div",
    { class: `toast ${kind}` },
    h("div", {}, shown, hint ? h("small", {}, shorten(hint, 600)) : null),
    iconButton("close", "Dismiss", () => element.remove()),
  );
  box.append(element);
  setTimeout(() => element.remove(), kind === "info" ? SHOWN_MS / 2 : SHOWN_MS);
}
