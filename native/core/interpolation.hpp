// SPDX-License-Identifier: Apache-2.0
// The interpolation between two poses, one pair at a time. Many pairs are interpolated by the kernels.
#pragma once

#include <cmath>

#include "core/pose.hpp"

namespace coframe {

namespace interpolation {

inline double root(double number) { return std::sqrt(number); }
inline bool all_above(double number, double limit) { return number > limit; }

#define COFRAME_INLINE inline
#include "core/interpolation.inc"
#undef COFRAME_INLINE

}  // namespace interpolation

// Computes the pose at the fraction t in [0, 1] from a to b.
inline void interpolate(const Pose& a, const Pose& b, double t, Pose& out) {
  const interpolation::Arc arc = interpolation::shorter_arc(dot(a.q, b.q));
  const auto [first, second, angle_by_sine] = interpolation::weights_at<false>(t, arc.cosine);
  const auto [start, end] = interpolation::line_weights(t);
  for (int i = 0; i < 4; ++i) out.q[i] = first * a.q[i] + arc.sign * second * b.q[i];
  for (int i = 0; i < 3; ++i) out.p[i] = start * a.p[i] + end * b.p[i];
}

}  // namespace coframe
