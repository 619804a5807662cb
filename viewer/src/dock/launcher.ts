// SPDX-License-Identifier: Apache-2.0
/** Opens the panels beside the scene. Their code is loaded when the first one opens. */

import type { Model } from "../model/model";
import { link, linked } from "../util/link";
import { isString, loadList, storeValue } from "../util/storage";
import { toast } from "../util/toast";
import type { Dock } from "./dock";

export type PaneId = "plots" | "states" | "message" | "table" | "log" | "graph" | "control";

/** Makes the dock; `onChange` is called with the ids of the open panels. */
export type MakeDock = (root: HTMLElement, onChange: (shown: string[]) => void) => Dock;

const PANES: readonly (readonly [id: PaneId, text: string, detail: string, key: string])[] = [
  ["plots", "Plots", "Poses, fields, rates and delays over time", "c"],
  ["states", "States", "Strings, flags and enums of a topic over time", "q"],
  ["message", "Message inspector", "The fields of the newest message", "i"],
  ["table", "Table", "The last messages of a topic, one row each", "x"],
  ["log", "Log", "Messages on /rosout", "e"],
  ["graph", "Nodes and topics", "Who publishes and subscribes to what", "r"],
  ["control", "Control", "Publish, call services, set parameters, send goals, drive", "j"],
];

export class DockLauncher {
  private dock: Promise<Dock> | null = null;
  private isLoaded = false;

  constructor(
    private readonly root: HTMLElement,
    private readonly model: Model,
    private readonly load: () => Promise<MakeDock>,
  ) {
    model.on("plot", (expression) => this.showFor("plots", "plot", expression));
    model.on("inspect", (topic) => this.showFor("message", "inspect", topic));
  }

  /** Opens the panels of the link or of the last session. */
  restore(): void {
    const wanted = linked("panel").length ? linked("panel") : loadList("panes", isString);
    if (linked("plot").length && !wanted.includes("plots")) wanted.push("plots");
    if (this.dock || wanted.length) this.use((dock) => dock.restore(wanted));
  }

  menu(): (readonly [text: string, detail: string, act: () => void])[] {
    return [
      ...PANES.map(([id, text, detail, key]) => [text, `${detail}. Key: ${key}`, () => this.toggle(id)] as const),
      ["Below or beside the scene", "Where these panels are", () => this.use((dock) => dock.toggleSide())],
    ];
  }

  shortcuts(): { key: string; text: string; act: () => void }[] {
    return PANES.map(([id, text, , key]) => ({ key, text, act: () => this.toggle(id) }));
  }

  /** Opens a panel for a request, which a panel that is only loaded now has missed. */
  private showFor(id: PaneId, event: "plot" | "inspect", text: string): void {
    const missed = !this.isLoaded;
    this.use((dock) => {
      dock.show(id, true);
      if (missed) this.model.emit(event, text);
    });
  }

  private toggle(id: PaneId): void {
    this.use((dock) => dock.show(id, !dock.isShown(id)));
  }

  private use(act: (dock: Dock) => void): void {
    this.dock ??= this.load().then((makeDock) =>
      makeDock(this.root, (shown) => {
        storeValue("panes", shown);
        link("panel", shown);
      }),
    );
    const loaded = this.dock.then((dock) => {
      this.isLoaded = true;
      act(dock);
    });
    loaded.catch((error: unknown) => {
      this.dock = null;
      toast("The panels cannot be loaded. Is the server still running?", String(error));
    });
  }
}
