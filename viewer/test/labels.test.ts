// SPDX-License-Identifier: Apache-2.0
import { expect, test } from "vitest";
import { labelLeft } from "../src/scene/labels";

test("a label is right of its frame if it fits", () => {
  expect(labelLeft(100, 80, 390)).toBe(100);
  expect(labelLeft(310, 80, 390)).toBe(310);
});

test("a label at the right edge of a phone is left of its frame", () => {
  expect(labelLeft(350, 80, 390)).toBe(270);
});

test("a name that is longer than the view begins at its left edge", () => {
  expect(labelLeft(200, 230, 220)).toBe(0);
});
