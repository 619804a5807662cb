import { describe, expect, it } from "vitest";
import type { Relation, ServerMessage, Tick } from "../src/protocol";
import { ReplaySource, type ReplayBlock } from "../src/replay";
import type { SourceEvents } from "../src/source";

const base64 = (array: ArrayBufferView): string => Buffer.from(array.buffer).toString("base64");
const HALF = Math.SQRT1_2;

/** map > base, which turns left by 90 degrees and goes from x = 1 to x = 2; beside them a tree of its own. */
const block: ReplayBlock = {
  format: "coframe-replay",
  version: 1,
  title: "test",
  origin: "1700000000000000000",
  from: 0,
  to: 1e9,
  rate: 1,
  fixed: "map",
  origin_xyz: [500000, 0, 0],
  frames: [
    { name: "map", parent: -1, static: false, component: 0 },
    { name: "base", parent: 0, static: false, component: 0 },
    { name: "drone", parent: -1, static: false, component: 1 },
  ],
  times: base64(new Float64Array([0, 1e9])),
  poses: base64(
    new Float32Array([
      ...[-500000, 0, 0, 0, 0, 0, 1, 1 - 500000, 0, 0, 0, 0, HALF, HALF, 0, 0, 0, 0, 0, 0, 1],
      ...[-500000, 0, 0, 0, 0, 0, 1, 2 - 500000, 0, 0, 0, 0, HALF, HALF, 0, 0, 0, 0, 0, 0, 1],
    ]),
  ),
  states: base64(new Uint8Array([0, 0, 3, 0, 0, 3])),
};

function play(): { source: ReplaySource; tick: () => Tick; relation: () => Relation } {
  const source = new ReplaySource(block);
  const seen: { tick?: Tick; text: ServerMessage[] } = { text: [] };
  source.start((event: keyof SourceEvents, value: unknown) => {
    if (event === "binary") seen.tick = value as Tick;
    if (event === "text") seen.text.push(value as ServerMessage);
  });
  const last = (type: string): ServerMessage | undefined => seen.text.filter((m) => m.type === type).at(-1);
  return { source, tick: () => seen.tick as Tick, relation: () => last("relation") as Relation };
}

const pose = (tick: Tick, frame: number): number[] => Array.from(tick.poses.subarray(frame * 7, frame * 7 + 7));

describe("a replay", () => {
  it("shows what was recorded at the playhead", () => {
    const { source, tick } = play();
    const at = (ns: number): number => {
      source.send({ type: "time", mode: "at", at: ns, playing: false, speed: 1, loop: null });
      return (tick().poses[7] as number) + tick().origin[0];
    };
    expect([at(0), at(0.99e9), at(1e9), at(5e9)]).toEqual([1, 1, 2, 2]);
    source.send({ type: "step", direction: -1 });
    expect(tick().time).toBe(0);
  });

  it("can be seen from another frame", () => {
    const { source, tick } = play();
    source.send({ type: "fixed", frame: "base" });
    const map = pose(tick(), 0);
    [0, 1, 0, 0, 0, -HALF, HALF].forEach((value, k) => expect(map[k]).toBeCloseTo(value, 6));
    expect(Array.from(tick().states)).toEqual([0, 0, 3]);
  });

  it("tells how two frames are related, and why they are not", () => {
    const { source, relation } = play();
    source.send({ type: "relate", id: 1, target: "map", source: "base" });
    expect(relation()).toMatchObject({ ok: true, translation: [1, 0, 0], chain: ["base", "map"] });
    expect(relation().rpy_deg?.[2]).toBeCloseTo(90, 4);
    source.send({ type: "relate", id: 2, target: "map", source: "drone" });
    expect(relation()).toMatchObject({ ok: false, error: expect.stringContaining("not connected") });
    source.send({ type: "relate", id: 3, target: "map", source: "nowhere" });
    expect(relation().error).toContain("nowhere");
  });

  it("that is damaged is refused", () => {
    expect(() => new ReplaySource({ ...block, poses: block.poses.slice(0, 40) })).toThrow("damaged");
  });
});
