// SPDX-License-Identifier: Apache-2.0
/**
 * The options of displays. They have the names of RViz, so that the values of .rviz files are used and saved unchanged.
 * Nested options have paths, for example "Covariance/Position/Alpha".
 */

import type { DisplayClass, OptionKey, OptionSpec } from "../generated/displays";
import type { DisplayOptions, Json, JsonObject } from "../protocol/messages";

type Spec<K extends OptionSpec["kind"]> = Extract<OptionSpec, { kind: K }>;

/** Reads option values; missing and invalid values are replaced by the default. */
export class Options<C extends DisplayClass = DisplayClass> {
  constructor(
    readonly values: JsonObject,
    private readonly specs: readonly OptionSpec[],
  ) {}

  number(key: OptionKey<C, "number">): number {
    return this.numberOf(this.spec(key, "number"));
  }

  flag(key: OptionKey<C, "flag">): boolean {
    return this.flagOf(this.spec(key, "flag"));
  }

  choice(key: OptionKey<C, "choice">): string {
    return this.choiceOf(this.spec(key, "choice"));
  }

  text(key: OptionKey<C, "text">): string {
    return this.textOf(this.spec(key, "text"));
  }

  /** Returns a color as "#rrggbb". */
  color(key: OptionKey<C, "color">): string {
    return this.colorOf(this.spec(key, "color"));
  }

  /** Whether the user or a file has chosen an option, so that it is not the default. */
  isSet(key: OptionKey<C, OptionSpec["kind"]>): boolean {
    const value = this.value(key);
    return value !== undefined && value !== null && value !== "";
  }

  numberOf(spec: Spec<"number">): number {
    const given = this.value(spec.key);
    const value = Number(given);
    if (given === undefined || given === null || !Number.isFinite(value)) return spec.value;
    return Math.max(spec.min, Math.min(spec.max, value));
  }

  flagOf(spec: Spec<"flag">): boolean {
    const value = this.value(spec.key);
    return typeof value === "boolean" ? value : spec.value;
  }

  choiceOf(spec: Spec<"choice">): string {
    const given = this.value(spec.key);
    return typeof given === "string" && spec.choices.includes(given) ? given : spec.value;
  }

  textOf(spec: Spec<"text">): string {
    const value = this.value(spec.key);
    return typeof value === "string" ? value : spec.value;
  }

  colorOf(spec: Spec<"color">): string {
    return cssColor(this.value(spec.key)) ?? spec.value;
  }

  /** Whether an option has an effect: all conditions that it needs are met, and the options in them have an effect. */
  hasEffect(spec: OptionSpec): boolean {
    return spec.needs === undefined || spec.needs.split(" & ").every((condition) => this.isMet(condition));
  }

  /** Whether a condition is met: "Key" is a flag that is on, "!Key" one that is off, "Key=A|B" a choice. */
  private isMet(condition: string): boolean {
    const [key, choices] = condition.replace(/^!/, "").split("=") as [string, string | undefined];
    const spec = this.specs.find((one) => one.key === key);
    if (spec?.kind === "choice") return (choices ?? "").split("|").includes(this.choiceOf(spec));
    return spec?.kind === "flag" && this.flagOf(spec) !== condition.startsWith("!");
  }

  /** The fields of the subscription that the options set. */
  subscription(): DisplayOptions {
    const fields = this.specs.flatMap((spec) => (spec.sets ? [[spec.sets, this.sent(spec)]] : []));
    return Object.fromEntries(fields) as DisplayOptions;
  }

  set(key: string, value: Json): void {
    const path = key.split("/");
    const last = path.pop() as string;
    let at = this.values;
    for (const part of path) {
      const inner = at[part];
      if (isObject(inner)) at = inner;
      else at = at[part] = inner === undefined || inner === null ? {} : { Value: inner };
    }
    const earlier = at[last];
    if (isObject(earlier)) earlier["Value"] = value;
    else at[last] = value;
  }

  private sent(spec: OptionSpec): Json {
    switch (spec.kind) {
      case "number": {
        const value = this.numberOf(spec);
        return Number.isInteger(spec.step) ? Math.round(value) : value;
      }
      case "flag":
        return this.flagOf(spec);
      case "choice": {
        const value = this.choiceOf(spec);
        return spec.meanings?.[spec.choices.indexOf(value)] ?? value;
      }
      case "text":
        return this.textOf(spec);
      case "color":
        return this.colorOf(spec);
    }
  }

  /** RViz writes an option that has options of its own as an object, with its value as "Value". */
  private value(key: string): Json | undefined {
    let at: Json | undefined = this.values;
    for (const [k, part] of key.split("/").entries()) {
      if (!isObject(at)) return k > 0 && part === "Value" ? at : undefined;
      at = at[part];
    }
    return isObject(at) ? at["Value"] : at;
  }

  private spec<K extends OptionSpec["kind"]>(key: string, kind: K): Spec<K> {
    const found = this.specs.find((spec) => spec.key === key && spec.kind === kind);
    if (!found) throw new Error(`No option ${key} of kind ${kind}.`);
    return found as Spec<K>;
  }
}

export function isObject(value: Json | undefined): value is JsonObject {
  return typeof value === "object" && value !== null && !Array.isArray(value);
}

/** Converts a color of RViz, such as "255; 170; 0", to "#rrggbb"; null if it is invalid. */
export function cssColor(value: Json | undefined): string | null {
  const parts =
    typeof value === "string" ? value.split(/[;,]/).map(Number) : Array.isArray(value) ? value.map(Number) : [];
  if (parts.length < 3 || !parts.slice(0, 3).every((part) => part >= 0 && part <= 255)) return null;
  return `#${parts
    .slice(0, 3)
    .map((part) => Math.round(part).toString(16).padStart(2, "0"))
    .join("")}`;
}

export function rvizColor(css: string): string {
  return [1, 3, 5].map((at) => Number.parseInt(css.slice(at, at + 2), 16)).join("; ");
}
