/** The server's WebSocket, opened at once, and again whenever it closes. */

import { decode, ProtocolError, type ClientMessage, type ServerMessage } from "./protocol";
import type { Source, SourceEvents } from "./source";

const FIRST_WAIT_MS = 250;
const LONGEST_WAIT_MS = 4000;

type Listener = <K extends keyof SourceEvents>(event: K, value: SourceEvents[K]) => void;

export class SocketSource implements Source {
  readonly live = true;
  private socket: WebSocket | null = null;
  private wait = FIRST_WAIT_MS;
  /** What came before somebody listened. */
  private early: (() => void)[] = [];
  private listener: Listener = (event, value) => void this.early.push(() => this.listener(event, value));

  constructor(private readonly url: string) {
    this.open();
  }

  start(listener: Listener): void {
    this.listener = listener;
    for (const tell of this.early.splice(0)) tell();
  }

  send(message: ClientMessage): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  private open(): void {
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.wait = FIRST_WAIT_MS;
      this.listener("connected", true);
    };
    socket.onmessage = (event: MessageEvent<string | ArrayBuffer>) => this.receive(event.data);
    socket.onclose = () => {
      this.listener("connected", false);
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(this.wait * 2, LONGEST_WAIT_MS);
    };
    this.socket = socket;
  }

  private receive(data: string | ArrayBuffer): void {
    try {
      if (typeof data !== "string") this.listener("binary", decode(data));
      else {
        const message = JSON.parse(data) as ServerMessage;
        if (typeof message !== "object" || message === null || typeof message.type !== "string")
          throw new ProtocolError("a message without a type");
        this.listener("text", message);
      }
    } catch (error) {
      this.listener("broken", error instanceof Error ? error.message : String(error));
    }
  }
}

export function socketUrl(location: Location): string {
  const url = new URL("ws", location.href);
  url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
  url.search = "";
  url.hash = "";
  return url.href;
}
