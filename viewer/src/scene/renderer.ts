// SPDX-License-Identifier: Apache-2.0
/** Renders the scene to the canvas, only when something has changed. */

import * as THREE from "three";
import { Camera } from "./camera";
import { drawingSize, opaqueContext, pixelRatio } from "./context";
import type { Palette } from "../util/theme";

/** An additional view, drawn into the part of the canvas below an element. */
export interface ExtraView {
  camera(): THREE.Camera;
  area: HTMLElement;
}

const FPS_WINDOW_MS = 1000;

export class SceneRenderer {
  readonly scene = new THREE.Scene();
  readonly camera: Camera;
  readonly webgl: THREE.WebGLRenderer;
  /** Whether the browser renders without a graphics card, which takes microseconds per point. */
  readonly software: boolean;
  /** The size of the main view in pixels. */
  width = 0;
  height = 0;
  private extraViews: readonly ExtraView[] = [];
  /** The element on the right that the main view leaves free. */
  private extraRoot: HTMLElement | null = null;
  private isScheduled = false;
  private isLost = false;
  private readonly lostListeners: (() => void)[] = [];
  private readonly drawTimes: number[] = [];
  private readonly light = new THREE.DirectionalLight(0xffffff, 1.6);

  constructor(
    readonly canvas: HTMLCanvasElement,
    palette: Palette,
    private readonly beforeDraw: () => void,
    private readonly afterDraw: () => void,
  ) {
    THREE.Object3D.DEFAULT_UP.set(0, 0, 1);
    this.webgl = new THREE.WebGLRenderer({ canvas, context: opaqueContext(canvas) });
    // Checking shader errors would wait for the graphics card.
    this.webgl.debug.checkShaderErrors = false;
    this.software = isSoftware(this.webgl.getContext());
    this.camera = new Camera(canvas, () => this.invalidate());
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f96, 1.7), this.light, this.light.target);
    this.setPalette(palette);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
    canvas.addEventListener("webglcontextlost", (event) => {
      event.preventDefault();
      this.setLost(true);
    });
    canvas.addEventListener("webglcontextrestored", () => this.setLost(false));
    this.invalidate();
  }

  /** Whether the browser has taken the graphics card away, and nothing can be drawn. */
  get isContextLost(): boolean {
    return this.isLost;
  }

  /** Calls the listener when the browser takes the graphics card away, and when it gives it back. */
  onLost(listener: () => void): void {
    this.lostListeners.push(listener);
  }

  private setLost(lost: boolean): void {
    this.isLost = lost;
    for (const listener of this.lostListeners) listener();
    this.invalidate();
  }

  /** Compiles the shaders of objects in advance, in the background. */
  compile(objects: THREE.Object3D[]): void {
    for (const object of objects) this.webgl.compile(object, this.camera.current, this.scene);
  }

  get fps(): number {
    const now = performance.now();
    while (this.drawTimes.length && now - (this.drawTimes[0] as number) > FPS_WINDOW_MS) this.drawTimes.shift();
    return this.drawTimes.length;
  }

  setPalette(palette: Palette): void {
    this.scene.background = new THREE.Color(palette.background);
    this.invalidate();
  }

  /** Draws additional views over an element at the right edge of the canvas, and the main one to the left of it. */
  setExtraViews(root: HTMLElement, views: readonly ExtraView[]): void {
    this.extraRoot = root;
    this.extraViews = views;
    const { webgl, canvas } = this;
    webgl.setScissorTest(views.length > 0);
    if (views.length === 0) webgl.setViewport(0, 0, canvas.clientWidth, canvas.clientHeight);
    this.resize();
  }

  /** Schedules a redraw; several calls before it cause only one. */
  invalidate(): void {
    if (this.isScheduled) return;
    this.isScheduled = true;
    requestAnimationFrame(() => {
      this.isScheduled = false;
      this.draw();
    });
  }

  /** Draws the scene and returns it as a PNG image. */
  image(): Promise<Blob> {
    this.draw();
    return new Promise((resolve, reject) =>
      this.canvas.toBlob(
        (blob) => (blob ? resolve(blob) : reject(new Error("The canvas cannot be read."))),
        "image/png",
      ),
    );
  }

  private draw(): void {
    if (this.width === 0) this.resize();
    this.beforeDraw();
    const camera = this.camera.current;
    this.light.position.copy(camera.position).add(new THREE.Vector3(1, 1, 3));
    this.light.target.position.copy(this.camera.target);
    if (this.extraViews.length > 0) this.setArea(0, 0, this.width, this.height);
    this.webgl.render(this.scene, camera);
    for (const view of this.extraViews) this.drawExtra(view);
    this.drawTimes.push(performance.now());
    this.afterDraw();
  }

  private drawExtra({ camera, area }: ExtraView): void {
    const [own, whole] = [area.getBoundingClientRect(), this.canvas.getBoundingClientRect()];
    this.setArea(own.left - whole.left, own.top - whole.top, own.width, own.height);
    this.webgl.render(this.scene, camera());
  }

  private setArea(x: number, y: number, width: number, height: number): void {
    const bottom = this.canvas.clientHeight - y - height;
    this.webgl.setViewport(x, bottom, width, height);
    this.webgl.setScissor(x, bottom, width, height);
  }

  private resize(): void {
    const { canvas, webgl } = this;
    this.width = Math.max(1, canvas.clientWidth - (this.extraRoot?.offsetWidth ?? 0));
    this.height = Math.max(1, canvas.clientHeight);
    const { width, height } = drawingSize(canvas);
    if (canvas.width !== width || canvas.height !== height || webgl.getPixelRatio() !== pixelRatio())
      webgl.setDrawingBufferSize(Math.max(1, canvas.clientWidth), this.height, pixelRatio());
    // Until this call, the renderer reports a viewport of zero height, from which points in meters get their sizes.
    else if (this.extraViews.length === 0) webgl.setViewport(0, 0, Math.max(1, canvas.clientWidth), this.height);
    this.camera.resize(this.width, this.height);
    this.invalidate();
  }
}

function isSoftware(context: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
