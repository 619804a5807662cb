// SPDX-License-Identifier: Apache-2.0
/** The WebGL context of the canvas. The first call creates it; later calls return the same one. */

import { showFatalError } from "../util/fatal";

export function pixelRatio(): number {
  return Math.min(2, devicePixelRatio);
}

/** The size of the drawing buffer in pixels. Assigning it to a canvas clears the canvas, even if the size is the same. */
export function drawingSize(canvas: HTMLCanvasElement): { width: number; height: number } {
  const pixels = (length: number): number => Math.floor(Math.max(1, length) * pixelRatio());
  return { width: pixels(canvas.clientWidth), height: pixels(canvas.clientHeight) };
}

/** An opaque context. three.js would request a transparent one, which is slow to blend without a graphics card. */
export function opaqueContext(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const context = canvas.getContext("webgl2", { alpha: false, antialias: true, powerPreference: "high-performance" });
  if (context) return context;
  throw showFatalError(
    "This browser cannot draw 3D graphics",
    "The page needs WebGL 2. Enable hardware acceleration in the browser’s settings, or use another browser.",
  );
}
