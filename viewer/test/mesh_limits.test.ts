// SPDX-License-Identifier: Apache-2.0
import { describe, expect, it } from "vitest";
import { binaryTriangles, gltfProblem, objProblem, stlCoordinates, tgaProblem } from "../src/scene/mesh_limits";
import { quote } from "../src/util/static_commands";

function stl(size: number, triangles: number, start = ""): ArrayBuffer {
  const bytes = new Uint8Array(size);
  bytes.set(new TextEncoder().encode(start));
  if (size >= 84) new DataView(bytes.buffer).setUint32(80, triangles, true);
  return bytes.buffer;
}

describe("STL", () => {
  it("is binary if the number of triangles fits to the size", () => {
    expect(binaryTriangles(stl(84 + 100, 2))).toBe(2);
    expect(binaryTriangles(stl(84 + 100, 2, "solid"))).toBe(2);
    expect(binaryTriangles(stl(84 + 107, 2))).toBe(2);
    expect(binaryTriangles(stl(84 + 100, 0xffffffff))).toBeNull();
    expect(binaryTriangles(stl(84 + 107, 2, "solid"))).toBeNull();
    expect(binaryTriangles(stl(10, 0))).toBeNull();
  });

  it("has the corners of whole triangles", () => {
    const corner = "vertex 1 -2.5 3e-1\n";
    expect([...stlCoordinates(`solid x facet ${corner.repeat(4)}`)].length).toBe(9);
    expect([...stlCoordinates(corner.repeat(3))].slice(0, 3)).toEqual([1, -2.5, Math.fround(0.3)]);
  });

  it("is read in linear time", { timeout: 30_000 }, () => {
    const begun = performance.now();
    expect(stlCoordinates("facet vertex ".repeat(1_000_000)).length).toBeLessThan(9e6);
    expect(performance.now() - begun).toBeLessThan(20_000);
  });
});

describe("OBJ", () => {
  it("has limits on vertices and parts", { timeout: 20_000 }, () => {
    expect(objProblem("v 0 0 0\nf 1 1 1\n")).toBe("");
    expect(objProblem(`f${" 1".repeat(6_100_000)}`)).toContain("vertices; at most");
    expect(objProblem(`f${" 1 1 1 1 \\\n".repeat(1_600_000)}`)).toContain("vertices; at most");
    expect(objProblem("newmtl a\n".repeat(100_001))).toContain("groups or materials");
  });
});

describe("TGA", () => {
  it("has a limit on the pixels in its header", () => {
    const image = (width: number, height: number): ArrayBuffer => {
      const bytes = new DataView(new ArrayBuffer(18));
      bytes.setUint16(12, width, true);
      bytes.setUint16(14, height, true);
      return bytes.buffer;
    };
    expect(tgaProblem(image(4096, 4096))).toBe("");
    expect(tgaProblem(image(65535, 65535))).toContain("pixels; at most");
    expect(tgaProblem(new ArrayBuffer(17))).not.toBe("");
  });
});

describe("glTF", () => {
  it("has limits on values that are not in the file, and no loops", () => {
    expect(gltfProblem({ nodes: [{ children: [1, 2] }, {}, { children: [3] }, {}], accessors: [{ count: 3 }] })).toBe(
      "",
    );
    for (const count of [1e9, -1, 0.5, "3e9", null]) expect(gltfProblem({ accessors: [{ count }] })).not.toBe("");
    expect(gltfProblem({ accessors: [{ count: 4e6 }, { count: 4e6 }] })).toContain("vertices");
    expect(gltfProblem({ nodes: [{ children: [1] }, { children: [0] }] })).toContain("contain themselves");
    expect(gltfProblem({ nodes: [{ children: [0] }] })).toContain("contain themselves");
    expect(gltfProblem({ nodes: [{ children: [2] }, { children: [2] }, {}] })).toContain("two parents");
    expect(gltfProblem({ buffers: Array(5).fill({ uri: "a.bin" }) })).toContain("files");
    for (const odd of [null, 7, [], { nodes: 3, meshes: [null], accessors: {} }]) expect(gltfProblem(odd)).toBe("");
  });
});

describe("a name in a shell command", () => {
  it("contains no control characters", () => {
    expect(quote("base_link")).toBe("base_link");
    expect(quote("it's")).toBe(`'it'\\''s'`);
    expect(quote("a\x1b[201~\x15'b\\")).toBe(`$'a\\u001b[201~\\u0015\\'b\\\\'`);
  });
});
