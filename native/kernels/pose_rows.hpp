// SPDX-License-Identifier: Apache-2.0
// Loads and stores several rows of poses at a time.
#pragma once

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/rotation.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

using PoseLanes = Step<Lanes>;

struct TwistLanes {
  Vector<Lanes> linear, angular;
};

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

// Returns the index of row `k` of the group that begins at `i`; the last of n rows is repeated for rows beyond it.
COFRAME_INLINE std::size_t row_at(std::size_t i, std::size_t k, std::size_t n) { return i + k < n ? i + k : n - 1; }

// Loads the poses from `i` on of a batch of n.
COFRAME_INLINE PoseLanes load(const PoseBatch& batch, std::size_t i, std::size_t n) {
  const double *p[kLanes], *q[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto row = static_cast<std::ptrdiff_t>(row_at(i, k, n));
    p[k] = batch.p + row * batch.p_step;
    q[k] = batch.q + row * batch.q_step;
  }
  PoseLanes pose;
  load_columns(p, 0, pose.p.x, pose.p.y);
  load_columns(p, 1, pose.p.y, pose.p.z);
  load_columns(q, 0, pose.q.x, pose.q.y);
  load_columns(q, 2, pose.q.z, pose.q.w);
  return pose;
}

COFRAME_INLINE void write_group(const PoseLanes& pose, double* rows) {
  store_fours(pose.p.x, pose.p.y, pose.p.z, pose.q.x, rows, 7);
  store_fours(pose.q.x, pose.q.y, pose.q.z, pose.q.w, rows + 3, 7);
}

COFRAME_INLINE void write_group(const TwistLanes& twist, double* rows) {
  store_fours(twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x, rows, 6);
  store_fours(twist.linear.z, twist.angular.x, twist.angular.y, twist.angular.z, rows + 2, 6);
}

// Writes the values from `i` on to an array of n rows of kColumns numbers.
template <std::size_t kColumns, class Values>
COFRAME_INLINE void write_rows(const Values& values, std::size_t i, std::size_t n, double* out) {
  if (i + kLanes <= n) return write_group(values, out + kColumns * i);
  double rows[kColumns * kLanes];
  write_group(values, rows);
  std::memcpy(out + kColumns * i, rows, (n - i) * kColumns * sizeof(double));
}

// Rows of x, y, z, qx, qy, qz, qw.
COFRAME_INLINE void write(const PoseLanes& pose, std::size_t i, std::size_t n, double* out) {
  write_rows<7>(pose, i, n, out);
}

// Rows of vx, vy, vz, wx, wy, wz.
COFRAME_INLINE void write(const TwistLanes& twist, std::size_t i, std::size_t n, double* out) {
  write_rows<6>(twist, i, n, out);
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
