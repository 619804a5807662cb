// SPDX-License-Identifier: Apache-2.0
/** Formats numbers and times for display. Values in columns have a fixed number of digits. */

const MINUS = "−";

export function formatFixed(value: number, digits: number): string {
  if (!Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  const zero = Number(text) === 0;
  return zero ? (0).toFixed(digits) : text.replace("-", MINUS);
}

/** Formats a number for the clipboard: ASCII, 12 significant digits. */
export function formatPlain(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(12))) : "nan";
}

export function rate(hertz: number | null): string {
  if (hertz === null || !Number.isFinite(hertz)) return "";
  if (hertz >= 1000) return `${(hertz / 1000).toFixed(1)} kHz`;
  return `${hertz >= 99.95 ? hertz.toFixed(0) : hertz.toFixed(1)} Hz`;
}

export function duration(seconds: number | null): string {
  if (seconds === null || !Number.isFinite(seconds)) return "";
  const size = Math.abs(seconds);
  const sign = seconds < 0 ? MINUS : "";
  if (size < 0.9995) return `${sign}${Math.round(size * 1000)} ms`;
  if (size < 99.95) return `${sign}${size.toFixed(1)} s`;
  if (size < 5940) return `${sign}${Math.round(size / 60)} min`;
  return `${sign}${(size / 3600).toFixed(size < 36000 ? 1 : 0)} h`;
}

export function meters(value: number): string {
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size >= 10000) return `${formatFixed(value / 1000, 2)} km`;
  if (size >= 1 || size === 0) return `${formatFixed(value, 3)} m`;
  return `${formatFixed(value * 1000, 1)} mm`;
}

/** The local time of day; seconds for clocks that start near zero, such as those of simulators. */
export function stamp(origin: bigint, relative: number): string {
  if (!Number.isFinite(relative)) return "–";
  const ns = origin + BigInt(Math.round(relative));
  const milliseconds = Number(ns / 1_000_000n);
  if (milliseconds < 1e11) return `${(Number(ns) / 1e9).toFixed(3)} s`;
  const date = new Date(milliseconds);
  const two = (n: number): string => String(n).padStart(2, "0");
  const part = String(date.getMilliseconds()).padStart(3, "0");
  return `${two(date.getHours())}:${two(date.getMinutes())}:${two(date.getSeconds())}.${part}`;
}

/** Seconds since the start of the timeline. */
export function offset(ns: number): string {
  const seconds = ns / 1e9;
  if (!Number.isFinite(seconds)) return "–";
  if (Math.abs(seconds) < 60) return `${seconds.toFixed(2)} s`;
  const whole = Math.floor(Math.abs(seconds));
  const sign = seconds < 0 ? MINUS : "";
  const rest = String(whole % 60).padStart(2, "0");
  const minutes = Math.floor(whole / 60);
  if (minutes < 60) return `${sign}${minutes}:${rest}`;
  return `${sign}${Math.floor(minutes / 60)}:${String(minutes % 60).padStart(2, "0")}:${rest}`;
}

export function count(n: number): string {
  return String(n).replace(/\B(?=(\d{3})+$)/g, " ");
}

/** Sorts names without regard to case. Collation by locale would take the browser a noticeable time to load. */
export function sortNames(names: string[]): string[] {
  const keys = new Map(names.map((name) => [name, name.toLowerCase()]));
  const order = (a: string, b: string): number => (a < b ? -1 : a > b ? 1 : 0);
  return [...names].sort((a, b) => order(keys.get(a) as string, keys.get(b) as string) || order(a, b));
}
