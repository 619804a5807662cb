// SPDX-License-Identifier: Apache-2.0
/** The colors of values from 0 to 1, as the shader of clouds computes them. */

type Color = [red: number, green: number, blue: number];

/** Turbo (polynomial fit by A. Mikhailov): coefficients of 1, t, ..., t^5. */
const TURBO: readonly (readonly number[])[] = [
  [0.13572138, 4.6153926, -42.66032258, 132.13108234, -152.94239396, 59.28637943],
  [0.09140261, 2.19418839, 4.84296658, -14.18503333, 4.27729857, 2.82956604],
  [0.1066733, 12.64194608, -60.58204836, 110.36276771, -89.90310912, 27.34824973],
];
const BLUE: Color = [0.13, 0.35, 0.72];
const GRAY: Color = [0.62, 0.62, 0.6];
const YELLOW: Color = [0.99, 0.91, 0.2];

export function scaleColor(value: number, useDistinctColors: boolean): string {
  return css(rgbOf(value, useDistinctColors));
}

export function rgbOf(value: number, useDistinctColors: boolean): Color {
  const t = Math.max(0, Math.min(1, value));
  if (!useDistinctColors) return TURBO.map((c) => c.reduceRight((sum, part) => sum * t + part, 0)) as Color;
  return interpolateColor(interpolateColor(BLUE, GRAY, smoothstep(0, 0.55, t)), YELLOW, smoothstep(0.45, 1, t));
}

export function css(color: readonly number[]): string {
  return `rgb(${color.map((part) => Math.round(Math.max(0, Math.min(1, part)) * 255)).join(" ")})`;
}

function interpolateColor(a: Color, b: Color, part: number): Color {
  return a.map((value, k) => value + ((b[k] as number) - value) * part) as Color;
}

function smoothstep(from: number, to: number, value: number): number {
  const t = Math.max(0, Math.min(1, (value - from) / (to - from)));
  return t * t * (3 - 2 * t);
}
