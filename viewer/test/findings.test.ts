// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { marksOf, verdict } from "../src/panels/findings";
import type { Finding, Findings } from "../src/protocol/messages";

const finding = (change: Partial<Finding>): Finding => ({
  ...{ code: "TF013", severity: "note", title: "", subject: "", frames: [], text: "rare", why: "", fix: "" },
  ...{ publishers: [], first: null, namespace: "", explains: [] },
  ...change,
});

describe("marks", () => {
  it("are the worst of what concerns a frame, consequences among it", () => {
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

describe("the verdict", () => {
  const told = (state: Findings["state"]): Findings => ({ type: "findings", state, text: "gone", findings: [] });

  it("is empty until the doctor has spoken", () => {
    expect(verdict(null, "live")).toBe("");
    expect(verdict(null, "recording")).toBe("");
  });

  it("says what cannot be told only where that is so", () => {
    expect(verdict(told("none"), "buffer")).toContain("cannot tell who sent what");
    expect(verdict(told("ready"), "live")).toBe("Nothing is wrong in the last 10 seconds.");
    expect(verdict(told("failed"), "recording")).toBe("gone");
  });
});
