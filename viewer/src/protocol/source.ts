// SPDX-License-Identifier: Apache-2.0
/** Where frames come from: a server over a socket, or a recording inside the page itself. */

import type { BinaryMessage, ClientMessage, ServerMessage } from "./messages";

export interface SourceEvents {
  text: ServerMessage;
  binary: BinaryMessage;
  /** Broken messages are counted and told, never fatal. */
  broken: string;
  connected: boolean;
}

export interface Source {
  /** False in a replay: there is no server to export, publish or save for us. */
  readonly live: boolean;
  start(listener: <K extends keyof SourceEvents>(event: K, value: SourceEvents[K]) => void): void;
  send(message: ClientMessage): void;
}
