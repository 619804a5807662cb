// SPDX-License-Identifier: Apache-2.0
/** Converts between the fields of a form, which have paths, and the nested values of a message. */

import type { ControlledField, Json, JsonObject } from "../protocol/messages";

/** Reads what the user has typed into the field of a type; strings need no quotes. Throws an error if it is invalid. */
export function parseValue(type: string, text: string): Json {
  if (/^(string|wstring|str)(<\d+>)?$/.test(type)) return text;
  const value = JSON.parse(text.trim() || "null") as Json;
  if (/^(float|double|int|uint)/.test(type) && !/[[<]/.test(type) && typeof value !== "number")
    throw new Error(`${type} expected`);
  if (type.startsWith("bool") && !/[[<]/.test(type) && typeof value !== "boolean")
    throw new Error("true or false expected");
  return value;
}

/** The text of a value in a field: strings without quotes, everything else as JSON. */
export function formatValue({ type, value }: ControlledField): string {
  const parsed = JSON.parse(value) as Json;
  return typeof parsed === "string" && /string|str/.test(type) ? parsed : value;
}

/** Nests values by their paths: `linear.x` becomes `{linear: {x: ...}}`. */
export function nestValues(values: ReadonlyMap<string, Json>): JsonObject {
  const root: JsonObject = {};
  for (const [path, value] of values) {
    const steps = path.split(".");
    const last = steps.pop() as string;
    let at = root;
    for (const step of steps) at = (at[step] ??= {}) as JsonObject;
    at[last] = value;
  }
  return root;
}
