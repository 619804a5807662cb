// SPDX-License-Identifier: Apache-2.0
/** Projects points into the images of cameras, with the formulas of coframe.cameras. */

export interface Intrinsics {
  width: number;
  height: number;
  /** The 3x3 matrix in row-major order. */
  k: readonly (number | null)[];
  /** The 3x4 matrix of rectified images in row-major order. */
  p?: readonly (number | null)[];
  /** The rotation into the rectified frame in row-major order; the identity by default. */
  r?: readonly (number | null)[];
  distortion_model: string;
  d: readonly (number | null)[];
  /** Column, row, width and height of the part that the camera sends; zeros for the full image. */
  roi?: readonly number[];
  /** Pixels that are combined along a row and along a column. */
  binning?: readonly number[];
  /** Why the server does not know the lens. */
  problem?: string;
}

/** Returns the pixel of a point in the optical frame (REP 103); null if the camera cannot see it. */
export type Project = (x: number, y: number, z: number) => [u: number, v: number] | null;

/** Moves a point of the image plane at z = 1 as the lens does. */
type Distort = (x: number, y: number) => [number, number];

const NEAREST_M = 1e-3;
const MAX_ANGLE = Math.PI;
const ANGLE_STEP = 0.002;

/** The size of the image that the camera sends. */
export function imageSize({ width, height, roi, binning }: Intrinsics): { width: number; height: number } {
  const [, , w = 0, h = 0] = roi ?? [];
  const isPart = roi?.some((value) => value > 0);
  const [bx = 1, by = 1] = binning ?? [];
  return { width: Math.floor((isPart ? w : width) / bx), height: Math.floor((isPart ? h : height) / by) };
}

/** Whether the last part of a topic's name, without the transport, is that of a rectified image. */
export function isRectifiedTopic(topic: string): boolean {
  const parts = topic
    .split("/")
    .filter((part) => !/^(compressed(depth)?|theora|ffmpeg|zstd|avif|h26\d|draco)$/i.test(part));
  const words = (text = ""): string[] => text.toLowerCase().split(/[_-]/);
  const isRectified = (part?: string): boolean => words(part).some((word) => /^rect(ified)?$/.test(word));
  const last = parts.at(-1);
  if (isRectified(last)) return true;
  return (
    !words(last).some((word) => /^(raw|unrect(ified)?|distorted)$/.test(word)) && parts.slice(0, -1).some(isRectified)
  );
}

/**
 * The position in the frame of this camera at which P expects its points: the first camera of the stereo pair. If the
 * transforms have a frame there, they contain the baseline, and P must not add it again.
 */
export function firstCamera({ p }: Intrinsics): [x: number, y: number] | null {
  const [fx, tx, fy, ty] = [p?.[0], p?.[3], p?.[5], p?.[7]];
  if (!fx || !fy || (!tx && !ty)) return null;
  return [(tx ?? 0) / fx, (ty ?? 0) / fy];
}

/**
 * Returns a projection, or the reason why there is none.
 *
 * @param baselineInTransforms Points are in the camera's own frame, not in that of the first camera of its pair.
 */
export function projection(camera: Intrinsics, rectified: boolean, baselineInTransforms = false): Project | string {
  const numbers = (rectified ? (camera.p ?? []) : camera.k).map((value) => value ?? NaN);
  const [fx, fy, cx, cy] = rectified
    ? [numbers[0], numbers[5], numbers[2], numbers[6]]
    : [numbers[0], numbers[4], numbers[2], numbers[5]];
  if (fx === undefined || fy === undefined || cx === undefined || cy === undefined || !(fx > 0 && fy > 0))
    return `The CameraInfo contains no calibration: fx and fy of ${rectified ? "P" : "K"} must be positive.`;
  const [left = 0, top = 0] = camera.roi ?? [];
  const [bx = 1, by = 1] = camera.binning ?? [];
  const toImage = (u: number, v: number): [number, number] => [(u - left) / bx, (v - top) / by];
  if (rectified) {
    const [tx, ty] = baselineInTransforms ? [0, 0] : [numbers[3] ?? 0, numbers[7] ?? 0];
    const r = (camera.r ?? []).map((value) => value ?? 0);
    const turned = r.length === 9 && r.some((value) => value !== 0);
    return (x, y, z) => {
      const row = (i: number): number => (r[i] as number) * x + (r[i + 1] as number) * y + (r[i + 2] as number) * z;
      const [a, b, c] = turned ? [row(0), row(3), row(6)] : [x, y, z];
      return c > NEAREST_M ? toImage((fx * a + cx * c + tx) / c, (fy * b + cy * c + ty) / c) : null;
    };
  }
  const lens = lensOf(camera);
  if (typeof lens === "string") return lens;
  return (x, y, z) => {
    const place = lens(x, y, z);
    return place && toImage(fx * place[0] + cx, fy * place[1] + cy);
  };
}

function lensOf(camera: Intrinsics): Project | string {
  const d = camera.d.map((value) => value ?? NaN);
  const { distortion_model: model, problem } = camera;
  if (problem) return problem;
  if (!d.every(Number.isFinite)) return "The CameraInfo contains an invalid distortion.";
  const is = (name: string, ...counts: number[]): boolean => model === name && counts.includes(d.length);
  if (is("equidistant", 4)) return equidistant(d);
  if (is("double_sphere", 2)) return doubleSphere(d);
  if (is("eucm", 2)) return enhancedUnified(d);
  if (is("omni", 5)) return omnidirectional(d);
  if (is("fov", 1)) return planeLens(fieldOfView(d), Infinity);
  if (["plumb_bob", "rational_polynomial", ""].includes(model) && [0, 4, 5, 8, 12, 14].includes(d.length))
    return d.every((value) => value === 0) ? planeLens((x, y) => [x, y], Infinity) : limitRadius(polynomial(d));
  return (
    `The distortion model “${model.slice(0, 40)}” with ${d.length} coefficients is not supported. ` +
    "Supported: plumb_bob, rational_polynomial, equidistant, double_sphere, eucm, omni, fov."
  );
}

