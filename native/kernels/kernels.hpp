// SPDX-License-Identifier: Apache-2.0
// Inner loops over many poses and points, compiled once for every level of the processor; the best one that this
// processor has is chosen when it is first asked for. All levels give the same results within 1e-15 of what goes in.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/pose.hpp"

namespace coframe {

enum class Number : std::uint8_t { float32, float64, float32_swapped, float64_swapped };

// One number of every point: `step` bytes apart, at any address.
struct Column {
  char* data;
  std::ptrdiff_t step;
  Number number;
};

// The coordinates of points as they are kept.
struct Columns {
  Column x, y, z;
};

// A rotation matrix and a translation beside it, row by row.
struct Affine {
  double m[3][4];
};

// The coordinates of points at work.
struct Points {
  double *x, *y, *z;
};

// The motion of a link between two neighbouring samples: straight and along the shortest arc, as interpolate() has it.
struct Motion {
  Pose older, newer;
  bool inverse;  // from parent to child
};

// So many rows are worked on together: what they need fits the first cache.
inline constexpr std::size_t kRowBlock = 128;
// Rows are worked on in groups of up to so many: what is beyond the last row, up to a whole group, is read too.
inline constexpr std::size_t kMostLanes = 8;

// Many poses side by side, number by number.
struct alignas(64) PoseRows {
  double q[4][kRowBlock];
  double p[3][kRowBlock];
};

// Velocities side by side, in metres and radians per second.
struct alignas(64) TwistRows {
  double linear[3][kRowBlock];
  double angular[3][kRowBlock];
};

// Where rows lie between two samples: `older` and `newer` are 8 numbers each, q, p and one that is not a pose's.
struct alignas(64) Between {
  double share[kRowBlock];
  double per_second[kRowBlock];  // one by the time between both
  const double* older[kRowBlock];
  const double* newer[kRowBlock];
};

// A link of a chain. Its pose lies between two records of eight numbers: x, y, z, w of the quaternion, x, y, z of the
// translation, and one that says nothing. `share` of the way from one to the other; there is only one where both are
// the same.
struct Link {
  const double *older, *newer;
  double share;
  bool down;  // from parent to child
};

// What a joint does with the link behind it.
enum class JointKind : std::uint8_t { still, turning, sliding, planar, floating };

// The motion of a joint's child link relative to its parent link; at position 0 it is at `origin`.
struct JointMotion {
  JointKind kind = JointKind::still;
  Pose origin;
  double turn[4];      // the origin's quaternion times the axis, of what turns
  double slide[2][3];  // where a metre takes it, of what slides: in a plane there are two ways
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

// std::runtime_error if the environment variable COFRAME_CPU_LEVEL names a level that is not there.
const Kernels& kernels();

}  // namespace coframe
