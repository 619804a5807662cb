// SPDX-License-Identifier: Apache-2.0
// A rigid pose and its algebra: unit quaternions (x, y, z, w) and translations in meters.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace coframe {

struct Pose {
  double q[4] = {0.0, 0.0, 0.0, 1.0};  // x, y, z, w
  double p[3] = {0.0, 0.0, 0.0};
};

inline double dot(const double* a, const double* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

// Normalizes `q` and picks the same sign as tf2, which converts to a rotation matrix and back: w positive where the
// matrix has a positive trace (w^2 > 1/4), else the largest of x, y, z positive. A zero, infinite or NaN quaternion, or
// one whose squared length underflows or overflows, becomes NaN.
inline void canonicalise(double* q) {
  const double length2 = dot(q, q);
  constexpr double kMin = 2.0 / std::numeric_limits<double>::max();  // tf2 divides 2 by the squared length
  if (!(length2 > kMin) || !std::isfinite(length2)) {
    for (int i = 0; i < 4; ++i) q[i] = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  int leading = 3;
  if (4.0 * q[3] * q[3] <= length2) {
    const double x = q[0] * q[0], y = q[1] * q[1], z = q[2] * q[2];
    leading = x < y ? (y < z ? 2 : 1) : (x < z ? 2 : 0);
  }
  const double scale = (q[leading] < 0.0 ? -1.0 : 1.0) / std::sqrt(length2);
  for (int i = 0; i < 4; ++i) q[i] *= scale;
}

// out = v rotated by the unit quaternion q: v + 2 w (u x v) + 2 u x (u x v), u the vector part.
inline void rotate(const double* q, const double* v, double* out) {
  const double tx = 2.0 * (q[1] * v[2] - q[2] * v[1]);
  const double ty = 2.0 * (q[2] * v[0] - q[0] * v[2]);
  const double tz = 2.0 * (q[0] * v[1] - q[1] * v[0]);
  out[0] = v[0] + q[3] * tx + (q[1] * tz - q[2] * ty);
  out[1] = v[1] + q[3] * ty + (q[2] * tx - q[0] * tz);
  out[2] = v[2] + q[3] * tz + (q[0] * ty - q[1] * tx);
}

inline void multiply(const double* a, const double* b, double* out) {
  out[0] = a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1];
  out[1] = a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0];
  out[2] = a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3];
  out[3] = a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2];
}

// pose = step * pose: `pose` seen from step's parent.
inline void compose(const Pose& step, Pose& pose) {
  Pose result;
  multiply(step.q, pose.q, result.q);
  rotate(step.q, pose.p, result.p);
  for (int i = 0; i < 3; ++i) result.p[i] += step.p[i];
  pose = result;
}

// pose = step^-1 * pose: `pose` seen from step's child.
inline void compose_inverse(const Pose& step, Pose& pose) {
  const double conjugate[4] = {-step.q[0], -step.q[1], -step.q[2], step.q[3]};
  const double offset[3] = {pose.p[0] - step.p[0], pose.p[1] - step.p[1], pose.p[2] - step.p[2]};
  Pose result;
  multiply(conjugate, pose.q, result.q);
  rotate(conjugate, offset, result.p);
  pose = result;
}

}  // namespace coframe
