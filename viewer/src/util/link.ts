// SPDX-License-Identifier: Apache-2.0
/** What a link to the page contains: the part of the address after `#`, as a query. */

export function linked(key: string): string[] {
  return new URLSearchParams(location.hash.slice(1)).getAll(key);
}

/** Replaces the values of a key in the address of the page. */
export function link(key: string, values: readonly string[]): void {
  const parameters = new URLSearchParams(location.hash.slice(1));
  parameters.delete(key);
  for (const value of values) parameters.append(key, value);
  const hash = parameters.toString();
  // A replay in a cell of a notebook has no address of its own.
  if (location.protocol === "about:") return;
  history.replaceState(null, "", hash ? `#${hash}` : location.pathname + location.search);
}
