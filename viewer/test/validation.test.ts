// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { checkServerMessage, ProtocolError } from "../src/protocol/validation";

const tree = {
  type: "tree",
  revision: 1,
  fixed: "map",
  frames: [{ name: "map", parent: -1, static: true, component: 0 }],
  components: [{ root: "map", size: 1 }],
};
const stats = {
  type: "stats",
  revision: 1,
  span: null,
  frames: [{ rate: null, age: 0.5, last: 3, publisher: "/tf", samples: 4, longest_gap: null, state: "fresh" }],
};

describe("messages from the server", () => {
  it("are returned unchanged if they are valid", () => {
    for (const message of [tree, stats, { type: "display", id: 1, state: "ok", text: "" }])
      expect(checkServerMessage(message)).toBe(message);
  });

  it("are rejected with the name of the invalid field", () => {
    const { fixed: _, ...incomplete } = tree;
    expect(() => checkServerMessage(incomplete)).toThrow("tree.fixed must be a string");
    expect(() => checkServerMessage({ ...tree, frames: [{ name: "map" }] })).toThrow(
      "tree.frames[0].parent must be a number",
    );
    expect(() => checkServerMessage({ ...stats, span: [1] })).toThrow("stats.span must be an array of 2");
    expect(() => checkServerMessage({ type: "display", id: 1, state: "fine", text: "" })).toThrow(
      "ok or waiting or error",
    );
    expect(() => checkServerMessage({ type: "display", id: 1, state: "ok", text: "", note: 3 })).toThrow(
      "display.note",
    );
  });

  it("of unknown types, and other values, are rejected", () => {
    for (const value of [null, [], 3, {}, { type: 7 }, { type: "nothing" }, { type: "constructor" }])
      expect(() => checkServerMessage(value)).toThrow(ProtocolError);
  });
});
