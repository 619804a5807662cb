/** A display's options, under RViz's own names, so that a file's values are used as they stand and saved unharmed. */

import type { Json, JsonObject } from "../protocol";

export type OptionSpec = { key: string; label?: string } & (
  | { kind: "number"; value: number; min?: number; max?: number; step?: number; unit?: string }
  | { kind: "flag"; value: boolean }
  | { kind: "colour"; value: string }
  | { kind: "choice"; value: string; choices: readonly string[] }
  | { kind: "frame"; value: string }
);

export const FIXED_FRAME = "<Fixed Frame>";

/** Reads values with the spec's own as default; whatever does not fit is as if it were not there. */
export class Options {
  constructor(
    readonly values: JsonObject,
    private readonly specs: readonly OptionSpec[],
  ) {}

  number(key: string): number {
    const value = Number(this.values[key]);
    const spec = this.spec(key, "number");
    if (this.values[key] === undefined || this.values[key] === null || !Number.isFinite(value)) return spec.value;
    return Math.max(spec.min ?? -Infinity, Math.min(spec.max ?? Infinity, value));
  }

  flag(key: string): boolean {
    const value = this.values[key];
    return typeof value === "boolean" ? value : this.spec(key, "flag").value;
  }

  choice(key: string): string {
    const { choices, value } = this.spec(key, "choice");
    const given = this.values[key];
    return typeof given === "string" && choices.includes(given) ? given : value;
  }

  text(key: string): string {
    const value = this.values[key];
    return typeof value === "string" ? value : this.spec(key, "frame").value;
  }

  /** As "#rrggbb". */
  colour(key: string): string {
    return cssColour(this.values[key]) ?? this.spec(key, "colour").value;
  }

  private spec<K extends OptionSpec["kind"]>(key: string, kind: K): Extract<OptionSpec, { kind: K }> {
    const found = this.specs.find((spec) => spec.key === key && spec.kind === kind);
    if (!found) throw new Error(`no ${kind} option ${key}`);
    return found as Extract<OptionSpec, { kind: K }>;
  }
}

/** RViz writes "255; 170; 0". */
export function cssColour(value: Json | undefined): string | null {
  const parts =
    typeof value === "string" ? value.split(/[;,]/).map(Number) : Array.isArray(value) ? value.map(Number) : [];
  if (parts.length < 3 || !parts.slice(0, 3).every((part) => part >= 0 && part <= 255)) return null;
  return `#${parts
    .slice(0, 3)
    .map((part) => Math.round(part).toString(16).padStart(2, "0"))
    .join("")}`;
}

export function rvizColour(css: string): string {
  return [1, 3, 5].map((at) => Number.parseInt(css.slice(at, at + 2), 16)).join("; ");
}
