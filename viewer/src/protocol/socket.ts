// SPDX-License-Identifier: Apache-2.0
/**
 * The WebSocket to the server; opens immediately and reconnects whenever it closes or delivers nothing for long. The
 * server sends at least one message per second.
 */

import { showFatalError } from "../util/fatal";
import { toast } from "../util/toast";
import { checkServerMessage, decode, PROTOCOL_VERSION, type ClientMessage } from "./messages";
import type { MessageSource, SourceEvents } from "./source";
import { compareVersion } from "./version";

const FIRST_WAIT_MS = 250;
const MAX_WAIT_MS = 4000;
/** A connection that lasted this long was not closed because of what the page sent, so the next wait is short. */
const STABLE_MS = 5000;
/** After this long without a message, the page says so; after the second time, it opens another connection. */
const SILENT_MS = 2200;
const RECONNECT_MS = 9000;
/** An attempt to connect is given up after this long. */
const OPEN_TIMEOUT_MS = 8000;
const CHECK_MS = 400;
/** If a check is later than this, the page itself stood still, for example because a file was parsed. */
const LATE_CHECK_MS = 1500;
/** That of the server. */
const MAX_REQUEST_BYTES = 1 << 20;
/** The most bytes of UTF-8 of one unit of UTF-16. */
const MAX_UTF8 = 3;

type Listener = <K extends keyof SourceEvents>(event: K, value: SourceEvents[K]) => void;

export class SocketSource implements MessageSource {
  readonly live = true;
  private socket: WebSocket | null = null;
  private reconnectDelay = FIRST_WAIT_MS;
  private openTime = 0;
  private receiveTime = 0;
  private checked = 0;
  private isSilent = false;
  /** False once the page turned out to be older or newer than the server. */
  private compatible = true;
  /** Events that occurred before `start`. */
  private earlyEvents: (() => void)[] = [];
  private listener: Listener = (event, value) => void this.earlyEvents.push(() => this.listener(event, value));

  constructor(private readonly url: string) {
    this.open();
    setInterval(() => this.check(), CHECK_MS);
  }

  start(listener: Listener): void {
    this.listener = listener;
    for (const emit of this.earlyEvents.splice(0)) emit();
  }

  send(message: ClientMessage): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    const text = JSON.stringify(message);
    // The server closes the connection after a larger one, and the page would send it again after each reconnection.
    if (text.length * MAX_UTF8 > MAX_REQUEST_BYTES && new TextEncoder().encode(text).length > MAX_REQUEST_BYTES)
      toast("A request is too large for the server.", "Names of frames and topics may be too long.");
    else this.socket.send(text);
  }

  sendBytes(data: ArrayBuffer): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(data);
  }

  private open(): void {
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    this.openTime = this.receiveTime = performance.now();
    socket.onopen = () => {
      this.openTime = this.receiveTime = performance.now();
      this.listener("connected", true);
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => {
      this.receiveTime = performance.now();
      this.setSilent(false);
      if (this.compatible) this.receive(event.data);
    };
    socket.onclose = () => this.reopen(socket);
    this.socket = socket;
  }

  /** Replaces a connection that has closed, or that is given up. */
  private reopen(socket: WebSocket): void {
    if (this.socket !== socket) return;
    const lasted = socket.readyState !== WebSocket.CONNECTING && performance.now() - this.openTime > STABLE_MS;
    if (lasted) this.reconnectDelay = FIRST_WAIT_MS;
    // Without a network, closing takes longer than opening another one.
    socket.onopen = socket.onmessage = socket.onclose = null;
    this.socket = null;
    socket.close();
    this.setSilent(false);
    this.listener("connected", false);
    if (this.compatible) setTimeout(() => this.open(), this.reconnectDelay);
    this.reconnectDelay = Math.min(this.reconnectDelay * 2, MAX_WAIT_MS);
  }

  private check(): void {
    const now = performance.now();
    const isLate = now - this.checked > LATE_CHECK_MS;
    this.checked = now;
    const { socket } = this;
    if (!socket || !this.compatible) return;
    if (isLate) this.receiveTime = now;
    const silence = now - this.receiveTime;
    if (socket.readyState === WebSocket.OPEN) {
      this.setSilent(silence > SILENT_MS);
      if (silence > RECONNECT_MS) this.reopen(socket);
    } else if (silence > OPEN_TIMEOUT_MS) this.reopen(socket);
  }

  private setSilent(silent: boolean): void {
    if (silent === this.isSilent) return;
    this.isSilent = silent;
    this.listener("silent", silent);
  }

  private receive(data: string | ArrayBuffer): void {
    try {
      if (typeof data !== "string") {
        this.listener("binary", decode(data));
        return;
      }
      const message = JSON.parse(data) as unknown;
      const hello = message as { type?: unknown; version?: unknown } | null;
      if (hello?.type === "hello" && !this.checkVersion(hello.version)) return;
      this.listener("text", checkServerMessage(message));
    } catch (error) {
      this.listener("invalid", error instanceof Error ? error.message : String(error));
    }
  }

  /** Whether the page and the server use the same protocol; reloads the page or explains why it cannot continue. */
  private checkVersion(version: unknown): boolean {
    const verdict = compareVersion(version, sessionStorage);
    if (verdict === "current") return true;
    this.compatible = false;
    this.socket?.close();
    if (verdict === "reload") location.reload();
    else
      showFatalError(
        "This page does not match its server",
        `The page uses protocol ${PROTOCOL_VERSION}, the server ${String(version).slice(0, 40)}. Clear the browser’s ` +
          "cache and reload the page. If you built coframe yourself, run “make page” and restart the server.",
      );
    return false;
  }
}

export function socketUrl(location: Location): string {
  const url = new URL("ws", location.href);
  url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  url.search = "";
  url.hash = "";
  return url.href;
}
