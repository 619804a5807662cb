// SPDX-License-Identifier: Apache-2.0
// Inner loops over many poses and points, compiled once for each processor level. The best level that this processor
// supports is chosen on first use. The results of all levels agree within 1e-15 of the size of the input.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/pose.hpp"

namespace coframe {

enum class Number : std::uint8_t { float32, float64, float32_swapped, float64_swapped };

// One number of every point, `step` bytes apart, without alignment.
struct Column {
  char* data;
  std::ptrdiff_t step;
  Number number;
};

// The coordinates of points in the memory of a cloud.
struct Columns {
  Column x, y, z;
};

// A rotation matrix and a translation in the fourth column, row by row.
struct Affine {
  double m[3][4];
};

// The coordinates of points as doubles, for computations.
struct Points {
  double *x, *y, *z;
};

// The motion of an edge between two neighboring samples, interpolated like interpolate() does: on a straight line and
// along the shortest arc.
struct Motion {
  Pose older, newer;
  bool inverse;  // from parent to child
};

// The number of rows that are processed together; their data fits the first-level cache.
inline constexpr std::size_t kRowBlock = 128;
// The largest number of rows in a register. Kernels process whole groups, so they also read up to a whole group beyond
// the last row.
inline constexpr std::size_t kMaxLanes = 8;

// Many poses, with one array per number.
struct alignas(64) PoseRows {
  double q[4][kRowBlock];
  double p[3][kRowBlock];
};

// Many velocities in meters and radians per second, with one array per number.
struct alignas(64) TwistRows {
  double linear[3][kRowBlock];
  double angular[3][kRowBlock];
};

// The poses of a batch: translations and quaternions, each in rows that begin `..._step` doubles apart. A step of 0
// repeats one row.
struct PoseBatch {
  const double *p, *q;
  std::ptrdiff_t p_step, q_step;
};

// One number per pose, or one for all if the step is 0.
struct Fractions {
  const double* numbers;
  std::size_t step;
};

// The two samples around each row and the fraction between them. `older` and `newer` point to 8 numbers each: q, p and
// one that is not part of the pose.
struct alignas(64) Between {
  double fraction[kRowBlock];
  double per_second[kRowBlock];  // 1 / (time between both samples)
  const double* older[kRowBlock];
  const double* newer[kRowBlock];
};

// An edge of a chain at one time. Its pose is interpolated between two samples of eight numbers: x, y, z, w of the
// quaternion, x, y, z of the translation, and one that is not part of the pose. `fraction` is the position between
// them; it is ignored if both pointers are equal.
struct Edge {
  const double *older, *newer;
  double fraction;
  bool down;  // from parent to child
};

// How a joint moves its child link. `rotating` is revolute or continuous.
enum class JointKind : std::uint8_t { fixed, rotating, prismatic, planar, floating };

// The motion of a joint's child link relative to its parent link. At position 0 the child link is at `origin`.
struct JointMotion {
  JointKind kind = JointKind::fixed;
  Pose origin;
  double half_turn[4];      // joints that rotate: the origin's quaternion times half a turn about the axis
  double directions[2][3];  // joints that translate: the displacement per meter; planar joints have two directions
};

struct Span {
  std::int64_t first, last;
};

struct Kernels {
  const char* level;
#define COFRAME_KERNEL(result, name, parameters) result(*name) parameters;
#include "kernels/entries.inc"
#undef COFRAME_KERNEL
};

// Returns the kernels of the chosen level. Throws std::runtime_error if the environment variable COFRAME_CPU_LEVEL
// names a level that this processor does not support.
const Kernels& kernels();

}  // namespace coframe
