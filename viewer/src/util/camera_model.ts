// SPDX-License-Identifier: Apache-2.0
/** Projects points into the images of cameras with lens distortion, as OpenCV does. */

export interface Intrinsics {
  width: number;
  height: number;
  /** The 3x3 matrix in row-major order. */
  k: readonly (number | null)[];
  /** The 3x4 matrix of rectified images in row-major order. */
  p?: readonly (number | null)[];
  distortion_model: string;
  d: readonly (number | null)[];
}

/** Returns the pixel of a point in the optical frame (REP 103); null if the camera cannot see it. */
export type Project = (x: number, y: number, z: number) => [u: number, v: number] | null;

/** Moves a point of the image plane at z = 1 as the lens does. */
type Distort = (x: number, y: number) => [number, number];

const NEAREST_M = 1e-3;
/** The distance from the axis, in units of the focal length, up to which the distortion is examined. */
const MAX_RADIUS = 8;
const RADIUS_STEP = 0.005;

/** Returns a projection, or the reason why there is none. */
export function projection(camera: Intrinsics, rectified: boolean): Project | string {
  const numbers = (rectified ? (camera.p ?? []) : camera.k).map((value) => value ?? NaN);
  const [fx, fy, cx, cy] = rectified
    ? [numbers[0], numbers[5], numbers[2], numbers[6]]
    : [numbers[0], numbers[4], numbers[2], numbers[5]];
  if (fx === undefined || fy === undefined || cx === undefined || cy === undefined || !(fx > 0 && fy > 0))
    return `The CameraInfo contains no calibration: fx and fy of ${rectified ? "P" : "K"} must be positive.`;
  const lens = rectified ? { distort: none, radius: Infinity } : distortion(camera);
  if (typeof lens === "string") return lens;
  const { distort, radius } = lens;
  return (x, y, z) => {
    if (!(z > NEAREST_M)) return null;
    const [a, b] = [x / z, y / z];
    // Beyond this radius the polynomial turns back into the image.
    if (a * a + b * b > radius * radius) return null;
    const [u, v] = distort(a, b);
    return [fx * u + cx, fy * v + cy];
  };
}

function none(x: number, y: number): [number, number] {
  return [x, y];
}

function distortion(camera: Intrinsics): { distort: Distort; radius: number } | string {
  const d = camera.d.map((value) => value ?? NaN);
  const { distortion_model: model } = camera;
  if (d.every((value) => value === 0)) return { distort: none, radius: Infinity };
  if (!d.every(Number.isFinite)) return "The CameraInfo contains an invalid distortion.";
  if (model === "equidistant" && d.length >= 4) return bounded(equidistant(d));
  if (["plumb_bob", "rational_polynomial", ""].includes(model) && d.length >= 4 && d.length <= 12)
    return bounded(polynomial(d));
  return (
    `The distortion model “${model.slice(0, 40)}” with ${d.length} coefficients is not supported. ` +
    "Supported: plumb_bob, rational_polynomial, equidistant."
  );
}

/** Radial, tangential and thin prism distortion: k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4. */
function polynomial(d: readonly number[]): Distort {
  const [k1, k2, p1, p2, k3 = 0, k4 = 0, k5 = 0, k6 = 0, s1 = 0, s2 = 0, s3 = 0, s4 = 0] = d as [
    number,
    number,
    number,
    number,
    ...number[],
  ];
  return (x, y) => {
    const r2 = x * x + y * y;
    const r4 = r2 * r2;
    const r6 = r4 * r2;
    const radial = (1 + k1 * r2 + k2 * r4 + k3 * r6) / (1 + k4 * r2 + k5 * r4 + k6 * r6);
    return [
      x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x) + s1 * r2 + s2 * r4,
      y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y + s3 * r2 + s4 * r4,
    ];
  };
}

/** Fisheye lenses: the angle to the axis determines the radius. */
function equidistant([k1, k2, k3, k4]: readonly number[]): Distort {
  return (x, y) => {
    const r = Math.hypot(x, y);
    if (r < 1e-9) return [x, y];
    const angle = Math.atan(r);
    const a2 = angle * angle;
    const powers = (k1 as number) + a2 * ((k2 as number) + a2 * ((k3 as number) + a2 * (k4 as number)));
    const scale = (angle * (1 + a2 * powers)) / r;
    return [x * scale, y * scale];
  };
}

/** Finds the radius up to which points further from the axis are further from the center of the image, too. */
function bounded(distort: Distort): { distort: Distort; radius: number } {
  let last = 0;
  for (let radius = RADIUS_STEP; radius <= MAX_RADIUS; radius += RADIUS_STEP) {
    const [u] = distort(radius, 0);
    if (!(u > last)) return { distort, radius: radius - RADIUS_STEP };
    last = u;
  }
  return { distort, radius: MAX_RADIUS };
}
