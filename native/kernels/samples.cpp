// SPDX-License-Identifier: Apache-2.0
// Many samples of one frame as they are stored. Compiled without contraction of products and sums: what is stored is
// the same to the last bit, whether it came alone or among others, and on whatever processor.
#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/rotation.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

struct Addresses {
  const double* rows[kLanes];
};

// Of kLanes rows of 7; those beyond the last one are the last one again.
COFRAME_INLINE Addresses addresses(const double* rows, std::size_t i, std::size_t n) {
  Addresses at;
  for (std::size_t k = 0; k < kLanes; ++k) at.rows[k] = rows + 7 * (i + k < n ? i + k : n - 1);
  return at;
}

COFRAME_INLINE Step<Lanes> load(const Addresses& at) {
  Step<Lanes> pose;
  load_columns(at.rows, 0, pose.p.x, pose.p.y);
  load_columns(at.rows, 2, pose.p.z, pose.q.x);
  load_columns(at.rows, 4, pose.q.y, pose.q.z);
  load_columns(at.rows, 5, pose.q.z, pose.q.w);
  return pose;
}

}  // namespace

std::size_t plain_rows(const double* rows, std::size_t n) {
  constexpr double kLeast = 1e-300, kMost = 1e300;
  for (std::size_t i = 0; i < n; i += kLanes) {
    const Step<Lanes> pose = load(addresses(rows, i, n));
    const Lanes length2 = dot(pose.q, pose.q), sum = pose.p.x + pose.p.y + pose.p.z;
    // Infinite or no number at all: the difference of the sum with itself is no number either.
    const bool plain = all_above(length2, kLeast) && all_above(-length2, -kMost) && all_above(sum - sum, -1.0);
    if (!plain) return i;
  }
  return n;
}

void store_samples(const double* rows, std::size_t n, std::uint32_t parent, double* samples) {
  const std::uint32_t words[2] = {parent, 0};
  double bits;
  std::memcpy(&bits, words, sizeof(bits));
  const Lanes last = splat_bits(bits);
  alignas(64) double nowhere[8];
  for (std::size_t i = 0; i < n; i += kLanes) {
    const Step<Lanes> pose = load(addresses(rows, i, n));
    const Quaternion<Lanes> q = canonical(pose.q);
    double* places[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) places[k] = i + k < n ? samples + 8 * (i + k) : nowhere;
    store_shared_columns(q.x, q.y, places, 0);
    store_shared_columns(q.z, q.w, places, 2);
    store_shared_columns(pose.p.x, pose.p.y, places, 4);
    store_shared_columns(pose.p.z, last, places, 6);
  }
}

}  // namespace coframe::COFRAME_LEVEL
