// SPDX-License-Identifier: Apache-2.0
/** The Image display: camera images in a corner above the scene. */

import * as THREE from "three";
import { byId, h, setText, shorten } from "../util/dom";
import type { FramePoses } from "../scene/frame_poses";
import {
  ImageFormat,
  type DisplayMessage,
  type DisplayOptions,
  type Image,
  type FrameUpdate,
} from "../protocol/messages";
import { firstCamera, imageSize, isRectifiedTopic, projection } from "../util/camera_model";
import { CameraDisplay } from "./camera_info";
import { isRectangles } from "./boxes";
import { MessageDisplay, type Context, type Display, type DisplayConfig } from "./display";
import { ImageOverlay } from "./image_overlay";
import { ImageZoom } from "./image_zoom";
import { Video } from "./video";
import { RangeFilter, rangeOf, toColors, valueAt, type Range } from "./pixel_window";
import { cameraTopicOf, contentOf, isFrameAt } from "./projected_content";

const AUTO = "By topic";
/** The server sends images with more pixels thinned. */
const MAX_PIXELS = 1 << 25;

/** Projections above an image are drawn at most this often. */
const PROJECTION_INTERVAL_MS = 100;

export class ImageDisplay extends MessageDisplay<Image, "Camera" | "Image"> {
  private readonly canvas = h("canvas", { role: "img" });
  private readonly caption = h("figcaption");
  private readonly overlay = new ImageOverlay();
  /** The detected objects above the image. */
  private readonly marks = h("canvas", { class: "marks", aria: { hidden: "true" } });
  private readonly layers = h("div", { class: "layers" }, this.canvas, this.marks);
  private readonly picture = h("div", { class: "picture" }, this.layers);
  private readonly zoom = new ImageZoom(this.picture, this.layers, () => this.updateCaption());
  private readonly video = new Video(
    (frame) => this.paintFrame(frame),
    (text) => (this.status = { state: "error", text }),
  );
  private readonly ranges = new RangeFilter();
  private range: Range = [0, 1];
  private normalizedRange: Range = [0, 1];
  private shownImage: Image | null = null;
  /** The name of the image's frame; null if the tree does not contain it. */
  private frame: string | null = null;
  private rectangles = 0;
  /** What the pointer is at. */
  private pointedValue = "";
  /** Whether no other image is shown, so that this one has its full resolution. */
  alone = false;
  private readonly figure = h("figure", { hidden: true }, this.picture, this.caption);
  private projectionTime = 0;
  private problem = "";
  private zoomOption = 1;
  /** The sequence number of the message on the canvas, or of the one being decoded. */
  private paintedSequence = -1;

  constructor(id: number, config: DisplayConfig, context: Context) {
    super(id, config, context);
    this.canvas.setAttribute("aria-label", `Image of ${config.topic ?? config.name}`);
    byId("images").append(this.figure);
    this.picture.addEventListener("pointermove", (event) => this.point(event));
    this.picture.addEventListener("pointerleave", () => this.point(null));
  }

  override subscription(): DisplayOptions {
    return { ...super.subscription(), ...(this.alone ? { max_pixels: MAX_PIXELS } : {}) };
  }

  protected build(): THREE.Object3D {
    return new THREE.Group();
  }

  override restyle(): void {
    super.restyle();
    this.figure.style.width = `${this.options.number("Width")}px`;
    this.updateCaption();
    this.projectionTime = 0;
    if (this.shownImage?.values) void this.paint(this.shownImage);
    const zoom = this.options.number("Zoom Factor");
    if (zoom !== this.zoomOption) this.zoom.reset((this.zoomOption = zoom));
    this.canvas.style.opacity = "";
    if (!this.projects) {
      this.overlay.canvas.remove();
      return;
    }
    this.layers.append(this.overlay.canvas);
    // RViz draws the image behind the scene, above it, or both; the scene shines through the one above.
    const rendering = this.options.choice("Image Rendering");
    const alpha = this.options.number("Overlay Alpha");
    this.overlay.canvas.style.opacity = rendering === "background" ? "" : String(1 - alpha);
    if (rendering === "overlay") this.canvas.style.opacity = String(alpha);
  }

  override receive(message: DisplayMessage): void {
    super.receive(message);
    this.paintedSequence = -1;
    if (message.kind === "image" && message.format === ImageFormat.video) this.video.feed(message.data);
  }

  override setPoses(framePoses: FramePoses, update: FrameUpdate): void {
    super.setPoses(framePoses, update);
    const own = update.displays.find(({ id }) => id === this.id);
    this.frame = own && own.frame >= 0 ? this.context.model.forest.name(own.frame) : null;
    if ([...this.drawnMessages.values()].some(({ object }) => object.visible)) return;
    this.figure.hidden = true;
    this.paintedSequence = -1;
  }

