// SPDX-License-Identifier: Apache-2.0
import { readFileSync } from "node:fs";
import { join } from "node:path";
import * as THREE from "three";
import { describe, expect, it } from "vitest";
import {
  compose,
  IDENTITY,
  interpolate,
  inverse,
  matrix,
  multiply,
  normalize,
  principalAxes,
  relativePose,
  rotate,
  rpyDegrees,
  type Pose,
  type Quaternion,
} from "../src/util/math";

/** A generator of pseudo-random numbers with a fixed seed. */
function* numbers(): Generator<number> {
  let state = 12345;
  for (;;) {
    state = (state * 1103515245 + 12345) % 2147483648;
    yield state / 1073741824 - 1;
  }
}

const random = numbers();
const next = (): number => random.next().value as number;
const somePose = (): Pose => ({
  position: [next() * 10, next() * 10, next() * 10],
  quaternion: normalize([next(), next(), next(), next()]),
});

/** The same transform computed by three.js, as an independent reference. */
function three({ position, quaternion }: Pose): THREE.Matrix4 {
  return new THREE.Matrix4().compose(
    new THREE.Vector3(...position),
    new THREE.Quaternion(...quaternion),
    new THREE.Vector3(1, 1, 1),
  );
}

function close(found: number[], expected: number[], digits = 9): void {
  found.forEach((value, i) => expect(value).toBeCloseTo(expected[i] as number, digits));
}

type Row = [number, number, number, number, number, number, number];

const INTERPOLATED = JSON.parse(readFileSync(join(import.meta.dirname, "interpolation.json"), "utf8")) as {
  first: Row;
  second: Row;
  fraction: number;
  pose: Row;
}[];

function toPose([x, y, z, ...quaternion]: Row): Pose {
  return { position: [x, y, z], quaternion };
}

describe("poses agree with three.js", () => {
  it("when composed, inverted and expressed relative to each other", () => {
    for (let i = 0; i < 100; i++) {
      const [a, b] = [somePose(), somePose()];
      close(matrix(compose(a, b)), three(a).multiply(three(b)).transpose().elements);
      close(matrix(inverse(a)), three(a).invert().transpose().elements);
      close(matrix(relativePose(a, b)), three(a).invert().multiply(three(b)).transpose().elements);
    }
  });

  it("when converted to roll, pitch and yaw", () => {
    for (let i = 0; i < 100; i++) {
      const { quaternion } = somePose();
      const euler = new THREE.Euler().setFromQuaternion(new THREE.Quaternion(...quaternion), "ZYX");
      close(rpyDegrees(quaternion), [euler.x, euler.y, euler.z].map(THREE.MathUtils.radToDeg), 6);
    }
  });

  it("at a pitch of ±90 degrees", () => {
    for (const pitch of [90, -90])
      for (const yaw of [0, 30, -120]) {
        const euler = new THREE.Euler(0, (pitch * Math.PI) / 180, (yaw * Math.PI) / 180, "ZYX");
        const q = new THREE.Quaternion().setFromEuler(euler).toArray() as Quaternion;
        const back = rpyDegrees(q).map(THREE.MathUtils.degToRad) as [number, number, number];
        const again = new THREE.Quaternion().setFromEuler(new THREE.Euler(...back, "ZYX"));
        expect(Math.abs(again.dot(new THREE.Quaternion(...q)))).toBeCloseTo(1, 9);
      }
  });

  it("when decomposed into principal axes", () => {
    // Variances 0.09, 0.04 and 0.01 along axes rotated by 120 degrees about (1, 1, 1) and then by 30 degrees about z.
    const turn = multiply([0, 0, Math.sin(Math.PI / 12), Math.cos(Math.PI / 12)], [0.5, 0.5, 0.5, 0.5]);
    const wanted = [0.09, 0.04, 0.01];
    const columns = (
      [
        [1, 0, 0],
        [0, 1, 0],
        [0, 0, 1],
      ] as const
    ).map((axis) => rotate(turn, [...axis]));
    const entry = (i: number, j: number): number =>
      wanted.reduce((sum, value, k) => sum + value * (columns[k]?.[i] as number) * (columns[k]?.[j] as number), 0);
    const matrix = [0, 1, 2].flatMap((i) => [0, 1, 2].map((j) => entry(i, j)));
    const { variances, quaternion } = principalAxes(matrix);
    expect(
      [...variances]
        .sort()
        .reverse()
        .map((value) => Math.round(value * 1e9) / 1e9),
    ).toEqual(wanted);
    variances.forEach((variance, k) => {
      const axis = rotate(quaternion, [Number(k === 0), Number(k === 1), Number(k === 2)]);
      const image = [0, 1, 2].map((i) => [0, 1, 2].reduce((sum, j) => sum + entry(i, j) * (axis[j] as number), 0));
      image.forEach((value, i) => expect(value).toBeCloseTo(variance * (axis[i] as number), 9));
    });
  });

  it("when interpolated as in the core, whose poses tests/core/test_interpolation.py writes", () => {
    for (const { first, second, fraction, pose } of INTERPOLATED) {
      const found = interpolate(toPose(first), toPose(second), fraction);
      const expected = toPose(pose);
      found.position.forEach((value, k) =>
        expect(Math.abs(value - (expected.position[k] as number))).toBeLessThan(1e-12),
      );
      const { quaternion } = relativePose(expected, found);
      for (const value of quaternion.slice(0, 3)) expect(Math.abs(value)).toBeLessThan(1e-12);
    }
    expect(INTERPOLATED.length).toBeGreaterThan(50);
  });

  it("when interpolated along the shorter rotation", () => {
    const there: Pose = { position: [2, 4, 6], quaternion: [0, 0, -Math.SQRT1_2, -Math.SQRT1_2] };
    const { position, quaternion } = interpolate(IDENTITY, there, 0.5);
    expect(position).toEqual([1, 2, 3]);
    expect(rpyDegrees(quaternion)[2]).toBeCloseTo(45, 6);
  });
});
