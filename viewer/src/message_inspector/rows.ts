// SPDX-License-Identifier: Apache-2.0
/** Which rows of an inspected message are visible. */

import type { InspectedField } from "../protocol/messages";

/** The path of a row for its state; rows such as "12 more" have no path of their own. */
export function keyOf(field: InspectedField, i: number): string {
  return field.path || `#${i}`;
}

export function hasChildren(fields: readonly InspectedField[], i: number): boolean {
  return (fields[i + 1]?.depth ?? -1) > (fields[i] as InspectedField).depth;
}

/** A sequence with a value of its own, such as an array of numbers, is closed until the user opens it. */
export function isOpen(field: InspectedField, key: string, toggledFields: ReadonlySet<string>): boolean {
  return (field.text === "") !== toggledFields.has(key);
}

/** The indices of the rows whose ancestors are all open. */
export function visibleRows(fields: readonly InspectedField[], toggledFields: ReadonlySet<string>): number[] {
  const visible: number[] = [];
  let closedAt = Infinity;
  fields.forEach((field, i) => {
    if (field.depth > closedAt) return;
    closedAt = Infinity;
    visible.push(i);
    if (hasChildren(fields, i) && !isOpen(field, keyOf(field, i), toggledFields)) closedAt = field.depth;
  });
  return visible;
}
