// SPDX-License-Identifier: Apache-2.0
/** The canvas: renderer, light, and a picture only when something changed. */

import * as THREE from "three";
import { Camera } from "./camera";
import { drawingSize, opaqueContext, pixelRatio } from "./context";
import type { Palette } from "../util/theme";

const FPS_WINDOW_MS = 1000;

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera: Camera;
  readonly renderer: THREE.WebGLRenderer;
  /** Whether pictures are made without a graphics card, which takes microseconds a point. */
  readonly software: boolean;
  width = 0;
  height = 0;
  private requested = false;
  private readonly drawn: number[] = [];
  private readonly light = new THREE.DirectionalLight(0xffffff, 1.6);

  constructor(
    readonly canvas: HTMLCanvasElement,
    palette: Palette,
    private readonly beforeDraw: () => void,
    private readonly afterDraw: () => void,
  ) {
    THREE.Object3D.DEFAULT_UP.set(0, 0, 1);
    this.renderer = new THREE.WebGLRenderer({ canvas, context: opaqueContext(canvas) });
    // Asking how each program came out waits for the graphics card.
    this.renderer.debug.checkShaderErrors = false;
    this.software = isSoftware(this.renderer.getContext());
    this.camera = new Camera(canvas, () => this.invalidate());
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f96, 1.7), this.light, this.light.target);
    this.setPalette(palette);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.invalidate());
    this.invalidate();
  }

  /** Has programs made for things that are about to be drawn, which goes on beside all else. */
  announce(things: THREE.Object3D[]): void {
    for (const thing of things) this.renderer.compile(thing, this.camera.current, this.scene);
  }

  get fps(): number {
    const now = performance.now();
    while (this.drawn.length && now - (this.drawn[0] as number) > FPS_WINDOW_MS) this.drawn.shift();
    return this.drawn.length;
  }

  setPalette(palette: Palette): void {
    this.scene.background = new THREE.Color(palette.background);
    this.invalidate();
  }

  /** Asks for a new picture; several askers get one. */
  invalidate(): void {
    if (this.requested) return;
    this.requested = true;
    requestAnimationFrame(() => {
      this.requested = false;
      this.draw();
    });
  }

  picture(): Promise<Blob> {
    this.draw();
    return new Promise((resolve, reject) =>
      this.canvas.toBlob((blob) => (blob ? resolve(blob) : reject(new Error("no picture"))), "image/png"),
    );
  }

  private draw(): void {
    if (this.width === 0) this.resize();
    this.beforeDraw();
    const camera = this.camera.current;
    this.light.position.copy(camera.position).add(new THREE.Vector3(1, 1, 3));
    this.light.target.position.copy(this.camera.target);
    this.renderer.render(this.scene, camera);
    this.drawn.push(performance.now());
    this.afterDraw();
  }

  private resize(): void {
    const { canvas, renderer } = this;
    this.width = Math.max(1, canvas.clientWidth);
    this.height = Math.max(1, canvas.clientHeight);
    const { width, height } = drawingSize(canvas);
    if (canvas.width !== width || canvas.height !== height || renderer.getPixelRatio() !== pixelRatio())
      renderer.setDrawingBufferSize(this.width, this.height, pixelRatio());
    this.camera.resize(this.width, this.height);
    this.invalidate();
  }
}

function isSoftware(context: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
