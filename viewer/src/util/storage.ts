// SPDX-License-Identifier: Apache-2.0
/** Settings that persist between sessions, if the browser permits storage. */

const PREFIX = "coframe.";

export function loadStored<T>(key: string, fallback: T): T {
  try {
    const text = localStorage.getItem(PREFIX + key);
    if (text === null) return fallback;
    const value = JSON.parse(text) as unknown;
    return kindOf(value) === kindOf(fallback) ? (value as T) : fallback;
  } catch {
    return fallback;
  }
}

/** A stored list without the elements that are not valid, such as those of another version of the page. */
export function loadList<T>(key: string, isElement: (value: unknown) => value is T): T[] {
  return loadStored<unknown[]>(key, []).filter(isElement);
}

export function isString(value: unknown): value is string {
  return typeof value === "string";
}

/** The kind of a JSON value. */
export function kindOf(value: unknown): string {
  return Array.isArray(value) ? "array" : value === null ? "null" : typeof value;
}

export function storeValue(key: string, value: unknown): void {
  try {
    localStorage.setItem(PREFIX + key, JSON.stringify(value));
  } catch {
    // The storage is full or forbidden. The page works without it.
  }
}
