// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { numbered, States } from "../src/history/states";

function states(...changes: [number, string][]): States {
  const made = new States(1, "/state.data");
  const fields = { type: "states", id: 1, state: "ok", text: "", until: 50 } as const;
  made.receive({ ...fields, reset: true, changes: changes.map(([stamp, text]) => ({ stamp, text })) });
  return made;
}

describe("the states of a field", () => {
  it("last until the next change, and the last one until the last message", () => {
    const found = states([10, "idle"], [20, "driving"], [40, "idle"]);
    expect(found.spans(0, 100).map(({ from, to, text }) => [from, to, text])).toEqual([
      [10, 20, "idle"],
      [20, 40, "driving"],
      [40, 50, "idle"],
    ]);
    expect(found.spans(25, 30)).toHaveLength(1);
  });

  it("are known from the first message on", () => {
    const found = states([10, "idle"], [20, "driving"]);
    expect([9, 10, 19, 20, 1e9].map((time) => found.at(time))).toEqual([null, "idle", "idle", "driving", "driving"]);
  });

  it("keep their colors when new ones appear", () => {
    expect([...numbered(["b", "a", "b", "c"])]).toEqual([
      ["b", 0],
      ["a", 1],
      ["c", 2],
    ]);
  });
});
