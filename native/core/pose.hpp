// SPDX-License-Identifier: Apache-2.0
// A rigid pose and its algebra: unit quaternions (x, y, z, w) and translations in metres.
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

// Normalises `q` and picks the same sign as tf2, which converts to a rotation matrix and back: w positive where the
// matrix has a positive trace (w^2 > 1/4), else the largest of x, y, z positive. A zero, infinite or NaN quaternion, or
// one whose squared length underflows or overflows, becomes NaN.
inline void canonicalise(double* q) {
  const double length2 = dot(q, q);
  constexpr double kLeast = 2.0 / std::numeric_limits<double>::max();  // tf2 divides 2 by the squared length
  if (!(length2 > kLeast) || !std::isfinite(length2)) {
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

// sin(t theta) / sin(theta) as a series in y = cos(theta) - 1 with K terms (after D. Eberly, "A Fast and Accurate
// Algorithm for Computing SLERP"). It avoids libm calls, which took most of the time of a lookup.
template <int K>
inline double slerp_weight_series(double t, double y) {
  const double t2 = t * t;
  double sum = 1.0;
  for (int j = K; j >= 1; --j) {
    const double u = 1.0 / (j * (2.0 * j + 1.0));
    const double v = j / (2.0 * j + 1.0);
    sum = 1.0 + (t2 * u - v) * y * sum;
  }
  return t * sum;
}

// How small y = cos(theta) - 1 may be for 4 and for 8 terms; that keeps the series within 1e-15.
inline constexpr double kShortSeries = -1.2e-3, kLongSeries = -3.3e-2;

// Weights of both ends for the share t in [0, 1]; `cosine` in [0, 1].
inline void slerp_weights(double cosine, double t, double& first, double& second) {
  const double y = std::min(cosine, 1.0) - 1.0;
  if (y > kShortSeries) {
    first = slerp_weight_series<4>(1.0 - t, y);
    second = slerp_weight_series<4>(t, y);
  } else if (y > kLongSeries) {
    first = slerp_weight_series<8>(1.0 - t, y);
    second = slerp_weight_series<8>(t, y);
  } else {
    const double theta = std::acos(cosine);
    const double scale = 1.0 / std::sin(theta);
    first = std::sin((1.0 - t) * theta) * scale;
    second = std::sin(t * theta) * scale;
  }
}

// Straight line for the translation, shortest great arc for the rotation.
inline void interpolate(const Pose& a, const Pose& b, double t, Pose& out) {
  double cosine = dot(a.q, b.q);
  double sign = 1.0;
  if (cosine < 0.0) {
    cosine = -cosine;
    sign = -1.0;
  }
  double first, second;
  slerp_weights(cosine, t, first, second);
  second *= sign;
  for (int i = 0; i < 4; ++i) out.q[i] = first * a.q[i] + second * b.q[i];
  for (int i = 0; i < 3; ++i) out.p[i] = (1.0 - t) * a.p[i] + t * b.p[i];
}

}  // namespace coframe
