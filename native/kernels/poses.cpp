// SPDX-License-Identifier: Apache-2.0
#include "kernels/arc.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

// The number of poses that are processed together; their data fits the first-level cache.
constexpr std::size_t kBlock = 64;

std::size_t block_size(std::size_t remaining) { return remaining < kBlock ? remaining : kBlock; }

}  // namespace

void interpolate_many(const Pose* older, const Pose* newer, const double* fractions, std::size_t n, Pose* out) {
  double cosines[kBlock], signs[kBlock];
  for (std::size_t done = 0; done < n; done += kBlock) {
    const std::size_t count = block_size(n - done);
    const Pose *a = older + done, *b = newer + done;
    double least = 1.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Arc shortest_arc = arc(a[i].q, b[i].q);
      cosines[i] = shortest_arc.cosine;
      signs[i] = shortest_arc.sign;
      least = shortest_arc.cosine < least ? shortest_arc.cosine : least;
    }
    choose_slerp(least, [&](auto slerp) {
      double firsts[kBlock], seconds[kBlock];
      for (std::size_t i = 0; i < count; ++i) {
        const double t = fractions[done + i];
        firsts[i] = decltype(slerp)::weight(1.0 - t, cosines[i]);
        seconds[i] = signs[i] * decltype(slerp)::weight(t, cosines[i]);
      }
      for (std::size_t i = 0; i < count; ++i) {
        const Ends<double> line = line_weights(fractions[done + i]);
        Pose& result = out[done + i];
        for (int k = 0; k < 4; ++k) result.q[k] = firsts[i] * a[i].q[k] + seconds[i] * b[i].q[k];
        for (int k = 0; k < 3; ++k) result.p[k] = line.first * a[i].p[k] + line.second * b[i].p[k];
      }
    });
  }
}

}  // namespace coframe::COFRAME_LEVEL
