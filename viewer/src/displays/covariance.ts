// SPDX-License-Identifier: Apache-2.0
/** The covariance of a pose: an ellipsoid for the position, and a cone around the x axis for the orientation. */

import * as THREE from "three";
import { principalAxes } from "../util/math";
import type { OptionSpec, Options } from "./options";

export const COVARIANCE_SPECS: readonly OptionSpec[] = [
  { key: "Covariance/Value", label: "Covariance", kind: "flag", value: false },
  flag("Position"),
  number("Position", "Scale", { value: 1, max: 1000, step: 1 }),
  colour("Position", "#cc33cc"),
  number("Position", "Alpha", { value: 0.3, max: 1, step: 0.05 }),
  flag("Orientation"),
  number("Orientation", "Scale", { value: 1, max: 1000, step: 1 }),
  number("Orientation", "Offset", { value: 1, max: 100, step: 0.1, unit: "m" }),
  colour("Orientation", "#ffff7f"),
  number("Orientation", "Alpha", { value: 0.5, max: 1, step: 0.05 }),
];

type Part = "Position" | "Orientation";

function flag(part: Part): OptionSpec {
  return { key: `Covariance/${part}/Value`, label: part, needs: "Covariance/Value", kind: "flag", value: true };
}

function colour(part: Part, value: string): OptionSpec {
  return { ...nested(part, "Color"), kind: "colour", value };
}

function number(
  part: Part,
  name: string,
  rest: { value: number; max: number; step: number; unit?: string },
): OptionSpec {
  return { ...nested(part, name), kind: "number", min: 0, ...rest };
}

function nested(part: Part, name: string): { key: string; label: string; needs: string } {
  return { key: `Covariance/${part}/${name}`, label: `${part} ${name}`, needs: "Covariance/Value" };
}

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
  options: Options,
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

function ellipsoid(at: Covariance, options: Options): THREE.Mesh[] {
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
function orientationCone(at: Covariance, options: Options): THREE.Mesh[] {
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

function material(options: Options, part: Part): THREE.Material {
  return new THREE.MeshLambertMaterial({
    color: options.colour(`Covariance/${part}/Color`),
    transparent: true,
    opacity: options.number(`Covariance/${part}/Alpha`),
    side: THREE.DoubleSide,
    depthWrite: false,
  });
}
