// SPDX-License-Identifier: Apache-2.0
import { readdirSync, readFileSync } from "node:fs";
import { dirname, join, relative } from "node:path";
import { describe, expect, it } from "vitest";

/** The folders of src, from the lowest layer to the highest. Modules import from their own layer and lower ones only. */
const LAYERS = [
  "generated",
  "util",
  "protocol",
  "model",
  "replay",
  "scene",
  "displays",
  "dock",
  "plots",
  "history",
  "message_inspector",
  "log",
  "node_graph",
  "control",
  "panels",
];
const SRC = join(import.meta.dirname, "../src");

function layer(path: string): number {
  const folder = path.split("/")[0] as string;
  return path.includes("/") ? LAYERS.indexOf(folder) : LAYERS.length;
}

function imports(path: string): string[] {
  const text = readFileSync(join(SRC, path), "utf8");
  const targets = [...text.matchAll(/(?:from |import\(|^import )"(\.[^"]+)"/gm)].map((match) => match[1] as string);
  return targets
    .filter((target) => !target.endsWith(".css"))
    .map((target) => relative(SRC, join(SRC, dirname(path), target)));
}

describe("the modules of the page", () => {
  const modules = readdirSync(SRC, { recursive: true, encoding: "utf8" }).filter((path) => path.endsWith(".ts"));

  it("are in a known layer", () => {
    expect(modules.filter((path) => layer(path) < 0)).toEqual([]);
  });

  it("import from their own layer and lower ones only", () => {
    const upward = modules.flatMap((path) =>
      imports(path)
        .filter((target) => layer(target) > layer(path))
        .map((target) => `${path} imports ${target}`),
    );
    expect(upward).toEqual([]);
  });
});
