import { describe, expect, it } from "vitest";
import { marksOf } from "../src/findings";
import type { Finding } from "../src/protocol";

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
