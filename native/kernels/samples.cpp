// SPDX-License-Identifier: Apache-2.0
// Converts many samples of one frame to the format of the buffer. Compiled without contraction of products and sums, so
// that stored samples are bit-identical on every processor, whether they are inserted one at a time or many at once.
#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/rotation.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

struct Addresses {
  const double* rows[kLanes];
};

// Returns the addresses of kLanes rows of 7 numbers. The last row is repeated for rows beyond it.
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

std::size_t count_valid_rows(const double* rows, std::size_t n) {
  constexpr double kMin = 1e-300, kMax = 1e300;
  for (std::size_t i = 0; i < n; i += kLanes) {
    const Step<Lanes> pose = load(addresses(rows, i, n));
    const Lanes length2 = dot(pose.q, pose.q), sum = pose.p.x + pose.p.y + pose.p.z;
    // If a coordinate is infinite or NaN, the sum minus itself is NaN.
    const bool is_valid = all_above(length2, kMin) && all_above(-length2, -kMax) && all_above(sum - sum, -1.0);
    if (!is_valid) return i;
  }
  return n;
}

void store_samples(const double* rows, std::size_t n, std::uint32_t parent, double* samples) {
  const std::uint32_t words[2] = {parent, 0};
  double bits;
  std::memcpy(&bits, words, sizeof(bits));
  const Lanes last = splat_bits(bits);
  alignas(64) double discarded[8];
  for (std::size_t i = 0; i < n; i += kLanes) {
    const Step<Lanes> pose = load(addresses(rows, i, n));
    const Quaternion<Lanes> q = canonical(pose.q);
    double* destinations[kLanes];
    for (std::size_t k = 0; k < kLanes; ++k) destinations[k] = i + k < n ? samples + 8 * (i + k) : discarded;
    store_shared_columns(q.x, q.y, destinations, 0);
    store_shared_columns(q.z, q.w, destinations, 2);
    store_shared_columns(pose.p.x, pose.p.y, destinations, 4);
    store_shared_columns(pose.p.z, last, destinations, 6);
  }
}

}  // namespace coframe::COFRAME_LEVEL
