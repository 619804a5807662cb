// SPDX-License-Identifier: Apache-2.0
/** Dark and light themes, and a palette that is safe for color-blind users. */

import { storeValue, loadStored } from "./storage";

export interface Palette {
  background: string;
  grid: string;
  axes: [string, string, string];
  edge: [from: string, to: string];
  chain: string;
  measure: string;
}

/** Black and white text have the same contrast on a background of this luminance. */
const MIDDLE_LUMINANCE = 0.179;

const RED_GREEN_BLUE: [string, string, string] = ["#e5383b", "#34b53a", "#3f7bf5"];
/** Okabe and Ito's vermilion, with a yellow and a blue that also differ in brightness. */
const DISTINCT_DARK: [string, string, string] = ["#e8681a", "#f0e442", "#56b4e9"];
const DISTINCT_LIGHT: [string, string, string] = ["#c94e00", "#a38a00", "#0072b2"];

export class Theme {
  dark: boolean;
  distinct: boolean;
  /** The background of an .rviz file, which overrides that of the theme. */
  background: string | null = null;
  private readonly listeners: (() => void)[] = [];

  constructor() {
    const preferred = matchMedia("(prefers-color-scheme: light)").matches ? "light" : "dark";
    this.dark = loadStored("theme", preferred) !== "light";
    this.distinct = loadStored("distinct", false);
    this.apply();
  }

  onChange(listener: () => void): void {
    this.listeners.push(listener);
  }

  toggleDark(): void {
    this.dark = !this.dark;
    this.background = null;
    storeValue("theme", this.dark ? "dark" : "light");
    this.apply();
  }

  toggleDistinct(): void {
    this.distinct = !this.distinct;
    storeValue("distinct", this.distinct);
    this.apply();
  }

  setBackground(color: string | null): void {
    this.background = color;
    this.apply();
  }

  /** Whether the background of the scene is dark, which that of an .rviz file may be in either theme. */
  get darkScene(): boolean {
    return this.background === null ? this.dark : luminance(this.background) < MIDDLE_LUMINANCE;
  }

  palette(): Palette {
    const dark = this.darkScene;
    const axes = this.distinct ? (dark ? DISTINCT_DARK : DISTINCT_LIGHT) : RED_GREEN_BLUE;
    return dark
      ? {
          background: this.background ?? "#22272c",
          grid: "#4a525b",
          axes,
          edge: ["#e0c067", "#8b7a45"],
          chain: "#ff9ff3",
          measure: "#ffffff",
        }
      : {
          background: this.background ?? "#eef1f4",
          grid: "#c3cbd3",
          axes,
          edge: ["#a07c1c", "#cdb87c"],
          chain: "#b1179a",
          measure: "#1c2329",
        };
  }

  private apply(): void {
    document.documentElement.dataset.theme = this.dark ? "dark" : "light";
    document.documentElement.dataset.scene = this.darkScene ? "dark" : "light";
    document.documentElement.dataset.palette = this.distinct ? "distinct" : "default";
    for (const listener of this.listeners) listener();
  }
}

/** The relative luminance of a color "#rrggbb", from 0 (black) to 1 (white), as WCAG defines it. */
export function luminance(color: string): number {
  const [r, g, b] = [1, 3, 5].map((at) => {
    const part = Number.parseInt(color.slice(at, at + 2), 16) / 255;
    return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
  }) as [number, number, number];
  return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}
