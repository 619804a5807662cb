// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { nestValues, parseValue, formatValue } from "../src/control/values";

describe("the fields of a form", () => {
  it("are nested by their paths", () => {
    const values = new Map<string, number | string>([
      ["linear.x", 0.5],
      ["linear.y", 1],
      ["frame", "map"],
    ]);
    expect(nestValues(values)).toEqual({ linear: { x: 0.5, y: 1 }, frame: "map" });
  });

  it("are strings without quotes and everything else as JSON", () => {
    expect(parseValue("string", "12")).toBe("12");
    expect(parseValue("double", "1e3")).toBe(1000);
    expect(parseValue("boolean", "true")).toBe(true);
    expect(parseValue("sequence<double>", "[1, 2]")).toEqual([1, 2]);
    expect(formatValue({ path: "data", type: "string", value: '"a b"' })).toBe("a b");
    expect(formatValue({ path: "data", type: "double", value: "0.0" })).toBe("0.0");
  });

  it.each([
    ["double", "fast"],
    ["int32", '"1"'],
    ["boolean", "1"],
    ["sequence<double>", "[1, "],
  ])("of the type %s are not %s", (type, text) => {
    expect(() => parseValue(type, text)).toThrow();
  });
});
