// SPDX-License-Identifier: Apache-2.0
/** The covariance of a pose: an ellipsoid for the position, and a cone around the x axis for the orientation. */

import * as THREE from "three";
import { principalAxes } from "../util/math";
import type { Options } from "./options";

type Part = "Position" | "Orientation";
type CovarianceOptions = Options<"PoseWithCovariance" | "Odometry">;

/** The largest half angle of the cone in radians; at π/2 it would be a disc. */
const MAX_HALF_ANGLE = 1.5;

/**
 * Draws the covariance of a pose.
 *
 * @param pose x, y, z, qx, qy, qz, qw.
 * @param covariance 6x6 in row-major order: x, y, z along the axes of the message's frame, and rotations about the axes
 *   of the pose.
 */
export function covarianceShapes(
  pose: Float32Array,
  covariance: readonly (number | null)[],
  options: CovarianceOptions,
): THREE.Object3D {
  const group = new THREE.Group();
  if (!options.flag("Covariance/Value") || covariance.length !== 36 || !pose.every(Number.isFinite)) return group;
  const at = (i: number, j: number): number => ((covariance[i * 6 + j] ?? NaN) + (covariance[j * 6 + i] ?? NaN)) / 2;
  group.position.fromArray(pose);
  if (options.flag("Covariance/Position/Value")) group.add(...ellipsoid(at, options));
  if (options.flag("Covariance/Orientation/Value")) {
    const cone = orientationCone(at, options);
    for (const part of cone) part.quaternion.premultiply(new THREE.Quaternion().fromArray(pose, 3).normalize());
    group.add(...cone);
  }
  return group;
}

type Covariance = (i: number, j: number) => number;

function ellipsoid(at: Covariance, options: CovarianceOptions): THREE.Mesh[] {
  const indices = [0, 1, 2];
  const axes = principalAxes(indices.flatMap((i) => indices.map((j) => at(i, j))));
  const radii = axes.variances.map((variance) => Math.sqrt(variance) * options.number("Covariance/Position/Scale"));
  if (!radii.every(Number.isFinite)) return [];
  const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 24, 16), material(options, "Position"));
  // A radius of zero would make the normals invalid, and the ellipsoid black.
  mesh.scale.fromArray(radii.map((radius) => Math.max(radius, 1e-6)));
  mesh.quaternion.fromArray(axes.quaternion);
  return [mesh];
}

/** A rotation about z moves the tip of the x axis along +y; a rotation about y moves it along -z. */
function orientationCone(at: Covariance, options: CovarianceOptions): THREE.Mesh[] {
  const yz = -at(4, 5);
  const axes = principalAxes([0, 0, 0, 0, at(5, 5), yz, 0, yz, at(4, 4)]);
  const length = options.number("Covariance/Orientation/Offset");
  const [, y, z] = axes.variances.map((variance) => {
    const angle = Math.sqrt(variance) * options.number("Covariance/Orientation/Scale");
    return Math.max(1e-6, length * Math.tan(Math.min(MAX_HALF_ANGLE, angle)));
  }) as [number, number, number];
  if (!Number.isFinite(y) || !Number.isFinite(z) || length === 0) return [];
  const cone = new THREE.ConeGeometry(1, 1, 32, 1, true).translate(0, -0.5, 0).rotateZ(Math.PI / 2);
  const mesh = new THREE.Mesh(cone, material(options, "Orientation"));
  mesh.scale.set(length, y, z);
  mesh.quaternion.fromArray(axes.quaternion);
  return [mesh];
}

function material(options: CovarianceOptions, part: Part): THREE.Material {
  return new THREE.MeshLambertMaterial({
    color: options.color(`Covariance/${part}/Color`),
    transparent: true,
    opacity: options.number(`Covariance/${part}/Alpha`),
    side: THREE.DoubleSide,
    depthWrite: false,
  });
}
