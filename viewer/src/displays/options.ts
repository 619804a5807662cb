// SPDX-License-Identifier: Apache-2.0
/**
 * A display's options, under RViz's own names, so that a file's values are used as they stand and saved unharmed.
 * Those that stand inside of others have a path: "Covariance/Position/Alpha".
 */

import type { Json, JsonObject } from "../protocol/messages";

/** `needs` names a flag without which it has no effect, and is not shown. */
export type OptionSpec = { key: string; label?: string; needs?: string } & (
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
    const given = this.value(key);
    const value = Number(given);
    const spec = this.spec(key, "number");
    if (given === undefined || given === null || !Number.isFinite(value)) return spec.value;
    return Math.max(spec.min ?? -Infinity, Math.min(spec.max ?? Infinity, value));
  }

  flag(key: string): boolean {
    const value = this.value(key);
    return typeof value === "boolean" ? value : this.spec(key, "flag").value;
  }

  choice(key: string): string {
    const { choices, value } = this.spec(key, "choice");
    const given = this.value(key);
    return typeof given === "string" && choices.includes(given) ? given : value;
  }

  text(key: string): string {
    const value = this.value(key);
    return typeof value === "string" ? value : this.spec(key, "frame").value;
  }

  /** As "#rrggbb". */
  colour(key: string): string {
    return cssColour(this.value(key)) ?? this.spec(key, "colour").value;
  }

  set(key: string, value: Json): void {
    const path = key.split("/");
    const last = path.pop() as string;
    let at = this.values;
    for (const part of path) {
      const inner = at[part];
      at = at[part] = isObject(inner) ? inner : {};
    }
    at[last] = value;
  }

  private value(key: string): Json | undefined {
    let at: Json | undefined = this.values;
    for (const part of key.split("/")) at = isObject(at) ? at[part] : undefined;
    return at;
  }

  private spec<K extends OptionSpec["kind"]>(key: string, kind: K): Extract<OptionSpec, { kind: K }> {
    const found = this.specs.find((spec) => spec.key === key && spec.kind === kind);
    if (!found) throw new Error(`no ${kind} option ${key}`);
    return found as Extract<OptionSpec, { kind: K }>;
  }
}

function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
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
