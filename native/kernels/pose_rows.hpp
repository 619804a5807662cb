// SPDX-License-Identifier: Apache-2.0
// Loads and stores several rows of poses at a time.
#pragma once

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/rotation.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

using PoseLanes = Step<Lanes>;

COFRAME_INLINE PoseLanes splat(const Pose& pose) {
  return {{splat(pose.q[0]), splat(pose.q[1]), splat(pose.q[2]), splat(pose.q[3])},
          {splat(pose.p[0]), splat(pose.p[1]), splat(pose.p[2])}};
}

COFRAME_INLINE PoseLanes load(const PoseRows& rows, std::size_t i) {
  return {{load_lanes(rows.q[0] + i), load_lanes(rows.q[1] + i), load_lanes(rows.q[2] + i), load_lanes(rows.q[3] + i)},
          {load_lanes(rows.p[0] + i), load_lanes(rows.p[1] + i), load_lanes(rows.p[2] + i)}};
}

COFRAME_INLINE void store(const PoseLanes& pose, PoseRows& rows, std::size_t i) {
  store_lanes(pose.q.x, rows.q[0] + i);
  store_lanes(pose.q.y, rows.q[1] + i);
  store_lanes(pose.q.z, rows.q[2] + i);
  store_lanes(pose.q.w, rows.q[3] + i);
  store_lanes(pose.p.x, rows.p[0] + i);
  store_lanes(pose.p.y, rows.p[1] + i);
  store_lanes(pose.p.z, rows.p[2] + i);
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
