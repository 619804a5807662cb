// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { decode, ProtocolError, slice } from "../src/protocol/messages";

/** Encodes fields in the format of the server. */
function pack(...fields: ["u32" | "f32" | "f64" | "u8", ...number[]][]): ArrayBuffer {
  const bytes: number[] = [];
  for (const [type, ...values] of fields)
    for (const value of values) {
      const view = new DataView(new ArrayBuffer(8));
      const size = { u32: 4, f32: 4, f64: 8, u8: 1 }[type];
      if (type === "u32") view.setUint32(0, value, true);
      else if (type === "f32") view.setFloat32(0, value, true);
      else if (type === "f64") view.setFloat64(0, value, true);
      else view.setUint8(0, value);
      for (let i = 0; i < size; i++) bytes.push(view.getUint8(i));
    }
  return new Uint8Array(bytes).buffer;
}

const POSE = [1, 2, 3, 0, 0, 0, 1];

describe("frame updates", () => {
  const update = pack(
    ["u32", 1, 7],
    ["f64", 2 ** 52 + 1, 500000.125, 4e6, 0],
    ["u32", 3, 1],
    ["f32", ...POSE, ...POSE, ...POSE.map(() => NaN)],
    ["u8", 0, 1, 3, 0],
    ["u32", 9, 4, 2],
    ["f32", ...POSE],
    ["u32", 1],
  );

  it("are decoded with exact times and origins", () => {
    const read = decode(update);
    if (read.kind !== "frames") throw new Error(read.kind);
    expect(read.revision).toBe(7);
    expect(read.time).toBe(2 ** 52 + 1);
    expect(read.origin).toEqual([500000.125, 4e6, 0]);
    expect(Array.from(read.poses.subarray(7, 14))).toEqual(POSE);
    expect(read.poses[14]).toBeNaN();
    expect(Array.from(read.states)).toEqual([0, 1, 3]);
    expect(read.displays).toHaveLength(1);
    expect(read.displays[0]).toMatchObject({ id: 9, sequence: 4, frame: 2, ok: false });
  });

  it("are rejected if they are too short", () => {
    for (let length = 0; length < update.byteLength; length++)
      expect(() => decode(update.slice(0, length)), `of ${length} bytes`).toThrow(ProtocolError);
  });

  it("are rejected before allocation if they declare more frames than bytes", () => {
    const oversized = pack(["u32", 1, 1], ["f64", 0, 0, 0, 0], ["u32", 0xffffffff, 0xffffffff]);
    expect(() => decode(oversized)).toThrow(ProtocolError);
  });
});

describe("display messages", () => {
  it("of clouds contain scalars or colors", () => {
    const head = (flags: number): Parameters<typeof pack> => [
      ["u32", 2, 5, 6, 2, flags],
      ["f64", 10],
      ["f32", -1, 1],
      ["f32", 1, 2, 3, 4, 5, 6],
    ];
    const scalar = decode(pack(...head(1), ["f32", 0.5, 0.25]));
    if (scalar.kind !== "cloud") throw new Error(scalar.kind);
    expect(Array.from(scalar.points)).toEqual([1, 2, 3, 4, 5, 6]);
    expect(Array.from(scalar.scalar ?? [])).toEqual([0.5, 0.25]);
    expect(scalar.range).toEqual([-1, 1]);
    const rgba = decode(pack(...head(2), ["u8", 1, 2, 3, 4, 5, 6, 7, 8]));
    expect(rgba.kind === "cloud" && Array.from(rgba.rgba ?? [])).toEqual([1, 2, 3, 4, 5, 6, 7, 8]);
  });

  it("of grids use -1 for unknown cells", () => {
    const grid = decode(pack(["u32", 3, 1, 1, 2, 1], ["f32", 0.5, ...POSE], ["u8", 255, 100]));
    expect(grid.kind === "grid" && Array.from(grid.cells)).toEqual([-1, 100]);
  });

  it("of shapes contain only rows inside the payload", () => {
    const payload = new Float32Array([0, 1, 2, 3, 4, 5]);
    expect(Array.from(slice(payload, [3, 1], 3))).toEqual([3, 4, 5]);
    for (const pair of [
      [3, 2],
      [-1, 1],
      [0, -1],
      [NaN, 1],
      [0, 1e12],
    ] as [number, number][])
      expect(slice(payload, pair, 3)).toHaveLength(0);
  });

  it("are rejected if their kind is unknown or their description is not JSON", () => {
    expect(() => decode(pack(["u32", 77]))).toThrow("unknown kind 77");
    expect(() => decode(pack(["u32", 4, 1, 1, 4], ["u8", 123, 123, 123, 123]))).toThrow("JSON");
  });
});
