// SPDX-License-Identifier: Apache-2.0
/** Opens files that the user drops on the page or chooses: recordings, trajectories, robots and .rviz files. */

import type { Model } from "../model/model";
import type { UploadProgress } from "../protocol/messages";
import { h, iconButton, setText, shorten } from "../util/dom";
import * as format from "../util/format";
import { toast } from "../util/toast";

/** Less than the largest message that the server accepts. */
const PART_BYTES = 1 << 19;
const NOT_POSSIBLE = "This viewer does not open files, because a program shows its own data in it.";

export class FileOpener {
  private readonly dialog: HTMLDialogElement;
  private readonly input = h("input", { type: "file", hidden: true });
  private readonly togetherCheckbox = h("input", { type: "checkbox", checked: true });
  private readonly recentList = h("ul", { class: "list", id: "recent" });
  private readonly drop = h("div", { class: "drop-target", hidden: true }, "Drop to open");
  private readonly progress = h("div", { class: "upload", role: "status", id: "upload", hidden: true });
  /** What is being sent: the bytes of all files, and how many of them were sent. */
  private upload: { content: Blob; names: string; sent: number } | null = null;

  /** `sendBytes` sends a binary message, and `openRviz` opens an .rviz file, which the server only parses. */
  constructor(
    private readonly model: Model,
    private readonly sendBytes: (data: ArrayBuffer) => void,
    private readonly openRviz: (file: File) => void,
  ) {
    this.input.multiple = true;
    this.input.addEventListener("change", () => {
      this.open([...(this.input.files ?? [])]);
      this.input.value = "";
    });
    this.dialog = h(
      "dialog",
      { class: "open-file", aria: { label: "Open a file" } },
      h(
        "div",
        { class: "sheet-head" },
        h("h2", {}, "Open a file"),
        iconButton("close", "Close", () => this.dialog.close()),
      ),
      h(
        "div",
        { class: "sheet-body", tabindex: "0" },
        h(
          "p",
          {},
          "Recordings (.mcap, .db3, .bag), trajectories (.tum, .csv, .npz), robots (.urdf) and .rviz files. ",
          "Files can also be dropped anywhere on the page.",
        ),
        h("button", { type: "button", class: "primary", on: { click: () => this.input.click() } }, "Choose files…"),
        h("label", { class: "check" }, this.togetherCheckbox, "Several recordings start together"),
        h("h3", {}, "Recent"),
        this.recentList,
      ),
    );
    document.body.append(this.dialog, this.input, this.drop, this.progress);
    this.listen();
    model.on("hello", () => this.showRecent());
    model.on("upload", (answer) => void this.sendNextPart(answer));
    model.on("connected", (connected) => {
      if (!connected) this.end();
    });
  }

  show(): void {
    if (!this.model.hello?.can_open) toast(NOT_POSSIBLE, "Start one with: coframe view");
    else this.dialog.showModal();
  }

  private showRecent(): void {
    const sources = this.model.hello?.recent ?? [];
    this.recentList.replaceChildren(
      ...sources.map(({ id, name, is_shown: shown }) => {
        const open = (): void => {
          this.model.send({ type: "open_recent", id });
          this.dialog.close();
        };
        const text = shorten(name, 80) + (shown ? " (shown)" : "");
        return h("li", {}, h("button", { type: "button", class: "small", disabled: shown, on: { click: open } }, text));
      }),
    );
  }

  private open(files: File[]): void {
    this.dialog.close();
    for (const file of files.filter(isRviz)) this.openRviz(file);
    const others = files.filter((file) => !isRviz(file));
    if (others.length === 0) return;
    if (!this.model.hello?.can_open) {
      toast(NOT_POSSIBLE, "Start one with: coframe view");
      return;
    }
    const names = others.map(({ name }) => shorten(name, 60)).join(", ");
    this.upload = { content: new Blob(others), names, sent: 0 };
    this.model.send({
      type: "open_files",
      files: others.map(({ name, size }) => ({ name, size })),
      together: this.togetherCheckbox.checked,
    });
  }

  /** Sends the next part of the files after the server has stored the previous one. */
  private async sendNextPart({ state, received, total, text, hint }: UploadProgress): Promise<void> {
    const { upload: sending } = this;
    if (!sending) return;
    if (state !== "receiving") {
      this.end();
      if (state === "failed") toast(text, hint);
      else toast(`Opened ${sending.names}.`, null, "info");
      return;
    }
    this.progress.hidden = false;
    const part = sending.content.slice(received, received + PART_BYTES);
    const isLast = received + part.size >= total;
    const share = format.formatFixed((100 * (received + part.size)) / Math.max(1, total), 0);
    setText(this.progress, isLast ? `Reading ${sending.names}…` : `Opening ${sending.names}: ${share} %`);
    try {
      this.sendBytes(await part.arrayBuffer());
    } catch (error) {
      this.end();
      toast(`${sending.names} cannot be read.`, String(error));
    }
  }

  private end(): void {
    this.upload = null;
    this.progress.hidden = true;
  }

  private listen(): void {
    const hasFiles = (event: DragEvent): boolean => event.dataTransfer?.types.includes("Files") ?? false;
    document.addEventListener("dragover", (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      this.drop.hidden = false;
    });
    document.addEventListener("dragleave", (event) => {
      if (!event.relatedTarget) this.drop.hidden = true;
    });
    document.addEventListener("drop", (event) => {
      if (!hasFiles(event)) return;
      event.preventDefault();
      this.drop.hidden = true;
      this.open([...(event.dataTransfer?.files ?? [])]);
    });
  }
}

function isRviz(file: File): boolean {
  return /\.(rviz|ya?ml)$/i.test(file.name);
}
