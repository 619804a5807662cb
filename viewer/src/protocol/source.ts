// SPDX-License-Identifier: Apache-2.0
/** The source of messages: a server that is connected by a WebSocket, or a recording inside the page. */

import type { BinaryMessage, ClientMessage, ServerMessage } from "./messages";

export interface SourceEvents {
  text: ServerMessage;
  binary: BinaryMessage;
  /** The error of an invalid message. Invalid messages are counted and logged; they are never fatal. */
  invalid: string;
  connected: boolean;
  /** Whether an open connection has delivered nothing for a while. */
  silent: boolean;
}

export interface MessageSource {
  /** False in a replay, where no server can export, publish or save. */
  readonly live: boolean;
  start(listener: <K extends keyof SourceEvents>(event: K, value: SourceEvents[K]) => void): void;
  send(message: ClientMessage): void;
  /** Sends the next bytes of files that are opened. */
  sendBytes(data: ArrayBuffer): void;
}
