// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { parseTime } from "../src/util/times";

describe("a typed time", () => {
  const start = new Date(2023, 10, 14, 22, 0, 0).getTime();
  const origin = BigInt(start) * 1_000_000n;
  const span = [0, 7200e9] as const;

  it.each([
    ["12.5", 12.5],
    ["1:30", 90],
    ["22:00:07.25", 7.25],
    [`${start / 1000 + 3}.5`, 3.5],
  ])("%s is found", (text, seconds) => {
    expect(parseTime(text, span, origin)).toBeCloseTo(seconds * 1e9, -3);
  });

  it("may be after midnight", () => {
    expect(parseTime("0:10:00", span, origin)).toBeCloseTo(7800e9, -3);
  });

  it.each(["", "soon", "1:2:3:4", "-5"])("%j is not one", (text) => {
    expect(parseTime(text, span, origin)).toBeNull();
  });
});
