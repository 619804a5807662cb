// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type {
  BinaryMessage,
  Relation,
  ReplayBlock,
  ReplayDisplayBlock,
  ServerMessage,
  Tick,
} from "../src/protocol/messages";
import { ReplaySource } from "../src/replay/source";
import type { SourceEvents } from "../src/protocol/source";

const base64 = (array: ArrayBufferView): string =>
  Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64");
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
  robots: [],
  rviz: null,
  displays: [],
  stats: [],
  edges: [],
  bins: 0,
};

/** A cloud of one point, of three that there were, as the server writes it. */
function cloud(): Uint8Array {
  const view = new DataView(new ArrayBuffer(48));
  [2, 77, 4, 1, 3 << 8].forEach((value, k) => view.setUint32(k * 4, value, true));
  return new Uint8Array(view.buffer);
}

/** From the second picture on a message of half a second, whose frame was at x = 3. */
const scans: ReplayDisplayBlock = {
  topic: "/scan",
  type: "sensor_msgs/msg/LaserScan",
  display: "LaserScan",
  color_by: "axis",
  every: 2,
  statuses: [
    [0, "waiting", "no message before this time"],
    [1, "ok", ""],
  ],
  drawings: { "4": base64(cloud()) },
  changes: base64(new Uint32Array([1])),
  counts: base64(new Uint32Array([1])),
  sequences: base64(new Uint32Array([4])),
  poses: base64(new Float32Array([3 - 500000, 0, 0, 0, 0, 0, 1])),
  stamps: base64(new Float64Array([0.5e9])),
};

interface Played {
  source: ReplaySource;
  tick: () => Tick;
  relation: () => Relation;
  drawings: () => BinaryMessage[];
  told: (type: string) => ServerMessage[];
}

function play(played = block): Played {
  const source = new ReplaySource(played);
  const seen: { tick?: Tick; text: ServerMessage[]; drawings: BinaryMessage[] } = { text: [], drawings: [] };
  source.start((event: keyof SourceEvents, value: unknown) => {
    const binary = value as BinaryMessage;
    if (event === "binary" && binary.kind === "tick") seen.tick = binary;
    else if (event === "binary") seen.drawings.push(binary);
    if (event === "text") seen.text.push(value as ServerMessage);
  });
  const told = (type: string): ServerMessage[] => seen.text.filter((message) => message.type === type);
  return {
    source,
    tick: () => seen.tick as Tick,
    relation: () => told("relation").at(-1) as Relation,
    drawings: () => seen.drawings,
    told,
  };
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

  it("shows each message while it was to be seen, and where it was", () => {
    const { source, tick, drawings } = play({ ...block, displays: [scans] });
    const at = (ns: number): void =>
      source.send({ type: "time", mode: "at", at: ns, playing: false, speed: 1, loop: null });
    source.send({ type: "subscribe", id: 9, topic: "/scan", options: { color_by: "axis" } });
    expect(tick().displays).toEqual([]);
    at(1e9);
    const [entry] = tick().displays;
    expect(entry).toMatchObject({ id: 9, sequence: 4, ok: true });
    expect((entry?.pose[0] as number) + tick().origin[0]).toBe(3);
    expect(drawings()).toMatchObject([{ kind: "cloud", id: 9, sequence: 4, count: 1, step: 3 }]);
    at(0);
    at(1e9);
    expect(drawings(), "the page may have thrown it away").toHaveLength(2);
    source.send({ type: "unsubscribe", id: 9 });
    expect(tick().displays).toEqual([]);
  });

  it("shows messages from another frame as of their own stamps", () => {
    const { source, tick } = play({ ...block, displays: [scans] });
    source.send({ type: "subscribe", id: 1, topic: "/scan", options: {} });
    source.send({ type: "time", mode: "at", at: 1e9, playing: false, speed: 1, loop: null });
    source.send({ type: "fixed", frame: "base" });
    // At its stamp, half-way between the pictures, base was at x = 1.5 and looked along y.
    const [x, y] = tick().displays[0]?.pose as unknown as [number, number];
    expect([x, y].map((value) => Math.round(value * 1e3) / 1e3 + 0)).toEqual([0, -1.5]);
  });

  it("says what it does not hold", () => {
    const { source, told } = play({ ...block, displays: [scans] });
    source.send({ type: "subscribe", id: 1, topic: "/scan", options: { color_by: "intensity" } });
    source.send({ type: "subscribe", id: 2, topic: "/other", options: {} });
    source.send({ type: "time", mode: "at", at: 1e9, playing: false, speed: 1, loop: null });
    expect(
      told("display").map((message) => message.type === "display" && [message.id, message.text, message.note]),
    ).toEqual([
      [1, "no message before this time", "1 of 2 pictures"],
      [2, "This replay holds nothing of /other.", undefined],
      [1, "This replay holds no other colours than those that it was saved with.", "1 of 2 pictures"],
    ]);
  });

  it("that is damaged is refused", () => {
    expect(() => new ReplaySource({ ...block, poses: block.poses.slice(0, 40) })).toThrow("damaged");
    const cut = { ...scans, stamps: "" };
    expect(() => new ReplaySource({ ...block, displays: [cut] })).toThrow("damaged");
  });
});