  protected override onPose(_object: THREE.Object3D, message: Image): void {
    if (message.sequence === this.paintedSequence) return;
    this.paintedSequence = message.sequence;
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

  /**
   * Draws frames, clouds and shapes above the image, after the poses of all displays are set.
   *
   * @param displays All displays, among them that of the camera.
   * @param visible Those that are drawn.
   */
  project(displays: readonly Display[], visible: readonly Display[], framePoses: FramePoses, axisLength: number): void {
    const now = performance.now();
    if (!this.projects || this.figure.hidden || now - this.projectionTime < PROJECTION_INTERVAL_MS) return;
    this.projectionTime = now;
    this.problem = this.tryToProject(displays, visible, framePoses, axisLength);
    if (this.problem) this.overlay.clear();
    this.updateCaption();
  }

  /** Draws the detected objects of this image's frame, after the poses of all displays are set. */
  markDetections(displays: readonly Display[]): void {
    const { marks, canvas, shownImage: shown } = this;
    this.rectangles = 0;
    const found = this.options.flag("Project Detections")
      ? displays.filter(isRectangles).filter(({ config }) => config.enabled)
      : [];
    const fitting = found.filter((display) => this.frame === null || display.newest()?.frame === this.frame);
    if (!shown || this.figure.hidden || fitting.length === 0) {
      if (marks.width > 0) marks.width = 0;
      return;
    }
    [marks.width, marks.height] = [canvas.width, canvas.height];
    const context = marks.getContext("2d");
    if (!context) return;
    context.scale(1 / shown.step, 1 / shown.step);
    const pixel = (canvas.width * shown.step) / Math.max(1, canvas.clientWidth * this.zoom.factor);
    for (const display of fitting) this.rectangles += display.draw(context, pixel);
  }

  /** Shows the pixel under the pointer, in pixels of the full image. */
  private point(event: PointerEvent | null): void {
    const { canvas, shownImage: shown } = this;
    const bounds = canvas.getBoundingClientRect();
    const [x, y] = event
      ? [event.clientX - bounds.left, event.clientY - bounds.top].map((at, k) =>
          Math.floor((at / (k ? bounds.height : bounds.width)) * (k ? canvas.height : canvas.width)),
        )
      : [-1, -1];
    const inside =
      shown && x !== undefined && y !== undefined && x >= 0 && y >= 0 && x < canvas.width && y < canvas.height;
    this.pointedValue = inside
      ? `(${x * shown.step}, ${y * shown.step}): ${valueAt(shown, x, y) ?? this.pixelColor(x, y)}`
      : "";
    this.updateCaption();
  }

  /** The color of a pixel that the browser has decoded. */
  private pixelColor(x: number, y: number): string {
    const pixel = this.canvas.getContext("2d")?.getImageData(x, y, 1, 1).data;
    return pixel ? pixel.slice(0, 3).join(" ") : "";
  }

  private updateCaption(): void {
    const zoomed = this.zoom.factor > 1 ? `${Math.round(this.zoom.factor * 100)} %` : "";
    const range = this.shownImage?.values ? `${formatShort(this.range[0])} to ${formatShort(this.range[1])}` : "";
    const name = shorten(this.config.topic ?? this.config.name, 60) + (this.problem && `: ${this.problem}`);
    setText(this.caption, [name, this.pointedValue || range, zoomed].filter(Boolean).join(" · "));
  }

  private tryToProject(
    displays: readonly Display[],
    visible: readonly Display[],
    framePoses: FramePoses,
    axisLength: number,
  ): string {
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
    const content = contentOf(visible, framePoses, this.context.model, {
      frames: options.flag("Project Frames") && displays.some(isTf) === visible.some(isTf),
      clouds: options.flag("Project Clouds"),
      shapes: options.flag("Project Shapes"),
    });
    const far = options.number("Far Plane Distance");
    const { palette, distinct } = this.context;
    this.overlay.draw(
      (x, y, z) => (z > far ? null : project(x, y, z)),
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
    this.paintedSequence = -1;
  }

  override dispose(): void {
    this.video.close();
    this.figure.remove();
    super.dispose();
  }

  protected override describe(message: Image): Record<string, unknown> {
    return {
      width: message.width,
      height: message.height,
      painted: !this.figure.hidden,
      step: message.step,
      range: message.values ? this.range : null,
      value: valueAt(message, message.width >> 1, message.height >> 1),
      rectangles: this.rectangles,
      zoom: this.zoom.factor,
      projected: this.overlay.projected,
    };
  }

  private async paint(message: Image): Promise<void> {
    const { canvas } = this;
    if (message.format === ImageFormat.video) {
      this.shownImage = message;
      return;
    }
    try {
      const image = await this.decodeImage(message);
      if (message.sequence !== this.paintedSequence) return; // A newer message has arrived.
      this.shownImage = message;
      [canvas.width, canvas.height] = [image.width, image.height];
      const context = canvas.getContext("2d");
      if (image instanceof ImageData) context?.putImageData(image, 0, 0);
      else context?.drawImage(image, 0, 0);
      this.figure.hidden = false;
      this.updateCaption();
    } catch {
      this.figure.hidden = true;
      this.status = { state: "error", text: "The browser cannot decode the image." };
    }
  }

  /** Paints a frame of a video. */
  private paintFrame(frame: VideoFrame): void {
    const { canvas } = this;
    if (canvas.width !== frame.displayWidth || canvas.height !== frame.displayHeight)
      [canvas.width, canvas.height] = [frame.displayWidth, frame.displayHeight];
    canvas.getContext("2d")?.drawImage(frame, 0, 0);
    frame.close();
    if (this.paintedSequence >= 0) this.figure.hidden = false;
    this.updateCaption();
  }

  private async decodeImage(message: Image): Promise<ImageData | ImageBitmap> {
    const { format, data, values } = message;
    if (format === ImageFormat.jpeg || format === ImageFormat.png) {
      const type = format === ImageFormat.jpeg ? "image/jpeg" : "image/png";
      return createImageBitmap(new Blob([data], { type }));
    }
    const { options } = this;
    if (values && message !== this.shownImage)
      this.normalizedRange = this.ranges.addRange(rangeOf(values), options.number("Median window"));
    const given: Range = [options.number("Min Value"), options.number("Max Value")];
    this.range = options.flag("Normalize Range") ? this.normalizedRange : given;
    return toColors(message, this.range);
  }
}

function isTf({ kind }: Display): boolean {
  return kind === "TF";
}

function formatShort(value: number): string {
  return String(Number(value.toPrecision(4)));
}
