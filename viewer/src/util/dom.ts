// SPDX-License-Identifier: Apache-2.0
/** Creates HTML elements. Texts become text nodes only, so that no name from the network is interpreted as HTML. */

type Child = Node | string | null | undefined;

interface Properties {
  class?: string;
  id?: string;
  title?: string;
  type?: string;
  role?: string;
  for?: string;
  value?: string;
  disabled?: boolean;
  hidden?: boolean;
  checked?: boolean;
  min?: string;
  max?: string;
  step?: string;
  placeholder?: string;
  maxlength?: string;
  tabindex?: string;
  accept?: string;
  list?: string;
  autocomplete?: string;
  aria?: Record<string, string>;
  data?: Record<string, string>;
  on?: { [K in keyof HTMLElementEventMap]?: (event: HTMLElementEventMap[K]) => void };
}

export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  properties: Properties = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(properties)) {
    if (key === "aria") for (const [k, v] of Object.entries(value)) element.setAttribute(`aria-${k}`, String(v));
    else if (key === "data") for (const [k, v] of Object.entries(value)) element.setAttribute(`data-${k}`, String(v));
    else if (key === "on")
      for (const [k, v] of Object.entries(value)) element.addEventListener(k, v as unknown as EventListener);
    else if (typeof value === "boolean") element.toggleAttribute(key, value);
    else if (value !== undefined) element.setAttribute(key, String(value));
  }
  for (const child of children) if (child !== null && child !== undefined) element.append(child);
  return element;
}

export function byId(id: string): HTMLElement {
  const element = document.getElementById(id);
  if (!element) throw new Error(`The page has no element #${id}.`);
  return element;
}

/** Sets the text if it differs. Most texts of a panel rarely change, and setting them causes a layout. */
export function setText(element: Element, text: string): void {
  if (element.textContent !== text) element.textContent = text;
}

const ICONS = {
  play: "M5 3.2v9.6L12.8 8z",
  pause: "M4.5 3h2.4v10H4.5zM9.1 3h2.4v10H9.1z",
  back: "M11.5 3.2v9.6L5.6 8zM3.6 3.2h1.7v9.6H3.6z",
  forward: "M4.5 3.2v9.6L10.4 8zM10.7 3.2h1.7v9.6h-1.7z",
  loop: "M4 5h6.2V3l3 3-3 3V7H5.6v2H4zM12 11H5.8v2l-3-3 3-3v2h4.6V7H12z",
  chevron: "M6 3.8 10.2 8 6 12.2l-1-1L8.2 8 5 4.8z",
  close: "m4.2 3.2 3.8 3.8 3.8-3.8 1 1L9 8l3.8 3.8-1 1L8 9l-3.8 3.8-1-1L7 8 3.2 4.2z",
  menu: "M2.5 4h11v1.5h-11zM2.5 7.25h11v1.5h-11zM2.5 10.5h11V12h-11z",
  select:
    "M2 2h3.5v1.4H3.4v2.1H2zM7 2h2v1.4H7zM10.5 2H14v3.5h-1.4V3.4h-2.1zM2 7h1.4v2H2zM12.6 7H14v2h-1.4zM2 10.5h1.4v2.1h2.1V14H2zM7 12.6h2V14H7zM12.6 10.5H14V14h-3.5v-1.4h2.1z",
  focus:
    "M8 2.6c3.2 0 5.7 2.2 7 5.4-1.3 3.2-3.8 5.4-7 5.4S2.3 11.2 1 8c1.3-3.2 3.8-5.4 7-5.4zm0 1.5C5.7 4.1 3.8 5.6 2.6 8c1.2 2.4 3.1 3.9 5.4 3.9s4.2-1.5 5.4-3.9C12.2 5.6 10.3 4.1 8 4.1zM8 6.2a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6z",
  camera:
    "M5.6 3h4.8l1 1.5H14v8.5H2V4.5h2.6zM8 6a2.5 2.5 0 1 0 0 5 2.5 2.5 0 0 0 0-5zm0 1.3a1.2 1.2 0 1 1 0 2.4 1.2 1.2 0 0 1 0-2.4z",
  folder: "M1.5 3h5l1.5 1.7h6.5v8.3h-13zM3 6.2v5.3h10V6.2z",
  plus: "M7.2 3h1.6v4.2H13v1.6H8.8V13H7.2V8.8H3V7.2h4.2z",
  copy: "M5.5 2.5h7v8.5h-7zM7 4v5.5h4V4zM3.5 5v8h7v1.5H2V5z",
  ruler:
    "M1.7 10.6 10.6 1.7l3.7 3.7-8.9 8.9zm2.1 0 1.6 1.6 6.8-6.8-.7-.7-1.2 1.2-.9-.9 1.2-1.2-.1-.1-1.9 1.9.9.9-.7.7-.9-.9-1 1 1.3 1.3-.8.8-1.3-1.3z",
  fit: "M2.5 2.5h4V4H4v2.5H2.5zM9.5 2.5h4v4H12V4H9.5zM2.5 9.5H4V12h2.5v1.5h-4zM12 9.5h1.5v4h-4V12H12zM6.5 6.5h3v3h-3z",
  sun: "M8 4.8a3.2 3.2 0 1 1 0 6.4 3.2 3.2 0 0 1 0-6.4zM7.3 1h1.4v2.2H7.3zM7.3 12.8h1.4V15H7.3zM1 7.3h2.2v1.4H1zM12.8 7.3H15v1.4h-2.2zM3.5 2.5l1.6 1.6-1 1L2.5 3.5zM12.5 2.5l1 1-1.6 1.6-1-1zM4.1 10.9l1 1-1.6 1.6-1-1zM11.9 10.9l1.6 1.6-1 1-1.6-1.6z",
  help: "M8 1.5a6.5 6.5 0 1 1 0 13 6.5 6.5 0 0 1 0-13zm0 1.4a5.1 5.1 0 1 0 0 10.2A5.1 5.1 0 0 0 8 2.9zM7.2 10.4h1.6V12H7.2zM8 4.2c1.5 0 2.6.9 2.6 2.3 0 1.7-1.8 1.8-1.8 3H7.3c0-2 1.7-2 1.7-3 0-.5-.4-.9-1-.9s-1 .4-1.1 1.1l-1.5-.2C5.6 5 6.6 4.2 8 4.2z",
  download: "M7.2 2h1.6v6.2l2.3-2.3 1.1 1.1L8 11.2 3.8 7l1.1-1.1 2.3 2.3zM2.5 12.5h11V14h-11z",
  target:
    "M7.3 1h1.4v2.1A5 5 0 0 1 12.9 7.3H15v1.4h-2.1a5 5 0 0 1-4.2 4.2V15H7.3v-2.1a5 5 0 0 1-4.2-4.2H1V7.3h2.1a5 5 0 0 1 4.2-4.2zM8 4.5a3.5 3.5 0 1 0 0 7 3.5 3.5 0 0 0 0-7zM8 6.7a1.3 1.3 0 1 1 0 2.6 1.3 1.3 0 0 1 0-2.6z",
  chart: "M2.5 2H4v10.5h10V14H2.5zM5.2 10.2 8 6l2.3 2.4 2.6-4 1.2.8-3.6 5.6-2.4-2.4-1.7 2.6z",
  minus: "M3 7.2h10v1.6H3z",
  link: "M6.7 9.3 9.3 6.7M6.2 4.2l1-1a3 3 0 0 1 4.3 0l1.3 1.3a3 3 0 0 1 0 4.3l-1 1-1.1-1.1 1-1a1.5 1.5 0 0 0 0-2.1l-1.3-1.3a1.5 1.5 0 0 0-2.1 0l-1 1zm3.6 7.6-1 1a3 3 0 0 1-4.3 0l-1.3-1.3a3 3 0 0 1 0-4.3l1-1 1.1 1.1-1 1a1.5 1.5 0 0 0 0 2.1l1.3 1.3a1.5 1.5 0 0 0 2.1 0l1-1zM6.1 10.9l-1-1 4.8-4.8 1 1z",
  octagon: "M5.2 1.5h5.6l3.7 3.7v5.6l-3.7 3.7H5.2l-3.7-3.7V5.2zM7.2 4v5.2h1.6V4zM7.2 10.4V12h1.6v-1.6z",
  triangle: "M8 1.5 15 14H1zM7.3 5.8v4h1.4v-4zM7.3 10.8v1.4h1.4v-1.4z",
  disc: "M8 2a6 6 0 1 1 0 12A6 6 0 0 1 8 2zM7.2 4.4V6h1.6V4.4zM7.2 7v4.6h1.6V7z",
  eye: "M8 3.5c3.2 0 5.7 2 7 4.5-1.3 2.5-3.8 4.5-7 4.5S2.3 10.5 1 8c1.3-2.5 3.8-4.5 7-4.5zm0 1.5C5.7 5 3.8 6.2 2.7 8 3.8 9.8 5.7 11 8 11s4.2-1.2 5.3-3C12.2 6.2 10.3 5 8 5zm0 1.2a1.8 1.8 0 1 1 0 3.6 1.8 1.8 0 0 1 0-3.6z",
} as const;

