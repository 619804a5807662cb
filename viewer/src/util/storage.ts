// SPDX-License-Identifier: Apache-2.0
/** Settings that persist between sessions, if the browser permits storage. */

const PREFIX = "coframe.";

export function loadStored<T>(key: string, fallback: T): T {
  try {
    const text = localStorage.getItem(PREFIX + key);
    if (text === null) return fallback;
    const value = JSON.parse(text) as unknown;
    return typeof value === typeof fallback ? (value as T) : fallback;
  } catch {
    return fallback;
  }
}

export function storeValue(key: string, value: unknown): void {
  try {
    localStorage.setItem(PREFIX + key, JSON.stringify(value));
  } catch {
    // The storage is full or forbidden. The page works without it.
  }
}
