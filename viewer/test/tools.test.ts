// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { ToolSettings } from "../src/model/tools";
import { Picker } from "../src/scene/picking";
import { luminance } from "../src/util/theme";

describe("the settings of the tools", () => {
  it("have RViz's defaults, which are not written to files", () => {
    const tools = new ToolSettings();
    expect([tools.topic("estimate"), tools.topic("goal"), tools.topic("point")]).toEqual([
      "/initialpose",
      "/goal_pose",
      "/clicked_point",
    ]);
    expect(tools.variances).toEqual([0.25, 0.25, expect.closeTo(0.0685389, 6)]);
    expect(tools.save()).toEqual([]);
  });

  it("are read from files, changed and written", () => {
    const tools = new ToolSettings();
    tools.load([
      { class: "SetInitialPose", topic: "/r/initialpose", options: { "Covariance x": 1, "Covariance y": "bad" } },
    ]);
    tools.setTopic("goal", "/goal");
    expect(tools.variances.slice(0, 2)).toEqual([1, 0.25]);
    expect(tools.save()).toEqual([
      { class: "SetInitialPose", topic: "/r/initialpose", options: { "Covariance x": 1, "Covariance y": "bad" } },
      { class: "SetGoal", topic: "/goal", options: {} },
    ]);
    tools.setTopic("goal", "");
    expect(tools.topic("goal")).toBe("/goal_pose");
  });
});

describe("the point under the pointer", () => {
  const camera = new THREE.PerspectiveCamera(45, 1, 0.02, 5000);
  camera.up.set(0, 0, 1);
  camera.position.set(0, -10, 10);
  camera.lookAt(0, 0, 0);

  function picked(objects: THREE.Object3D[]): THREE.Vector3 | null {
    for (const object of objects) object.updateMatrixWorld(true);
    const picker = new Picker();
    picker.aim(camera, 50, 50, 100, 100);
    return picker.surface(objects);
  }

  it("is on the ground, unless the ray points to the sky", () => {
    const picker = new Picker();
    picker.aim(camera, 50, 50, 100, 100);
    expect(picker.ground(0)?.length()).toBeCloseTo(0);
    expect(picker.ground(5)?.toArray()).toEqual([0, expect.closeTo(-5), expect.closeTo(5)]);
    expect(picker.ground(20)).toBeNull();
  });

  it("is on the nearest visible surface, and on the point of a cloud", () => {
    const box = new THREE.Mesh(new THREE.BoxGeometry(2, 2, 2));
    const behind = new THREE.Mesh(new THREE.BoxGeometry(9, 9, 0.1));
    const hidden = new THREE.Group();
    hidden.visible = false;
    hidden.add(new THREE.Mesh(new THREE.SphereGeometry(4)));
    expect(picked([behind, box, hidden])?.z).toBeCloseTo(1);
    const positions = new THREE.BufferAttribute(new Float32Array([0, 0.05, 0, 3, 3, 3]), 3);
    const cloud = new THREE.Points(new THREE.BufferGeometry().setAttribute("position", positions));
    expect(picked([cloud])?.toArray()).toEqual([0, expect.closeTo(0.05), 0]);
    expect(picked([])).toBeNull();
  });
});

it("the luminance of a color distinguishes dark and light backgrounds", () => {
  expect([luminance("#000000"), luminance("#ffffff")]).toEqual([0, expect.closeTo(1)]);
  expect(luminance("#303030")).toBeLessThan(0.179);
  expect(luminance("#808080")).toBeGreaterThan(0.179);
});