export type IconName = keyof typeof ICONS;

export function icon(name: IconName): SVGElement {
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("viewBox", "0 0 16 16");
  svg.setAttribute("class", "icon");
  svg.setAttribute("aria-hidden", "true");
  const path = document.createElementNS("http://www.w3.org/2000/svg", "path");
  path.setAttribute("d", ICONS[name]);
  path.setAttribute("fill-rule", "evenodd");
  svg.append(path);
  return svg;
}

export function iconButton(name: IconName, label: string, onClick: () => void, className = ""): HTMLButtonElement {
  return h(
    "button",
    { type: "button", class: `icon-button ${className}`.trim(), title: label, aria: { label }, on: { click: onClick } },
    icon(name),
  );
}

export function select(
  label: string,
  options: readonly (readonly [value: string, text: string])[],
  value: string,
  onChange: (value: string) => void,
): HTMLSelectElement {
  const element = h("select", { aria: { label }, title: label });
  fillSelect(element, options, value);
  element.addEventListener("change", () => onChange(element.value));
  return element;
}

export function fillSelect(
  element: HTMLSelectElement,
  options: readonly (readonly [value: string, text: string])[],
  value: string,
): void {
  element.replaceChildren(...options.map(([v, text]) => new Option(shorten(text, 80), v)));
  element.value = value;
}

/** Control characters, such as line ends and direction marks, which could make one name look like another. */
const INVISIBLE = /[\p{Cc}\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff]/gu;

/** A name for display, without control characters. The middle of a long name is omitted, because its ends identify it. */
export function shorten(text: string, length: number): string {
  if (text.length > length) {
    const half = Math.floor((length - 1) / 2);
    return `${shorten(text.slice(0, half), half)}…${shorten(text.slice(text.length - half), half)}`;
  }
  return text.replace(INVISIBLE, "\ufffd");
}

export async function copyText(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // The Clipboard API needs a permission and a secure context; the older command does not.
    const area = h("textarea", { class: "offscreen" });
    area.value = text;
    document.body.append(area);
    area.select();
    const ok = document.execCommand("copy");
    area.remove();
    return ok;
  }
}

export function download(name: string, content: Blob): void {
  const url = URL.createObjectURL(content);
  const link = h("a");
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}
