// SPDX-License-Identifier: Apache-2.0
/**
 * The options of displays. They have the names of RViz, so that the values of .rviz files are used and saved unchanged.
 * Nested options have paths, for example "Covariance/Position/Alpha".
 */

import type { Json, JsonObject } from "../protocol/messages";

/** An option. `needs` is the key of a flag; if it is off, the option has no effect and is hidden. */
export type OptionSpec = { key: string; label?: string; needs?: string } & (
  | { kind: "number"; value: number; min?: number; max?: number; step?: number; unit?: string }
  | { kind: "flag"; value: boolean }
  | { kind: "colour"; value: string }
  | { kind: "choice"; value: string; choices: readonly string[] }
  | { kind: "frame"; value: string }
);

export const FIXED_FRAME = "<Fixed Frame>";

/** Reads option values; missing and invalid values are replaced by the default. */
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

  /** Returns a colour as "#rrggbb". */
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
    if (!found) throw new Error(`No option ${key} of kind ${kind}.`);
    return found as Extract<OptionSpec, { kind: K }>;
  }
}

function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Converts a colour of RViz, such as "255; 170; 0", to "#rrggbb"; null if it is invalid. */
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
