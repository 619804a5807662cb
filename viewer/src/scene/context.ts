// SPDX-License-Identifier: Apache-2.0
/** The canvas and its WebGL context: whoever asks first has that made, all others get the same one. */

import { fatal } from "../util/fatal";

export function pixelRatio(): number {
  return Math.min(2, devicePixelRatio);
}

/** As many pixels as the canvas has place for. It is made anew with each size that it is given, be it the same. */
export function drawingSize(canvas: HTMLCanvasElement): { width: number; height: number } {
  const pixels = (length: number): number => Math.floor(Math.max(1, length) * pixelRatio());
  return { width: pixels(canvas.clientWidth), height: pixels(canvas.clientHeight) };
}

/** three.js asks for a canvas that can be seen through, which a browser without a graphics card blends pixel by pixel. */
export function opaqueContext(canvas: HTMLCanvasElement): WebGL2RenderingContext {
  const context = canvas.getContext("webgl2", { alpha: false, antialias: true, powerPreference: "high-performance" });
  if (context) return context;
  throw fatal(
    "No 3D in this browser",
    "The page needs WebGL 2. Switch on hardware acceleration in the browser’s settings, or try another browser.",
  );
}
