// SPDX-License-Identifier: Apache-2.0
/** The panels beside the scene; a separate script, which is loaded when the first of them opens. */

import { ControlPane } from "./control/pane";
import { Dock } from "./dock/dock";
import { StatesPane } from "./history/states_pane";
import { TablePane } from "./history/table_pane";
import { LogPane } from "./log/pane";
import { MessagePane } from "./message_inspector/pane";
import type { Model } from "./model/model";
import { GraphPane } from "./node_graph/pane";
import { PlotsPane } from "./plots/pane";
import type { Theme } from "./util/theme";

export function makeDock(root: HTMLElement, model: Model, theme: Theme, onChange: (shown: string[]) => void): Dock {
  const panes = [
    new PlotsPane(model, theme),
    new StatesPane(model),
    new MessagePane(model),
    new TablePane(model),
    new LogPane(model),
    new GraphPane(model),
    new ControlPane(model),
  ];
  return new Dock(root, panes, onChange);
}
