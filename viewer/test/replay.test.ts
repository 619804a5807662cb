// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import type {
  BinaryMessage,
  Relation,
  ReplayBlock,
  ReplayDisplayBlock,
  ServerMessage,
  FrameUpdate,
} from "../src/protocol/messages";
import { ReplaySource } from "../src/replay/source";
import type { SourceEvents } from "../src/protocol/source";

const base64 = (array: ArrayBufferView): string =>
  Buffer.from(array.buffer, array.byteOffset, array.byteLength).toString("base64");
const HALF = Math.SQRT1_2;

/** map > base, rotated by 90 degrees and moving from x = 1 to x = 2, and a separate tree with one frame. */
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
  nodes: [],
  stats: [],
  edges: [],
  bins: 0,
};

/** An encoded cloud with one of three points. */
function cloud(): Uint8Array {
  const view = new DataView(new ArrayBuffer(48));
  [2, 77, 4, 1, 3 << 8].forEach((value, k) => view.setUint32(k * 4, value, true));
  return new Uint8Array(view.buffer);
}

/** A message with stamp 0.5 s at x = 3, visible from the second sample on. */
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
  update: () => FrameUpdate;
  relation: () => Relation;
  displayed: () => BinaryMessage[];
  texts: (type: string) => ServerMessage[];
}

function play(played = block): Played {
  const source = new ReplaySource(played);
  const seen: { update?: FrameUpdate; text: ServerMessage[]; displayed: BinaryMessage[] } = { text: [], displayed: [] };
  source.start((event: keyof SourceEvents, value: unknown) => {
    const binary = value as BinaryMessage;
    if (event === "binary" && binary.kind === "frames") seen.update = binary;
    else if (event === "binary") seen.displayed.push(binary);
    if (event === "text") seen.text.push(value as ServerMessage);
  });
  const texts = (type: string): ServerMessage[] => seen.text.filter((message) => message.type === type);
  return {
    source,
    update: () => seen.update as FrameUpdate,
    relation: () => texts("relation").at(-1) as Relation,
    displayed: () => seen.displayed,
    texts,
  };
}

const pose = (update: FrameUpdate, frame: number): number[] =>
  Array.from(update.poses.subarray(frame * 7, frame * 7 + 7));

describe("a replay", () => {
  it("shows the recorded sample at the playhead", () => {
    const { source, update } = play();
    const at = (ns: number): number => {
      source.send({ type: "time", mode: "at", at: ns, playing: false, speed: 1, loop: null });
      return (update().poses[7] as number) + update().origin[0];
    };
    expect([at(0), at(0.99e9), at(1e9), at(5e9)]).toEqual([1, 1, 2, 2]);
    source.send({ type: "step", direction: -1 });
    expect(update().time).toBe(0);
  });

  it("can use another fixed frame", () => {
    const { source, update } = play();
    source.send({ type: "fixed", frame: "base" });
    const map = pose(update(), 0);
    [0, 1, 0, 0, 0, -HALF, HALF].forEach((value, k) => expect(map[k]).toBeCloseTo(value, 6));
    expect(Array.from(update().states)).toEqual([0, 0, 3]);
  });

  it("returns the pose between two frames, or the reason why there is none", () => {
    const { source, relation } = play();
    source.send({ type: "relate", id: 1, target: "map", source: "base" });
    expect(relation()).toMatchObject({ ok: true, translation: [1, 0, 0], chain: ["base", "map"] });
    expect(relation().rpy_deg?.[2]).toBeCloseTo(90, 4);
    source.send({ type: "relate", id: 2, target: "map", source: "drone" });
    expect(relation()).toMatchObject({ ok: false, error: expect.stringContaining("not connected") });
    source.send({ type: "relate", id: 3, target: "map", source: "nowhere" });
    expect(relation().error).toContain("nowhere");
  });

  it("shows each message at its recorded time and pose", () => {
    const { source, update, displayed } = play({ ...block, displays: [scans] });
    const at = (ns: number): void =>
      source.send({ type: "time", mode: "at", at: ns, playing: false, speed: 1, loop: null });
    source.send({ type: "subscribe", id: 9, topic: "/scan", options: { color_by: "axis" } });
    expect(update().displays).toEqual([]);
    at(1e9);
    const [entry] = update().displays;
    expect(entry).toMatchObject({ id: 9, sequence: 4, ok: true });
    expect((entry?.pose[0] as number) + update().origin[0]).toBe(3);
    expect(displayed()).toMatchObject([{ kind: "cloud", id: 9, sequence: 4, count: 1, step: 3 }]);
    at(0);
    at(1e9);
    expect(displayed(), "it is sent again, because the page may have deleted it").toHaveLength(2);
    source.send({ type: "unsubscribe", id: 9 });
    expect(update().displays).toEqual([]);
  });

  it("transforms messages to another fixed frame at their own stamps", () => {
    const { source, update } = play({ ...block, displays: [scans] });
    source.send({ type: "subscribe", id: 1, topic: "/scan", options: {} });
    source.send({ type: "time", mode: "at", at: 1e9, playing: false, speed: 1, loop: null });
    source.send({ type: "fixed", frame: "base" });
    // At its stamp, halfway between the samples, base was at x = 1.5 with its x axis along y.
    const [x, y] = update().displays[0]?.pose as unknown as [number, number];
    expect([x, y].map((value) => Math.round(value * 1e3) / 1e3 + 0)).toEqual([0, -1.5]);
  });

  it("reports topics and colors that it does not contain", () => {
    const { source, texts } = play({ ...block, displays: [scans] });
    source.send({ type: "subscribe", id: 1, topic: "/scan", options: { color_by: "intensity" } });
    source.send({ type: "subscribe", id: 2, topic: "/other", options: {} });
    source.send({ type: "time", mode: "at", at: 1e9, playing: false, speed: 1, loop: null });
    expect(
      texts("display").map((message) => message.type === "display" && [message.id, message.text, message.note]),
    ).toEqual([
      [1, "no message before this time", "1 of 2 frames"],
      [2, "This replay does not contain topic /other.", undefined],
      [1, "This replay contains only the colors that it was saved with.", "1 of 2 frames"],
    ]);
  });

  it("is rejected if it is damaged", () => {
    expect(() => new ReplaySource({ ...block, poses: block.poses.slice(0, 40) })).toThrow("damaged");
    const cut = { ...scans, stamps: "" };
    expect(() => new ReplaySource({ ...block, displays: [cut] })).toThrow("damaged");
  });
});
