// Inner loops over many poses and points, compiled once for every level of the processor; the best one that this
// processor has is chosen when it is first asked for. All levels give the same results to the last bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/pose.hpp"

namespace coframe {

enum class Number : std::uint8_t { float32, float64, float32_swapped, float64_swapped };

// One number of every point: `step` bytes apart, at any address.
struct Column {
  char* data;
  std::ptrdiff_t step;
  Number number;
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

struct Span {
  std::int64_t first, last;
};

struct Kernels {
  const char* level;

  // out[i] = what interpolate() makes of older[i] and newer[i] for shares[i] in [0, 1], to 1e-15.
  void (*interpolate_many)(const Pose* older, const Pose* newer, const double* shares, std::size_t n, Pose* out);

  void (*load)(const Column& from, std::size_t n, double* out);
  void (*store)(const Column& to, std::size_t n, const double* in);
  // The least and the greatest of at least one time.
  Span (*span)(const std::int64_t* times, std::size_t n);
  // How often a time differs from the one before.
  std::size_t (*changes)(const std::int64_t* times, std::size_t n);
  // Where each time lies on the way from `start` to `end`, for start <= time <= end and start < end.
  void (*shares)(const std::int64_t* times, std::int64_t start, std::int64_t end, std::size_t n, double* out);

  // Points seen from the other end: of one pose, of a motion at each point's own share, of each point's own pose.
  void (*transform)(const Affine& affine, std::size_t n, Points points);
  void (*transform_moving)(const Motion& motion, const double* shares, std::size_t n, Points points);
  void (*transform_each)(const Pose* poses, bool inverse, std::size_t n, Points points);
};

// std::runtime_error if the environment variable COFRAME_CPU_LEVEL names a level that is not there.
const Kernels& kernels();
// Those that this processor and this build have, the best one last.
std::vector<const Kernels*> all_kernels();

inline void interpolate_many(const Pose* older, const Pose* newer, const double* shares, std::size_t n, Pose* out) {
  kernels().interpolate_many(older, newer, shares, n, out);
}

}  // namespace coframe
