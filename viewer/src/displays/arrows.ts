// SPDX-License-Identifier: Apache-2.0
/** Arrows along x and axes, as instances. */

import * as THREE from "three";
import { mergeGeometries } from "three/examples/jsm/utils/BufferGeometryUtils.js";
import { axesGeometry } from "../scene/frames";
import type { Palette } from "../util/theme";
import { axesMaterial } from "./axes";

export interface ArrowShape {
  shaftLength: number;
  shaftRadius: number;
  headLength: number;
  headRadius: number;
}

/** An arrow from the origin along +x. */
export function arrowGeometry(shape: ArrowShape): THREE.BufferGeometry {
  const shaft = new THREE.CylinderGeometry(shape.shaftRadius, shape.shaftRadius, shape.shaftLength, 12);
  shaft.translate(0, shape.shaftLength / 2, 0);
  const head = new THREE.ConeGeometry(shape.headRadius, shape.headLength, 16);
  head.translate(0, shape.shaftLength + shape.headLength / 2, 0);
  const arrow = mergeGeometries([shaft, head]);
  arrow.rotateZ(-Math.PI / 2);
  shaft.dispose();
  head.dispose();
  return arrow;
}

/** A flat arrow of length 1 along +x, in the plane of x and y. */
export function flatArrowGeometry(): THREE.BufferGeometry {
  const outline: [number, number][] = [
    [0, -0.02],
    [0.75, -0.02],
    [0.75, -0.12],
    [1, 0],
    [0.75, 0.12],
    [0.75, 0.02],
    [0, 0.02],
  ];
  return new THREE.ShapeGeometry(new THREE.Shape(outline.map(([x, y]) => new THREE.Vector2(x, y))));
}

/** One mesh for all poses, which are rows of x, y, z, qx, qy, qz, qw. */
export function instances(
  geometry: THREE.BufferGeometry,
  material: THREE.Material,
  poses: Float32Array,
  scale: number | ((i: number) => number) = 1,
): THREE.InstancedMesh {
  const count = Math.floor(poses.length / 7);
  const mesh = new THREE.InstancedMesh(geometry, material, count);
  const matrix = new THREE.Matrix4();
  const position = new THREE.Vector3();
  const quaternion = new THREE.Quaternion();
  const size = new THREE.Vector3();
  for (let i = 0; i < count; i++) {
    const row = poses.subarray(i * 7, i * 7 + 7);
    const own = typeof scale === "number" ? scale : scale(i);
    size.setScalar(row.every(Number.isFinite) ? own : 0);
    matrix.compose(position.fromArray(row), quaternion.fromArray(row, 3).normalize(), size);
    mesh.setMatrixAt(i, matrix);
  }
  mesh.frustumCulled = false;
  return mesh;
}

/** Poses as axes instead of arrows. */
export function poseAxes(poses: Float32Array, palette: Palette, length: number, radius: number): THREE.Object3D {
  const material = axesMaterial(1);
  material.vertexShader = material.vertexShader
    .replace("normalMatrix * normal", "normalMatrix * mat3(instanceMatrix) * normal")
    .replace("modelViewMatrix *", "modelViewMatrix * instanceMatrix *");
  return instances(axesGeometry(palette, radius / Math.max(length, 1e-6)), material, poses, length);
}
