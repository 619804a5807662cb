// SPDX-License-Identifier: Apache-2.0
/** Rigid transforms in float64. Quaternions are x, y, z, w, as in ROS. */

export type Vector = [number, number, number];

export type Quaternion = [number, number, number, number];

export interface Pose {
  position: Vector;
  quaternion: Quaternion;
}

const SWEEPS = 12;

export const IDENTITY: Pose = { position: [0, 0, 0], quaternion: [0, 0, 0, 1] };

export function multiply(a: Quaternion, b: Quaternion): Quaternion {
  const [ax, ay, az, aw] = a;
  const [bx, by, bz, bw] = b;
  return [
    aw * bx + ax * bw + ay * bz - az * by,
    aw * by - ax * bz + ay * bw + az * bx,
    aw * bz + ax * by - ay * bx + az * bw,
    aw * bw - ax * bx - ay * by - az * bz,
  ];
}

export function normalize(q: Quaternion): Quaternion {
  const n = Math.hypot(...q);
  return n > 0 ? [q[0] / n, q[1] / n, q[2] / n, q[3] / n] : [0, 0, 0, 1];
}

export function rotate(q: Quaternion, v: Vector): Vector {
  const [x, y, z, w] = q;
  const tx = 2 * (y * v[2] - z * v[1]);
  const ty = 2 * (z * v[0] - x * v[2]);
  const tz = 2 * (x * v[1] - y * v[0]);
  return [v[0] + w * tx + y * tz - z * ty, v[1] + w * ty + z * tx - x * tz, v[2] + w * tz + x * ty - y * tx];
}

/** a ∘ b: the pose b, which is expressed in frame a, expressed in the parent of a. */
export function compose(a: Pose, b: Pose): Pose {
  const moved = rotate(a.quaternion, b.position);
  return {
    position: [a.position[0] + moved[0], a.position[1] + moved[1], a.position[2] + moved[2]],
    quaternion: normalize(multiply(a.quaternion, b.quaternion)),
  };
}

export function inverse(a: Pose): Pose {
  const quaternion: Quaternion = [-a.quaternion[0], -a.quaternion[1], -a.quaternion[2], a.quaternion[3]];
  const back = rotate(quaternion, a.position);
  return { position: [-back[0], -back[1], -back[2]], quaternion };
}

/** Interpolates between two poses as native/core does: on a straight line, and on the shorter great arc (slerp). */
export function interpolate(a: Pose, b: Pose, part: number): Pose {
  const [p, q] = [a.position, b.position];
  const [rotation, other] = [a.quaternion, nearestSign(a.quaternion, b.quaternion)];
  const [first, second] = arcWeights(rotation, other, part);
  const line = (k: 0 | 1 | 2): number => (1 - part) * p[k] + part * q[k];
  const arc = (k: 0 | 1 | 2 | 3): number => first * rotation[k] + second * other[k];
  return { position: [line(0), line(1), line(2)], quaternion: normalize([arc(0), arc(1), arc(2), arc(3)]) };
}

/** b or -b, which are the same rotation: the one that is nearer to a. */
function nearestSign(a: Quaternion, [x, y, z, w]: Quaternion): Quaternion {
  return a[0] * x + a[1] * y + a[2] * z + a[3] * w < 0 ? [-x, -y, -z, -w] : [x, y, z, w];
}

function arcWeights(a: Quaternion, b: Quaternion, part: number): [number, number] {
  // More precise for small angles than the arc cosine.
  const half = Math.atan2(Math.hypot(...a.map((v, k) => v - at(b, k))), Math.hypot(...a.map((v, k) => v + at(b, k))));
  const angle = 2 * half;
  if (angle === 0) return [1 - part, part];
  return [Math.sin((1 - part) * angle) / Math.sin(angle), Math.sin(part * angle) / Math.sin(angle)];
}

function at(values: readonly number[], k: number): number {
  return values[k] as number;
}

/** The pose of `source` relative to `target`; both are expressed in the same frame. */
export function relativePose(target: Pose, source: Pose): Pose {
  return compose(inverse(target), source);
}

/** Roll, pitch, yaw about the fixed axes x, y, z, in degrees: tf2's getRPY. */
export function rpyDegrees(q: Quaternion): Vector {
  const [x, y, z, w] = q;
  const sinPitch = Math.max(-1, Math.min(1, 2 * (w * y - z * x)));
  const degrees = 180 / Math.PI;
  if (Math.abs(sinPitch) > 1 - 1e-12) {
    // At pitch ±90° only the sum or difference of roll and yaw is defined. Roll is set to zero.
    const yaw = -2 * Math.sign(sinPitch) * Math.atan2(x, w);
    return [0, Math.sign(sinPitch) * 90, Math.atan2(Math.sin(yaw), Math.cos(yaw)) * degrees];
  }
  return [
    Math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)) * degrees,
    Math.asin(sinPitch) * degrees,
    Math.atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) * degrees,
  ];
}

/**
 * The principal axes of a covariance as a rotation, and the variance along each axis, by Jacobi's method. The matrix is
 * 3x3, symmetric and in row-major order. An axis that is not correlated with the others stays unchanged.
 */
export function principalAxes(matrix: readonly number[]): { variances: Vector; quaternion: Quaternion } {
  const m = [...matrix];
  const at = (i: number, j: number): number => m[i * 3 + j] as number;
  let axes: Quaternion = [0, 0, 0, 1];
  for (let sweep = 0; sweep < SWEEPS; sweep++)
    for (const [p, q, r] of [
      [0, 1, 2],
      [1, 2, 0],
      [2, 0, 1],
    ] as const) {
      if (Math.abs(at(p, q)) < 1e-300) continue;
      const angle = 0.5 * Math.atan2(2 * at(p, q), at(p, p) - at(q, q));
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (let k = 0; k < 3; k++) {
        const [kp, kq] = [at(k, p), at(k, q)];
        m[k * 3 + p] = c * kp + s * kq;
        m[k * 3 + q] = c * kq - s * kp;
      }
      for (let k = 0; k < 3; k++) {
        const [pk, qk] = [at(p, k), at(q, k)];
        m[p * 3 + k] = c * pk + s * qk;
        m[q * 3 + k] = c * qk - s * pk;
      }
      const rotation: Quaternion = [0, 0, 0, Math.cos(angle / 2)];
      rotation[r] = Math.sin(angle / 2);
      axes = multiply(axes, rotation);
    }
  return { variances: [at(0, 0), at(1, 1), at(2, 2)], quaternion: normalize(axes) };
}

/** The 4x4 matrix in row-major order. */
export function matrix({ position, quaternion }: Pose): number[] {
  const x = rotate(quaternion, [1, 0, 0]);
  const y = rotate(quaternion, [0, 1, 0]);
  const z = rotate(quaternion, [0, 0, 1]);
  // prettier-ignore
  return [
    x[0], y[0], z[0], position[0],
    x[1], y[1], z[1], position[1],
    x[2], y[2], z[2], position[2],
    0, 0, 0, 1,
  ];
}

export function distance(a: Vector, b: Vector): number {
  return Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}
