// Many poses side by side, number by number, so that one instruction works on several of them.
#pragma once

#include <cstddef>

#include "core/chunks.hpp"
#include "core/pose.hpp"

namespace coframe {

// So many rows are worked on together: what they need fits the first cache.
inline constexpr std::size_t kBlock = 128;

struct alignas(64) PoseRows {
  double q[4][kBlock];
  double p[3][kBlock];

  void set_identity(std::size_t count);
  void load(std::size_t row, const SharedSample& sample) { sample.load(&q[0][row], &p[0][row], kBlock); }
  // x, y, z, qx, qy, qz, qw.
  void write(std::size_t row, double* out) const {
    for (int k = 0; k < 3; ++k) out[k] = p[k][row];
    for (int k = 0; k < 4; ++k) out[3 + k] = q[k][row];
  }
};

// interpolate() of pose.hpp for each row, at the share part / whole; `out` may be one of both ends.
void interpolate_rows(const PoseRows& older, const PoseRows& newer, const double* part, const double* whole,
                      std::size_t count, PoseRows& out);

// Each row's pose, seen from the parent of that row's step, or with `down` from its child.
void compose_rows(const PoseRows& steps, bool down, std::size_t count, PoseRows& poses);
// The same for one step.
void compose_rows(const Pose& step, bool down, std::size_t count, PoseRows& poses);

// canonicalise() of pose.hpp for each row.
void canonicalise_rows(std::size_t count, PoseRows& poses);

}  // namespace coframe
