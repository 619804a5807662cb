// SPDX-License-Identifier: Apache-2.0
/** Goes to a time that the user enters, and keeps bookmarks of times. */

import type { Model } from "../model/model";
import { h, iconButton, shorten } from "../util/dom";
import * as format from "../util/format";
import { loadList, storeValue } from "../util/storage";
import { parseTime } from "../util/times";
import { toast } from "../util/toast";

const MAX_BOOKMARKS = 100;
const MAX_NAME = 80;

interface Bookmark {
  /** Nanoseconds since 1970, as text, because a number is not exact. */
  stamp: string;
  name: string;
}

export class TimesDialog {
  private readonly dialog: HTMLDialogElement;
  private readonly time = h("input", {
    type: "text",
    placeholder: "12.5, 1:30, 14:05:07 or a stamp",
    aria: { label: "Time" },
  });
  private readonly name = h("input", {
    type: "text",
    maxlength: String(MAX_NAME),
    aria: { label: "Name of the bookmark" },
  });
  private readonly list = h("ul", { class: "list", id: "bookmarks" });
  private readonly listeners: (() => void)[] = [];

  constructor(
    private readonly model: Model,
    private readonly seek: (at: number) => void,
  ) {
    const form = (label: string, input: HTMLElement, text: string, act: () => void): HTMLElement =>
      h(
        "form",
        {
          class: "toolbar",
          on: {
            submit: (event) => {
              event.preventDefault();
              act();
            },
          },
        },
        h("label", {}, h("span", {}, `${label} `), input),
        h("button", { type: "submit", class: "small" }, text),
      );
    this.dialog = h(
      "dialog",
      { class: "times", aria: { label: "Times" } },
      h(
        "div",
        { class: "sheet-head" },
        h("h2", {}, "Times"),
        iconButton("close", "Close", () => this.dialog.close()),
      ),
      h(
        "div",
        { class: "sheet-body", tabindex: "0" },
        form("Go to", this.time, "Go", () => this.go()),
        h("p", { class: "muted" }, "Seconds or minutes since the start, a time of day, or a stamp in seconds."),
        form("Bookmark", this.name, "Add", () => this.add()),
        this.list,
      ),
    );
    document.body.append(this.dialog);
  }

  /** Calls the listener when the bookmarks have changed. */
  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  show(): void {
    this.fill();
    if (!this.dialog.open) this.dialog.showModal();
    this.time.select();
  }

  /** The bookmarks of the source that is shown: their times relative to the origin, and their names. */
  get bookmarks(): { at: number; name: string }[] {
    return this.storedBookmarks.map(({ stamp, name }) => ({ at: Number(BigInt(stamp) - this.model.origin), name }));
  }

  private get key(): string {
    return `bookmarks ${(this.model.hello?.title ?? "").slice(0, 200)}`;
  }

  private get storedBookmarks(): Bookmark[] {
    return loadList(this.key, isBookmark);
  }

  private go(): void {
    const { span, origin } = this.model;
    const at = span && parseTime(this.time.value, span, origin);
    if (at === null || !Number.isFinite(at)) {
      toast(`“${shorten(this.time.value, 40)}” is not a time.`, "Examples: 12.5, 1:30, 14:05:07, 1700000000.25");
      return;
    }
    this.dialog.close();
    this.seek(at);
  }

  private add(): void {
    const at = this.model.playhead;
    if (!Number.isFinite(at)) return;
    const stamp = String(this.model.origin + BigInt(Math.round(at)));
    const name = this.name.value.trim() || format.stamp(this.model.origin, at);
    this.store([...this.storedBookmarks, { stamp, name }].slice(-MAX_BOOKMARKS));
    this.name.value = "";
  }

  private store(bookmarks: Bookmark[]): void {
    storeValue(this.key, bookmarks);
    this.fill();
    for (const listener of this.listeners) listener();
  }

  private fill(): void {
    this.list.replaceChildren(
      ...this.storedBookmarks.map((one, i) =>
        h(
          "li",
          {},
          h(
            "button",
            {
              type: "button",
              class: "small",
              on: {
                click: () => {
                  this.dialog.close();
                  this.seek(Number(BigInt(one.stamp) - this.model.origin));
                },
              },
            },
            shorten(one.name, MAX_NAME),
          ),
          iconButton("close", `Delete ${shorten(one.name, MAX_NAME)}`, () =>
            this.store(this.storedBookmarks.filter((_, k) => k !== i)),
          ),
        ),
      ),
    );
  }
}

function isBookmark(value: unknown): value is Bookmark {
  const { stamp, name } = (value ?? {}) as Partial<Bookmark>;
  return typeof stamp === "string" && /^\d{1,19}$/.test(stamp) && typeof name === "string";
}
