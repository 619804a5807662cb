// SPDX-License-Identifier: Apache-2.0
/** A sentence that comes up at the edge and goes by itself. */

import { byId, h, iconButton } from "./dom";

const SHOWN_MS = 8000;
const MOST = 4;

export function toast(text: string, hint: string | null = null, kind: "problem" | "info" = "problem"): void {
  const box = byId("toasts");
  for (const old of [...box.children]) if (old.firstElementChild?.firstChild?.textContent === text) old.remove();
  while (box.children.length >= MOST) box.firstElementChild?.remove();
  const element: HTMLElement = h(
    "div",
    { class: `toast ${kind}` },
    h("div", {}, text.slice(0, 600), hint ? h("small", {}, hint.slice(0, 600)) : null),
    iconButton("close", "Dismiss", () => element.remove()),
  );
  box.append(element);
  setTimeout(() => element.remove(), kind === "info" ? SHOWN_MS / 2 : SHOWN_MS);
}
