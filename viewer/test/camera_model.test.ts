// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import { projection, type Intrinsics, type Project } from "../src/util/camera_model";

interface Reference extends Intrinsics {
  name: string;
  points: [number, number, number][];
  pixels: [number, number][];
}

/** Written by scripts/projection_reference.py with OpenCV's projectPoints. */
const REFERENCES = JSON.parse(readFileSync(join(import.meta.dirname, "projection.json"), "utf8")) as Reference[];
const CAMERA = REFERENCES[0] as Reference;

describe("the projection", () => {
  it.each(REFERENCES)("equals OpenCV's: $name", (camera) => {
    const project = projection(camera, false) as Project;
    expect(camera.points.length).toBeGreaterThan(30);
    camera.points.forEach((point, i) => {
      const found = project(...point) as [number, number];
      const [u, v] = camera.pixels[i] as [number, number];
      expect(Math.hypot(found[0] - u, found[1] - v)).toBeLessThan(1e-6);
    });
  });

  it("uses the matrix P for rectified images", () => {
    const p = [500, 0, 300, 0, 0, 400, 200, 0, 0, 0, 1, 0];
    const project = projection({ ...(REFERENCES[1] as Reference), p }, true) as Project;
    expect(project(0.2, 0.1, 2)).toEqual([350, 220]);
  });

  it("has no points behind the camera, and none where the polynomial turns back into the image", () => {
    const project = projection(CAMERA, false) as Project;
    expect([project(0, 0, -1), project(0, 0, 0), project(NaN, 0, NaN)]).toEqual([null, null, null]);
    const barrel = projection({ ...CAMERA, distortion_model: "plumb_bob", d: [-0.3, 0, 0, 0, 0] }, false) as Project;
    expect(barrel(1, 0, 1)).not.toBeNull();
    expect(barrel(1.2, 0, 1)).toBeNull();
  });

  it("gives the reason if it is not possible", () => {
    expect(projection({ ...CAMERA, k: [] }, false)).toContain("fx and fy of K must be positive");
    expect(projection({ ...CAMERA, d: [1, 2, 3, 4], distortion_model: "magic" }, false)).toContain("“magic”");
    expect(projection({ ...CAMERA, d: [1, null, 3, 4], distortion_model: "plumb_bob" }, false)).toContain("invalid");
  });
});
