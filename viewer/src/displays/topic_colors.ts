// SPDX-License-Identifier: Apache-2.0
/** A color for each topic, from the palette of Okabe and Ito, which color-blind users can tell apart. */

/** Without black and yellow, which vanish on one of the backgrounds. */
const COLORS = ["#e69f00", "#56b4e9", "#009e73", "#d55e00", "#cc79a7", "#0072b2"] as const;

const places = new Map<string, number>();

/** The color of a topic. It follows from the name, but the first topics of a page have different ones. */
export function topicColor(topic: string): string {
  let place = places.get(topic);
  if (place === undefined) {
    const taken = new Set(places.size < COLORS.length ? places.values() : []);
    place = hash(topic) % COLORS.length;
    while (taken.has(place)) place = (place + 1) % COLORS.length;
    places.set(topic, place);
  }
  return COLORS[place] as string;
}

/** FNV-1a. */
function hash(text: string): number {
  let value = 0x811c9dc5;
  for (const character of text) value = Math.imul(value ^ (character.codePointAt(0) as number), 0x01000193) >>> 0;
  return value;
}
