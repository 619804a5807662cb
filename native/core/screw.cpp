// SPDX-License-Identifier: Apache-2.0
#include "core/screw.hpp"

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
  const double axial_length = n.x * p.x + n.y * p.y + n.z * p.z;
  const Vector radial_vector = sum(1.0, p, -axial_length, n);
  // Across the axis both motions are rotations about one point, so the fraction is (R(share) - I) (R - I)^-1 across,
  // with (R - I)^-1 = -1/2 (I + cot(half) [n]).
  const Vector root = sum(-0.5, radial_vector, -0.5 / std::tan(half), cross(n, radial_vector));
  const double sine_part = std::sin(half * share);
  const double versine = 2.0 * sine_part * sine_part;  // 1 - cos of the fraction's angle
  const Vector plane = sum(-versine, root, std::sin(2.0 * half * share), cross(n, root));
  part.p[0] = share * axial_length * n.x + plane.x;
  part.p[1] = share * axial_length * n.y + plane.y;
  part.p[2] = share * axial_length * n.z + plane.z;
  part.q[0] = sine_part * n.x;
  part.q[1] = sine_part * n.y;
  part.q[2] = sine_part * n.z;
  part.q[3] = std::cos(half * share);
  return part;
}

Pose along_screw_motion(const Pose& a, const Pose& b, double share) {
  Pose motion = b;  // relative to a
  compose_inverse(a, motion);
  Pose pose = part_of_motion(motion, share);
  compose(a, pose);
  return pose;
}

}  // namespace coframe
