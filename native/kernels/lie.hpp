// SPDX-License-Identifier: Apache-2.0
// Exponentials and logarithms of several poses at a time. A twist is the velocity of a body for one unit of time,
// expressed in the body: the linear part v, then the angular part w.
//
// With the angle a = |w| (J. Sola et al., "A micro Lie theory for state estimation in robotics", equations 172 to 179):
//   exp: rotation about w by a; translation v + (1 - cos a) / a^2 w x v + (a - sin a) / a^3 w x (w x v)
//   log: w = angle times axis;  v = p - 1/2 w x p + (1 - a / 2 cot(a / 2)) / a^2 w x (w x p)
// Both are computed from half the angle, which the quaternion contains: 1 - cos a = 2 sin^2(a / 2), and cot(a / 2) is w
// of the quaternion divided by the length of x, y, z. That is exact up to a = pi. For small angles the last factors are
// Taylor series, whose next term is below 1e-17.
#pragma once

#include "kernels/arctangent.hpp"
#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/pose_rows.hpp"
#include "kernels/rotation.hpp"
#include "kernels/sine.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

constexpr double kSmallAngle2 = 1e-2;  // squared; the quotients below lose digits below it
constexpr double kNoAngle2 = 1e-290;   // squared; below it the squares underflow

COFRAME_INLINE Lanes squared_length(const Vector<Lanes>& v) { return v.x * v.x + v.y * v.y + v.z * v.z; }

COFRAME_INLINE PoseLanes exponential(const TwistLanes& twist) {
  const Lanes angle2 = squared_length(twist.angular), angle = root(angle2);
  Lanes sine, cosine;
  sine_and_cosine(Lanes(0.5 * angle), sine, cosine);
  const Lanes one = splat(1.0), quotient = 2.0 * sine / angle;
  const Lanes by_half = angle2 < splat(kNoAngle2) ? one : quotient;  // sin(a / 2) / (a / 2)
  const Lanes series =
      1.0 / 6.0 -
      angle2 * (1.0 / 120.0 - angle2 * (1.0 / 5040.0 - angle2 * (1.0 / 362880.0 - angle2 * (1.0 / 39916800.0))));
  const Lanes exact = (1.0 - by_half * cosine) / angle2;  // sin a / a = sin(a / 2) / (a / 2) cos(a / 2)
  const Lanes second = angle2 < splat(kSmallAngle2) ? series : exact;
  const Vector<Lanes> once = cross(twist.angular, twist.linear);
  const Lanes half = 0.5 * by_half;
  return {{half * twist.angular.x, half * twist.angular.y, half * twist.angular.z, cosine},
          twist.linear + Lanes(0.5 * by_half * by_half) * once + second * cross(twist.angular, once)};
}

// The rotation by at most half a turn; pi if w is 0.
COFRAME_INLINE TwistLanes logarithm(const PoseLanes& pose) {
  const Lanes one = splat(1.0), sign = pose.q.w < splat(0.0) ? -one : one;
  const Vector<Lanes> u = sign * Vector<Lanes>{pose.q.x, pose.q.y, pose.q.z};
  const Lanes w = sign * pose.q.w;
  const Lanes length2 = squared_length(u), length = root(length2);
  const Lanes half = arctangent(length, w);
  const Lanes limit = 2.0 / w, quotient = 2.0 * half / length;
  const Vector<Lanes> angular = Lanes(length2 < splat(kNoAngle2) ? limit : quotient) * u;
  const Lanes angle2 = 4.0 * half * half;
  const Lanes series =
      1.0 / 12.0 +
      angle2 * (1.0 / 720.0 + angle2 * (1.0 / 30240.0 + angle2 * (1.0 / 1209600.0 + angle2 * (1.0 / 47900160.0))));
  const Lanes exact = (1.0 - half * w / length) / angle2;
  const Lanes second = angle2 < splat(kSmallAngle2) ? series : exact;
  const Vector<Lanes> once = cross(angular, pose.p);
  return {pose.p - Lanes(splat(0.5)) * once + second * cross(angular, once), angular};
}

COFRAME_INLINE TwistLanes scaled(const Lanes& factor, const TwistLanes& twist) {
  return {factor * twist.linear, factor * twist.angular};
}

// The pose at the fraction t of the screw motion from a to b.
COFRAME_INLINE PoseLanes along_screw(const PoseLanes& a, const PoseLanes& b, const Lanes& t) {
  return transformed<false>(a, exponential(scaled(t, logarithm(transformed<true>(a, b)))));
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
