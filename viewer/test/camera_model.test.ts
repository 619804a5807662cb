// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, expect, it } from "vitest";
import {
  firstCamera,
  imageSize,
  isRectifiedTopic,
  projection,
  type Intrinsics,
  type Project,
} from "../src/util/camera_model";

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

  it("moves points of a stereo pair by P, unless the transforms contain the baseline", () => {
    const p = [400, 0, 640, -48, 0, 400, 400, 0, 0, 0, 1, 0];
    const right = { ...CAMERA, p };
    expect((projection(right, true) as Project)(0.2, 0, 1)).toEqual([672, 400]);
    expect((projection(right, true, true) as Project)(0.2, 0, 1)).toEqual([720, 400]);
    expect(firstCamera(right)).toEqual([-0.12, 0]);
    expect(firstCamera({ ...right, p: [400, 0, 640, 0, 0, 400, 400, 0, 0, 0, 1, 0] })).toBeNull();
  });

  it("turns points into the rectified frame", () => {
    const p = [400, 0, 640, 0, 0, 400, 400, 0, 0, 0, 1, 0];
    const r = [0, 1, 0, -1, 0, 0, 0, 0, 1];
    expect((projection({ ...CAMERA, p, r }, true) as Project)(0.2, 0.1, 1)).toEqual([680, 320]);
  });

  it("draws into the part of the image that the camera sends", () => {
    const part = { ...CAMERA, width: 640, height: 480, d: [], roi: [40, 60, 400, 300], binning: [2, 4] };
    const [u, v] = (projection({ ...CAMERA, d: [] }, false) as Project)(0.1, 0.2, 1) as [number, number];
    expect((projection(part, false) as Project)(0.1, 0.2, 1)).toEqual([(u - 40) / 2, (v - 60) / 4]);
    expect(imageSize(part)).toEqual({ width: 200, height: 75 });
    expect(imageSize({ ...part, roi: [0, 0, 0, 0], binning: [1, 1] })).toEqual({ width: 640, height: 480 });
  });

  it("sees points beside and behind a fisheye", () => {
    const fisheye = {
      ...CAMERA,
      distortion_model: "equidistant",
      d: [0, 0, 0, 0],
      k: [400, 0, 640, 0, 400, 400, 0, 0, 1],
    };
    const project = projection(fisheye, false) as Project;
    expect((project(3, 0, 2) as [number, number])[0]).toBeCloseTo(1033.1, 1);
    const at = (degrees: number): number =>
      (project(Math.sin((degrees * Math.PI) / 180), 0, Math.cos((degrees * Math.PI) / 180)) as [number, number])[0];
    expect(at(85)).toBeCloseTo(640 + (400 * 85 * Math.PI) / 180);
    expect(at(95)).toBeCloseTo(640 + (400 * 95 * Math.PI) / 180);
  });

  it.each([
    ["double_sphere", [-0.17213086, 0.59311776], 0.23772684, 0.11886342],
    ["eucm", [0.6, 1.1], 0.19679632, 0.09839816],
    ["omni", [1, 0, 0, 0, 0], 0.09878031, 0.04939015],
    ["fov", [0.9], 0.21144188, 0.10572094],
  ])("knows the lens %s", (distortion_model, d, x, y) => {
    const project = projection({ ...CAMERA, distortion_model, d, k: [1, 0, 0, 0, 1, 0, 0, 0, 1] }, false) as Project;
    const [u, v] = project(0.2, 0.1, 1) as [number, number];
    expect(u).toBeCloseTo(x, 6);
    expect(v).toBeCloseTo(y, 6);
  });

  it("takes an image for rectified by a whole word of its topic", () => {
    for (const topic of [
      "/cam/image_rect",
      "/cam/image_rect_color/compressed",
      "/zed/rectified/image",
      "/d/image_rect_raw",
    ])
      expect(isRectifiedTopic(topic), topic).toBe(true);
    for (const topic of [
      "/direct_cam/image_raw",
      "/color_correction/image_raw",
      "/cam/image_unrect",
      "/rect/image_raw",
    ])
      expect(isRectifiedTopic(topic), topic).toBe(false);
  });
});
