// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { marksOf } from "../src/model/marks";
import { summary } from "../src/panels/findings";
import type { FindingEntry, FindingEntries } from "../src/protocol/messages";

const finding = (change: Partial<FindingEntry>): FindingEntry => ({
  ...{ code: "TF013", severity: "note", title: "", subject: "", frames: [], text: "rare", why: "", fix: "" },
  ...{ publishers: [], first: null, namespace: "", explains: [] },
  ...change,
});

describe("the marks of frames", () => {
  it("have the highest severity of all findings that affect a frame, including consequences", () => {
    const effect = finding({ code: "TF003", severity: "error", frames: ["base"], text: "two publishers" });
    const marks = marksOf([
      finding({ frames: ["base", "arm"] }),
      finding({ code: "TF001", severity: "warning", frames: ["odom"], text: "two trees", explains: [effect] }),
    ]);
    expect([...marks].map(([frame, { severity }]) => [frame, severity]).sort()).toEqual([
      ["arm", "note"],
      ["base", "error"],
      ["odom", "warning"],
    ]);
    expect(marks.get("base")?.lines).toEqual(["TF003 error: two publishers", "TF013 note: rare"]);
  });
});

describe("the summary of the findings", () => {
  const result = (state: FindingEntries["state"]): FindingEntries => ({
    type: "findings",
    state,
    text: "gone",
    findings: [],
  });

  it("is empty before the first result", () => {
    expect(summary(null, "live")).toBe("");
    expect(summary(null, "recording")).toBe("");
  });

  it("explains why a buffer has no findings", () => {
    expect(summary(result("none"), "buffer")).toContain("neither publishers nor arrival times");
    expect(summary(result("ready"), "live")).toBe("No problems in the last 10 seconds.");
    expect(summary(result("failed"), "recording")).toBe("gone");
  });
});
