// SPDX-License-Identifier: Apache-2.0
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import { dragPose, type DragStart, type DraggedPose } from "../src/displays/control_drag";

const V = (x: number, y: number, z: number): THREE.Vector3 => new THREE.Vector3(x, y, z);
/** A camera above the origin that looks down, with y of the scene up on the screen. */
const camera = { right: V(1, 0, 0), up: V(0, 1, 0), forward: V(0, 0, -1) };

function start(mode: number, axis: THREE.Vector3, grabbed: THREE.Vector3): DragStart {
  return { mode, axis, grabbedPoint: grabbed, camera, position: V(0, 0, 0), quaternion: new THREE.Quaternion() };
}

/** Drags to a point that the camera sees from above; pixels are hundredths of a meter. */
function to(from: DragStart, x: number, y: number, shift = false): DraggedPose | null {
  const moved = [(x - from.grabbedPoint.x) * 100, (from.grabbedPoint.y - y) * 100] as const;
  return dragPose(from, { ray: new THREE.Ray(V(x, y, 10), V(0, 0, -1)), moved, shift });
}

function expectPose(pose: DraggedPose | null, position: number[], angle: number, axis = V(0, 0, 1)): void {
  const expected = new THREE.Quaternion().setFromAxisAngle(axis, angle);
  position.forEach((value, k) => expect(pose?.position.getComponent(k)).toBeCloseTo(value, 9));
  expect(pose?.quaternion.angleTo(expected)).toBeCloseTo(0, 6);
}

describe("dragged controls", () => {
  it("move along an axis", () => {
    expectPose(to(start(3, V(1, 0, 0), V(1, 0, 0)), 3, 5), [2, 0, 0], 0);
    expect(to(start(3, V(0, 0, 1), V(0, 0, 1)), 3, 5)).toBeNull();
  });

  it("move in a plane", () => {
    expectPose(to(start(4, V(0, 0, 1), V(1, 0, 0)), 3, 5), [2, 5, 0], 0);
    expect(to(start(4, V(1, 0, 0), V(1, 0, 0)), 3, 5)).toBeNull();
  });

  it("turn about an axis", () => {
    expectPose(to(start(5, V(0, 0, 1), V(1, 0, 0)), 0, 3), [0, 0, 0], Math.PI / 2);
  });

  it("turn and move, so that the grabbed point follows", () => {
    expectPose(to(start(6, V(0, 0, 1), V(1, 0, 0)), 0, 3), [0, 2, 0], Math.PI / 2);
  });

  it("move and turn freely", () => {
    expectPose(to(start(7, V(1, 0, 0), V(0, 0, 1)), 2, -1), [2, -1, 0], 0);
    expectPose(to(start(8, V(1, 0, 0), V(0, 0, 0)), 1, 0), [0, 0, 0], 1, V(0, 1, 0));
    expectPose(to(start(9, V(1, 0, 0), V(0, 0, 0)), 1, 0), [1, 0, 0], 0);
    expectPose(to(start(9, V(1, 0, 0), V(0, 0, 0)), 0, -1, true), [0, 0, 0], 1, V(1, 0, 0));
  });

  it("do nothing for buttons and menus", () => {
    for (const mode of [0, 1, 2]) expect(to(start(mode, V(1, 0, 0), V(0, 0, 0)), 1, 1)).toBeNull();
  });
});
