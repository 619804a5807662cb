// SPDX-License-Identifier: Apache-2.0
#include "core/extrapolation.hpp"

#include <algorithm>
#include <cmath>

namespace coframe {

namespace {

struct Vector {
  double x, y, z;
};

Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vector sum(double a, const Vector& u, double b, const Vector& v) {
  return {a * u.x + b * v.x, a * u.y + b * v.y, a * u.z + b * v.z};
}

// Returns the nearest neighbor of the first or last sample that has another stamp and the same parent; that sample
// itself if there is none.
std::size_t neighbor(const History::View& samples, std::size_t end, bool forward) {
  const Stamp stamp = samples.time(end);
  for (std::size_t i = end; forward ? i > 0 : i + 1 < samples.size();) {
    i = forward ? i - 1 : i + 1;
    if (samples.parent_at(i) != samples.parent_at(end)) break;
    if (samples.time(i) != stamp) return i;
  }
  return end;
}

}  // namespace

// A screw motion (Chasles' theorem): rotation and translation along the axis grow in proportion, and across the axis
// the frame rotates about the screw's center.
Pose part_of_motion(const Pose& motion, double share) {
  Pose part;
  const double* q = motion.q;
  const double sign = q[3] < 0.0 ? -1.0 : 1.0;  // the shorter rotation
  const double sine = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2]);
  if (sine < 1e-100) {  // no rotation
    for (int i = 0; i < 3; ++i) part.p[i] = share * motion.p[i];
    return part;
  }
  const Vector p{motion.p[0], motion.p[1], motion.p[2]};
  const Vector n{sign * q[0] / sine, sign * q[1] / sine, sign * q[2] / sine};
  const double half = std::atan2(sine, sign * q[3]);  // half of the angle, in (0, pi/2]
  const double along = n.x * p.x + n.y * p.y + n.z * p.z;
  const Vector across = sum(1.0, p, -along, n);
  // Across the axis both motions are rotations about one point, so the fraction is (R(share) - I) (R - I)^-1 across,
  // with (R - I)^-1 = -1/2 (I + cot(half) [n]).
  const Vector root = sum(-0.5, across, -0.5 / std::tan(half), cross(n, across));
  const double sine_part = std::sin(half * share);
  const double versine = 2.0 * sine_part * sine_part;  // 1 - cos of the fraction's angle
  const Vector plane = sum(-versine, root, std::sin(2.0 * half * share), cross(n, root));
  part.p[0] = share * along * n.x + plane.x;
  part.p[1] = share * along * n.y + plane.y;
  part.p[2] = share * along * n.z + plane.z;
  part.q[0] = sine_part * n.x;
  part.q[1] = sine_part * n.y;
  part.q[2] = sine_part * n.z;
  part.q[3] = std::cos(half * share);
  return part;
}

Found Extrapolation::at(const History::View& samples, Stamp stamp, Pose& pose, FrameId& parent) {
  const Found found = samples.at(stamp, pose, parent);
  if (found == Found::ok || found == Found::empty) return found;
  const bool forward = found == Found::too_new || (found == Found::only_other && stamp > samples.time(0));
  const std::size_t end = forward ? samples.size() - 1 : 0;
  const std::uint64_t beyond = distance(stamp, samples.time(end));
  if (beyond > static_cast<std::uint64_t>(limit)) return found;
  furthest = std::max(furthest, static_cast<Stamp>(beyond));
  const Sample last = samples.sample(end);
  pose = last.pose;
  parent = last.parent;
  const std::size_t before = method == Method::twist ? neighbor(samples, end, forward) : end;
  if (before == end) return Found::ok;
  Pose motion = last.pose;  // the end sample relative to its neighbor
  compose_inverse(samples.sample(before).pose, motion);
  const double step = static_cast<double>(distance(samples.time(end), samples.time(before)));
  pose = part_of_motion(motion, static_cast<double>(beyond) / step);
  compose(last.pose, pose);
  return Found::ok;
}

}  // namespace coframe
