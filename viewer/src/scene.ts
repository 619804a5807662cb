/** The canvas: renderer, light, and a picture only when something changed. */

import * as THREE from "three";
import { Camera } from "./camera";
import { fatal } from "./fatal";
import type { Palette } from "./theme";

const FPS_WINDOW_MS = 1000;

export class Stage {
  readonly scene = new THREE.Scene();
  readonly camera: Camera;
  readonly renderer: THREE.WebGLRenderer;
  /** Whether pictures are made without a graphics card, which takes microseconds a point. */
  readonly software: boolean;
  width = 1;
  height = 1;
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
    this.software = isSoftware(this.renderer.getContext());
    this.camera = new Camera(canvas, () => this.invalidate());
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x8a8f96, 1.7), this.light, this.light.target);
    this.setPalette(palette);
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement as HTMLElement);
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.invalidate());
    this.resize();
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
    this.beforeDraw();
    const camera = this.camera.current;
    this.light.position.copy(camera.position).add(new THREE.Vector3(1, 1, 3));
    this.light.target.position.copy(this.camera.target);
    this.renderer.render(this.scene, camera);
    this.drawn.push(performance.now());
    this.afterDraw();
  }

  private resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement as HTMLElement;
    this.width = Math.max(1, clientWidth);
    this.height = Math.max(1, clientHeight);
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    this.renderer.setSize(this.width, this.height, false);
    this.camera.resize(this.width, this.height);
    this.invalidate();
  }
}

/** three.js asks for a canvas that can be seen through, which a browser without a graphics card blends pixel by pixel. */
function opaqueContext(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const context = canvas.getContext("webgl2", { alpha: false, antialias: true, powerPreference: "high-performance" });
  if (context) return context;
  throw fatal(
    "No 3D in this browser",
    "The page needs WebGL 2. Switch on hardware acceleration in the browser’s settings, or try another browser.",
  );
}

function isSoftware(context: WebGLRenderingContext | WebGL2RenderingContext): boolean {
  const info = context.getExtension("WEBGL_debug_renderer_info");
  const name = String(context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER));
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
