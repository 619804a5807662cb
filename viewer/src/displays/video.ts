// SPDX-License-Identifier: Apache-2.0
/** Decodes h264 and h265 with the WebCodecs of the browser. */

const MISSING =
  "This browser cannot decode video: it needs WebCodecs, which browsers offer on this machine or with HTTPS only.";
const CODEC_BYTES = 32;

interface Packet {
  isKey: boolean;
  data: Uint8Array;
}

export class Video {
  private decoder: VideoDecoder | null = null;
  private codec = "";
  private count = 0;
  /** Packets are decoded in order, although the browser is asked asynchronously whether it knows the codec. */
  private queue: Promise<void> = Promise.resolve();

  constructor(
    private readonly onFrame: (frame: VideoFrame) => void,
    private readonly onProblem: (text: string) => void,
  ) {}

  /** Decodes the packets of a message. */
  feed(data: Uint8Array<ArrayBuffer>): void {
    this.queue = this.queue.then(() => this.decode(data)).catch((error: unknown) => this.fail(String(error)));
  }

  close(): void {
    if (this.decoder && this.decoder.state !== "closed") this.decoder.close();
    this.decoder = null;
  }

  private async decode(data: Uint8Array<ArrayBuffer>): Promise<void> {
    const { continues, codec, packets } = parse(data);
    if (typeof VideoDecoder === "undefined") {
      this.onProblem(MISSING);
      return;
    }
    if (!this.decoder || !continues) {
      if (!packets[0]?.isKey) return; // The next key frame begins the stream.
      await this.restart(codec || this.codec);
    }
    for (const { isKey, data: bytes } of packets)
      this.decoder?.decode(
        new EncodedVideoChunk({ type: isKey ? "key" : "delta", timestamp: this.count++, data: bytes }),
      );
  }

  private async restart(codec: string): Promise<void> {
    this.close();
    this.codec = codec;
    const config: VideoDecoderConfig = { codec, optimizeForLatency: true };
    const { supported } = await VideoDecoder.isConfigSupported(config).catch(() => ({ supported: false }));
    if (!supported) {
      this.onProblem(
        `This browser cannot decode the video codec ${codec}: use one with h264 and h265, such as Chrome.`,
      );
      return;
    }
    this.decoder = new VideoDecoder({
      output: (frame) => this.onFrame(frame),
      error: (error) => this.fail(error.message),
    });
    this.decoder.configure(config);
  }

  private fail(text: string): void {
    this.close();
    this.onProblem(`The browser cannot decode the video: ${text}`);
  }
}

function parse(data: Uint8Array<ArrayBuffer>): { continues: boolean; codec: string; packets: Packet[] } {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength);
  const codec = new TextDecoder().decode(data.subarray(4, 4 + CODEC_BYTES)).replace(/\0+$/, "");
  const packets: Packet[] = [];
  for (let at = 4 + CODEC_BYTES; at + 8 <= data.length;) {
    const size = view.getUint32(at + 4, true);
    packets.push({ isKey: view.getUint32(at, true) === 1, data: data.subarray(at + 8, at + 8 + size) });
    at += 8 + size;
  }
  return { continues: view.getUint32(0, true) === 1, codec, packets };
}
