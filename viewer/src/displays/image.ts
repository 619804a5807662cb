// SPDX-License-Identifier: Apache-2.0
/** The Image display: camera images in a corner above the scene. */

import * as THREE from "three";
import { byId, h, setText, shorten } from "../util/dom";
import type { FramePoses } from "../scene/frame_poses";
import { ImageFormat, type DisplayMessage, type Image, type FrameUpdate } from "../protocol/messages";
import { MessageDisplay, type Context, type DisplayConfig } from "./display";
import type { OptionSpec } from "./options";

export const IMAGE_SPECS: readonly OptionSpec[] = [
  { key: "Width", kind: "number", value: 260, min: 60, max: 1600, step: 20, unit: "px" },
];

export class ImageDisplay extends MessageDisplay<Image> {
  private readonly canvas = h("canvas", { role: "img" });
  private readonly caption = h("figcaption");
  private readonly figure = h("figure", { hidden: true }, this.canvas, this.caption);
  /** The sequence number of the message on the canvas, or of the one being decoded. */
  private painted = -1;

  constructor(id: number, config: DisplayConfig, specs: readonly OptionSpec[], context: Context) {
    super(id, config, specs, context);
    this.canvas.setAttribute("aria-label", `Image of ${config.topic ?? config.name}`);
    byId("images").append(this.figure);
  }

  protected build(): THREE.Object3D {
    return new THREE.Group();
  }

  override restyle(): void {
    super.restyle();
    this.figure.style.width = `${this.options.number("Width")}px`;
    setText(this.caption, shorten(this.config.topic ?? this.config.name, 60));
  }

  override receive(message: DisplayMessage): void {
    super.receive(message);
    this.painted = -1;
  }

  override setPoses(framePoses: FramePoses, update: FrameUpdate): void {
    super.setPoses(framePoses, update);
    if ([...this.drawn.values()].some(({ object }) => object.visible)) return;
    this.figure.hidden = true;
    this.painted = -1;
  }

  protected override onPose(_object: THREE.Object3D, message: Image): void {
    if (message.sequence === this.painted) return;
    this.painted = message.sequence;
    this.note = message.step > 1 ? `1 of ${message.step} rows and columns` : "";
    void this.paint(message);
  }

  override clear(): void {
    super.clear();
    this.figure.hidden = true;
    this.painted = -1;
  }

  override dispose(): void {
    this.figure.remove();
    super.dispose();
  }

  protected override describe(message: Image): Record<string, unknown> {
    return { width: message.width, height: message.height, painted: !this.figure.hidden };
  }

  private async paint(message: Image): Promise<void> {
    const { canvas } = this;
    try {
      const image = await decodeImage(message);
      if (message.sequence !== this.painted) return; // A newer message has arrived.
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext("2d");
      if (image instanceof ImageData) context?.putImageData(image, 0, 0);
      else context?.drawImage(image, 0, 0);
      this.figure.hidden = false;
    } catch {
      this.figure.hidden = true;
      this.status = { state: "error", text: "The browser cannot decode the image." };
    }
  }
}

async function decodeImage({ format, width, height, data }: Image): Promise<ImageData | ImageBitmap> {
  if (format === ImageFormat.jpeg || format === ImageFormat.png) {
    const type = format === ImageFormat.jpeg ? "image/jpeg" : "image/png";
    return createImageBitmap(new Blob([data], { type }));
  }
  const pixels = new ImageData(width, height);
  const channels = format === ImageFormat.grey ? 1 : 3;
  for (let i = 0; i < width * height; i++)
    for (let k = 0; k < 4; k++)
      pixels.data[i * 4 + k] = k === 3 ? 255 : (data[i * channels + (channels === 1 ? 0 : k)] as number);
  return pixels;
}