/** A lens that moves points of the plane at z = 1, up to a distance from the axis. */
function planeLens(distort: Distort, radius: number): Project {
  return (x, y, z) => {
    if (!(z > NEAREST_M)) return null;
    const [a, b] = [x / z, y / z];
    return a * a + b * b > radius * radius ? null : distort(a, b);
  };
}

/** Radial, tangential, thin prism and tilt: k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, tx, ty. */
function polynomial(d: readonly number[]): Distort {
  const [k1, k2, p1, p2, k3 = 0, k4 = 0, k5 = 0, k6 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0, tx = 0, ty = 0] = d as [
    number,
    number,
    number,
    number,
    ...number[],
  ];
  const [sx, cx, sy, cy] = [Math.sin(tx), Math.cos(tx), Math.sin(ty), Math.cos(ty)];
  // The rows of the rotation of a tilted sensor, about x and then about y.
  const turn = [cy, sy * sx, -sy * cx, 0, cx, sx, sy, -cy * sx, cy * cx] as const;
  const tilt = (x: number, y: number): [number, number] => {
    const [a, b, c] = [0, 3, 6].map(
      (i) => (turn[i] as number) * x + (turn[i + 1] as number) * y + (turn[i + 2] as number),
    ) as [number, number, number];
    return [(turn[8] * a - turn[2] * c) / c, (turn[8] * b - turn[5] * c) / c];
  };
  return (x, y) => {
    const r2 = x * x + y * y;
    const r4 = r2 * r2;
    const r6 = r4 * r2;
    const radial = (1 + k1 * r2 + k2 * r4 + k3 * r6) / (1 + k4 * r2 + k5 * r4 + k6 * r6);
    const u = x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s1 * r2 + s2 * r4;
    const v = y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s3 * r2 + s4 * r4;
    return tx || ty ? tilt(u, v) : [u, v];
  };
}

/** Fisheye lenses: the angle to the axis determines the radius, also behind the image plane. */
function equidistant([k1, k2, k3, k4]: readonly number[]): Project {
  const radius = (angle: number): number => {
    const a2 = angle * angle;
    return angle * (1 + a2 * ((k1 as number) + a2 * ((k2 as number) + a2 * ((k3 as number) + a2 * (k4 as number)))));
  };
  const limit = turningPoint(radius, MAX_ANGLE);
  return (x, y, z) => {
    const r = Math.hypot(x, y);
    const angle = Math.atan2(r, z);
    if (!(angle <= limit)) return null;
    if (r < 1e-9) return z > 0 ? [0, 0] : null;
    const scale = radius(angle) / r;
    return [x * scale, y * scale];
  };
}

function doubleSphere([xi, alpha]: readonly number[] | [number, number]): Project {
  const [s, a] = [xi as number, alpha as number];
  const w1 = a <= 0.5 ? a / (1 - a) : (1 - a) / a;
  const w2 = (w1 + s) / Math.sqrt(2 * w1 * s + s * s + 1);
  return (x, y, z) => {
    const first = Math.hypot(x, y, z);
    const shifted = s * first + z;
    return divide(x, y, a * Math.hypot(x, y, shifted) + (1 - a) * shifted, z > -w2 * first);
  };
}

function enhancedUnified([alpha, beta]: readonly number[]): Project {
  const [a, b] = [alpha as number, beta as number];
  const w = a <= 0.5 ? a / (1 - a) : (1 - a) / a;
  return (x, y, z) => {
    const length = Math.sqrt(b * (x * x + y * y) + z * z);
    return divide(x, y, a * length + (1 - a) * z, z > -w * length);
  };
}

function omnidirectional([xi, ...d]: readonly number[]): Project {
  const [s, distort] = [xi as number, polynomial(d)];
  const lowest = s <= 1 ? s : 1 / s;
  return (x, y, z) => {
    const length = Math.hypot(x, y, z);
    const place = divide(x, y, z + s * length, z > -lowest * length);
    return place && distort(...place);
  };
}

function fieldOfView([w]: readonly number[]): Distort {
  const angle = w as number;
  return (x, y) => {
    const r = Math.hypot(x, y);
    if (r < 1e-9 || angle === 0) return [x, y];
    const scale = Math.atan(2 * r * Math.tan(angle / 2)) / (angle * r);
    return [x * scale, y * scale];
  };
}

function divide(x: number, y: number, by: number, seen: boolean): [number, number] | null {
  return seen && by > 0 ? [x / by, y / by] : null;
}

/** Finds the radius up to which points further from the axis are further from the center of the image, too. */
function limitRadius(distort: Distort): Project {
  const angle = turningPoint((at) => distort(Math.tan(at), 0)[0], Math.PI / 2 - ANGLE_STEP);
  return planeLens(distort, Math.tan(angle));
}

/** Returns the angle up to which a function increases. */
function turningPoint(increasing: (angle: number) => number, end: number): number {
  let last = 0;
  for (let angle = ANGLE_STEP; angle <= end; angle += ANGLE_STEP) {
    const found = increasing(angle);
    if (!(found > last)) return angle - ANGLE_STEP;
    last = found;
  }
  return end;
}
