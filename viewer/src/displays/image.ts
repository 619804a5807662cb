// SPDX-License-Identifier: Apache-2.0
/** The Image display: camera images in a corner above the scene. */

import * as THREE from "three";
import { byId, h, setText, shorten } from "../util/dom";
import type { FramePoses } from "../scene/frame_poses";
import { ImageFormat, type DisplayMessage, type Image, type FrameUpdate } from "../protocol/messages";
import { firstCamera, imageSize, isRectifiedTopic, projection } from "../util/camera_model";
import { CameraDisplay } from "./camera_info";
import { MessageDisplay, type Context, type Display, type DisplayConfig } from "./display";
import { ImageOverlay } from "./image_overlay";
import { cameraTopicOf, contentOf, isFrameAt } from "./projected_content";

const AUTO = "By topic";

/** Projections above an image are drawn at most this often. */
const PROJECTION_INTERVAL_MS = 100;

export class ImageDisplay extends MessageDisplay<Image, "Camera" | "Image"> {
  private readonly canvas = h("canvas", { role: "img" });
  private readonly caption = h("figcaption");
  private readonly overlay = new ImageOverlay();
  private readonly picture = h("div", { class: "picture" }, this.canvas);
  private readonly figure = h("figure", { hidden: true }, this.picture, this.caption);
  private projectedAt = 0;
  private problem = "";
  /** The sequence number of the message on the canvas, or of the one being decoded. */
  private painted = -1;

  constructor(id: number, config: DisplayConfig, context: Context) {
    super(id, config, context);
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
    this.projectedAt = 0;
    if (this.projects) this.picture.append(this.overlay.canvas);
    else this.overlay.canvas.remove();
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

  /** Whether the scene is projected into the image. */
  get projects(): boolean {
    return this.options.flag("Project");
  }

  /** The topic of the CameraInfo of this image, by the convention of image_transport; null if there is none. */
  get cameraTopic(): string | null {
    const topics = this.context.model.topics.filter(({ type }) => type === "sensor_msgs/msg/CameraInfo");
    return cameraTopicOf(
      this.config.topic ?? "",
      topics.map(({ topic }) => topic),
    );
  }

  /** Draws frames, clouds and shapes above the image, after the poses of all displays are set. */
  project(displays: readonly Display[], framePoses: FramePoses, axisLength: number): void {
    const now = performance.now();
    if (!this.projects || this.figure.hidden || now - this.projectedAt < PROJECTION_INTERVAL_MS) return;
    this.projectedAt = now;
    this.problem = this.tryToProject(displays, framePoses, axisLength);
    if (this.problem) this.overlay.clear();
    setText(this.caption, shorten(this.config.topic ?? this.config.name, 60) + (this.problem && `: ${this.problem}`));
  }

  private tryToProject(displays: readonly Display[], framePoses: FramePoses, axisLength: number): string {
    const topic = this.cameraTopic;
    if (!topic) return "no CameraInfo for this image";
    const cameras = displays.filter((display) => display instanceof CameraDisplay);
    const camera = cameras.find(({ config }) => config.topic === topic && config.enabled)?.newest();
    if (!camera) return `waiting for ${topic}`;
    const choice = this.options.choice("Rectified");
    const rectified = choice === AUTO ? isRectifiedTopic(this.config.topic ?? "") : choice === "Yes";
    const first = firstCamera(camera.intrinsics);
    const inTransforms = first !== null && isFrameAt(framePoses, camera.pose, ...first);
    const project = projection(camera.intrinsics, rectified, inTransforms);
    if (typeof project === "string") return project;
    const { canvas, options } = this;
    const shown = { width: canvas.clientWidth, height: canvas.clientHeight };
    const content = contentOf(displays, framePoses, this.context.model, {
      frames: options.flag("Project Frames"),
      clouds: options.flag("Project Clouds"),
      shapes: options.flag("Project Shapes"),
    });
    const { palette, distinct } = this.context;
    this.overlay.draw(
      project,
      camera.pose,
      imageSize(camera.intrinsics),
      shown,
      { ...content, axisLength },
      palette(),
      distinct(),
    );
    return "";
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
    return {
      width: message.width,
      height: message.height,
      painted: !this.figure.hidden,
      projected: this.overlay.projected,
    };
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
  const channels = format === ImageFormat.gray ? 1 : 3;
  for (let i = 0; i < width * height; i++)
    for (let k = 0; k < 4; k++)
      pixels.data[i * 4 + k] = k === 3 ? 255 : (data[i * channels + (channels === 1 ? 0 : k)] as number);
  return pixels;
}
