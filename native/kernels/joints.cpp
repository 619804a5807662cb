// SPDX-License-Identifier: Apache-2.0
// Forward kinematics, joint by joint: many configurations in the registers' lanes.
#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/pose_rows.hpp"
#include "kernels/rotation.hpp"
#include "kernels/sine.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

using Positions = const double (*)[kRowBlock];

COFRAME_INLINE Quaternion<Lanes> turned(const JointMotion& joint, const Lanes& angle) {
  Lanes s, c;
  sine_and_cosine(0.5 * angle, s, c);
  const double *rest = joint.origin.q, *turn = joint.turn;
  return {c * rest[0] + s * turn[0], c * rest[1] + s * turn[1], c * rest[2] + s * turn[2], c * rest[3] + s * turn[3]};
}

COFRAME_INLINE Vector<Lanes> slid(const Vector<Lanes>& from, const double* way, const Lanes& metres) {
  return {from.x + metres * way[0], from.y + metres * way[1], from.z + metres * way[2]};
}

// The position of configurations from `i` on; `odd` becomes NaN where one is not finite.
template <JointKind kKind>
COFRAME_INLINE PoseLanes step_at(const JointMotion& joint, Positions positions, std::size_t i, Lanes& odd) {
  const auto position = [&](int column) {
    const Lanes lanes = load_lanes(positions[column] + i);
    odd = odd + (lanes - lanes);
    return lanes;
  };
  PoseLanes step = splat(joint.origin);
  if constexpr (kKind == JointKind::turning) {
    step.q = turned(joint, position(0));
  } else if constexpr (kKind == JointKind::sliding) {
    step.p = slid(step.p, joint.slide[0], position(0));
  } else if constexpr (kKind == JointKind::planar) {
    step.p = slid(slid(step.p, joint.slide[0], position(0)), joint.slide[1], position(1));
    step.q = turned(joint, position(2));
  } else if constexpr (kKind == JointKind::floating) {
    const PoseLanes pose{{position(3), position(4), position(5), position(6)}, {position(0), position(1), position(2)}};
    step = seen<false>(step, pose);
  }
  return step;
}

// As x, y, z, qx, qy, qz, qw, row after row.
COFRAME_INLINE void write(const PoseLanes& pose, double* rows) {
  store_fours(pose.p.x, pose.p.y, pose.p.z, pose.q.x, rows, 7);
  store_fours(pose.q.x, pose.q.y, pose.q.z, pose.q.w, rows + 3, 7);
}

template <JointKind kKind>
bool follow(const JointMotion& joint, Positions positions, std::size_t n, const PoseRows* parents, PoseRows* poses,
            double* out) {
  Lanes odd = splat(0.0);
  for (std::size_t i = 0; i < n; i += kLanes) {
    PoseLanes pose = step_at<kKind>(joint, positions, i, odd);
    if (parents) pose = seen<false>(load(*parents, i), pose);
    if (poses) store(pose, *poses, i);
    if (i + kLanes <= n) {
      write(pose, out + 7 * i);
    } else {
      double rows[7 * kLanes];
      write(pose, rows);
      std::memcpy(out + 7 * i, rows, (n - i) * 7 * sizeof(double));
    }
  }
  return all_above(odd, -1.0);
}

}  // namespace

bool follow_joint(const JointMotion& joint, Positions positions, std::size_t n, const PoseRows* parents,
                  PoseRows* poses, double* out) {
  switch (joint.kind) {
    case JointKind::turning: return follow<JointKind::turning>(joint, positions, n, parents, poses, out);
    case JointKind::sliding: return follow<JointKind::sliding>(joint, positions, n, parents, poses, out);
    case JointKind::planar: return follow<JointKind::planar>(joint, positions, n, parents, poses, out);
    case JointKind::floating: return follow<JointKind::floating>(joint, positions, n, parents, poses, out);
    case JointKind::still: break;
  }
  return follow<JointKind::still>(joint, positions, n, parents, poses, out);
}

}  // namespace coframe::COFRAME_LEVEL
