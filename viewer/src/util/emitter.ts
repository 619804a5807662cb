// SPDX-License-Identifier: Apache-2.0
/** Who is interested in what: a typed list of listeners for each event. */

export class Emitter<Events extends object> {
  private readonly listeners = new Map<keyof Events, Set<(value: never) => void>>();

  on<K extends keyof Events>(event: K, listener: (value: Events[K]) => void): void {
    const known = this.listeners.get(event) ?? new Set();
    known.add(listener as (value: never) => void);
    this.listeners.set(event, known);
  }

  emit<K extends keyof Events>(event: K, value: Events[K]): void {
    for (const listener of this.listeners.get(event) ?? []) (listener as (value: Events[K]) => void)(value);
  }
}
