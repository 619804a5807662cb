// SPDX-License-Identifier: Apache-2.0
// Forward kinematics, joint by joint, for several configurations per register.
#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/pose_rows.hpp"
#include "kernels/rotation.hpp"
#include "kernels/sine.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

using Positions = const double (*)[kRowBlock];

COFRAME_INLINE Quaternion<Lanes> rotated_about_axis(const JointMotion& joint, const Lanes& angle) {
  Lanes s, c;
  sine_and_cosine(0.5 * angle, s, c);
  const double *rest = joint.origin.q, *turn = joint.half_turn;
  return {c * rest[0] + s * turn[0], c * rest[1] + s * turn[1], c * rest[2] + s * turn[2], c * rest[3] + s * turn[3]};
}

COFRAME_INLINE Vector<Lanes> translated(const Vector<Lanes>& from, const double* direction, const Lanes& distance) {
  return {from.x + distance * direction[0], from.y + distance * direction[1], from.z + distance * direction[2]};
}

// Computes the motion of the joint for the configurations from `i` on. `not_finite` becomes NaN if a position is not
// finite.
template <JointKind kKind>
COFRAME_INLINE PoseLanes step_at(const JointMotion& joint, Positions positions, std::size_t i, Lanes& not_finite) {
  const auto position = [&](int column) {
    const Lanes lanes = load_lanes(positions[column] + i);
    not_finite = not_finite + (lanes - lanes);
    return lanes;
  };
  PoseLanes step = splat(joint.origin);
  if constexpr (kKind == JointKind::rotating) {
    step.q = rotated_about_axis(joint, position(0));
  } else if constexpr (kKind == JointKind::prismatic) {
    step.p = translated(step.p, joint.directions[0], position(0));
  } else if constexpr (kKind == JointKind::planar) {
    step.p = translated(translated(step.p, joint.directions[0], position(0)), joint.directions[1], position(1));
    step.q = rotated_about_axis(joint, position(2));
  } else if constexpr (kKind == JointKind::floating) {
    const PoseLanes pose{{position(3), position(4), position(5), position(6)}, {position(0), position(1), position(2)}};
    step = transformed<false>(step, pose);
  }
  return step;
}

template <JointKind kKind>
bool follow(const JointMotion& joint, Positions positions, std::size_t n, const PoseRows* parents, PoseRows* poses,
            double* out) {
  Lanes not_finite = splat(0.0);
  for (std::size_t i = 0; i < n; i += kLanes) {
    PoseLanes pose = step_at<kKind>(joint, positions, i, not_finite);
    if (parents) pose = transformed<false>(load(*parents, i), pose);
    if (poses) store(pose, *poses, i);
    write(pose, i, n, out);
  }
  return all_above(not_finite, -1.0);
}

}  // namespace

bool compute_joint_poses(const JointMotion& joint, Positions positions, std::size_t n, const PoseRows* parents,
                         PoseRows* poses, double* out) {
  switch (joint.kind) {
    case JointKind::rotating: return follow<JointKind::rotating>(joint, positions, n, parents, poses, out);
    case JointKind::prismatic: return follow<JointKind::prismatic>(joint, positions, n, parents, poses, out);
    case JointKind::planar: return follow<JointKind::planar>(joint, positions, n, parents, poses, out);
    case JointKind::floating: return follow<JointKind::floating>(joint, positions, n, parents, poses, out);
    case JointKind::fixed: break;
  }
  return follow<JointKind::fixed>(joint, positions, n, parents, poses, out);
}

}  // namespace coframe::COFRAME_LEVEL
