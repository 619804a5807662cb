// SPDX-License-Identifier: Apache-2.0
// Several doubles that are processed together: as many as a register of the level holds. The numbers of a sample or row
// are adjacent in memory; loads and stores transpose them, so that each register holds the same number of several rows.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernels/level.hpp"
#include "kernels/shuffle.hpp"

#if defined(__AVX2__)
#include <immintrin.h>
#endif

// Compilers without vector extensions, such as MSVC, process one number at a time.
#if !defined(COFRAME_SHUFFLE)
#define COFRAME_LANES 1
#elif defined(__AVX512F__)
#define COFRAME_LANES 8
#define COFRAME_EVEN 0, 8, 2, 10, 4, 12, 6, 14
#define COFRAME_ODD 1, 9, 3, 11, 5, 13, 7, 15
#elif defined(__AVX2__)
#define COFRAME_LANES 4
#define COFRAME_EVEN 0, 4, 2, 6
#define COFRAME_ODD 1, 5, 3, 7
#else
#define COFRAME_LANES 2
#define COFRAME_EVEN 0, 2
#define COFRAME_ODD 1, 3
#endif

namespace coframe::COFRAME_LEVEL {

namespace {

constexpr std::size_t kLanes = COFRAME_LANES;
static_assert(kMaxLanes % kLanes == 0);

#if COFRAME_LANES > 1
typedef double Lanes __attribute__((vector_size(8 * COFRAME_LANES)));
typedef std::int64_t LaneBits __attribute__((vector_size(8 * COFRAME_LANES)));
typedef double Pair __attribute__((vector_size(16)));

COFRAME_INLINE Lanes splat(double value) { return value - Lanes{}; }
// The same for bits that are not necessarily a number.
COFRAME_INLINE Lanes splat_bits(double value) {
  std::int64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return (Lanes)(bits - LaneBits{});
}

// Returns the sign of each number for with_sign(), which multiplies by it.
COFRAME_INLINE Lanes sign_of(const Lanes& numbers) { return (Lanes)((LaneBits)numbers & INT64_MIN); }
COFRAME_INLINE Lanes with_sign(const Lanes& numbers, const Lanes& sign) {
  return (Lanes)((LaneBits)numbers ^ (LaneBits)sign);
}

// The only place that reads a sample while another thread may be writing it; the only place that writes one is below.
// For the language this is a data race, because SharedSample consists of atomic numbers. In practice no compiler splits
// these accesses, processors read and write aligned 8-byte numbers as a whole, and the caller discards the result if
// the revision has changed. ThreadSanitizer cannot detect that, so it gets atomic accesses.
COFRAME_INLINE Pair load_pair(const double* numbers) {
  Pair pair;
#if defined(COFRAME_CHECKS_THREADS)
  const auto* const bits = reinterpret_cast<const std::uint64_t*>(numbers);
  const std::uint64_t both[2] = {__atomic_load_n(bits, __ATOMIC_RELAXED), __atomic_load_n(bits + 1, __ATOMIC_RELAXED)};
  __builtin_memcpy(&pair, both, sizeof(pair));
#else
  __builtin_memcpy(&pair, numbers, sizeof(pair));
#endif
  return pair;
}

// Loads two adjacent numbers of every second row.
COFRAME_INLINE Lanes load_pairs(const double* const* rows, std::size_t offset) {
#if COFRAME_LANES == 2
  return load_pair(rows[0] + offset);
#else
  const auto join = [](Pair a, Pair b) { return COFRAME_SHUFFLE(a, b, 0, 1, 2, 3); };
  const auto low = join(load_pair(rows[0] + offset), load_pair(rows[2] + offset));
#if COFRAME_LANES == 4
  return low;
#else
  const auto high = join(load_pair(rows[4] + offset), load_pair(rows[6] + offset));
  return COFRAME_SHUFFLE(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
#endif
#endif
}

// Loads the numbers `offset` and `offset` + 1 of kLanes rows into `first` and `second`.
COFRAME_INLINE void load_columns(const double* const* rows, std::size_t offset, Lanes& first, Lanes& second) {
  const Lanes even = load_pairs(rows, offset), odd = load_pairs(rows + 1, offset);
  first = COFRAME_SHUFFLE(even, odd, COFRAME_EVEN);
  second = COFRAME_SHUFFLE(even, odd, COFRAME_ODD);
}

COFRAME_INLINE void store_pair(const Pair& pair, double* numbers) { __builtin_memcpy(numbers, &pair, sizeof(pair)); }

COFRAME_INLINE void store_shared_pair(const Pair& pair, double* numbers) {
#if defined(COFRAME_CHECKS_THREADS)
  auto* const bits = reinterpret_cast<std::uint64_t*>(numbers);
  std::uint64_t both[2];
  __builtin_memcpy(both, &pair, sizeof(pair));
  __atomic_store_n(bits, both[0], __ATOMIC_RELAXED);
  __atomic_store_n(bits + 1, both[1], __ATOMIC_RELAXED);
#else
  store_pair(pair, numbers);
#endif
}

template <void (*kStore)(const Pair&, double*)>
COFRAME_INLINE void store_pairs(const Lanes& pairs, double* const* rows, std::size_t offset) {
  for (std::size_t i = 0; i < kLanes; i += 2) kStore(Pair{pairs[i], pairs[i + 1]}, rows[i] + offset);
}

template <void (*kStore)(const Pair&, double*)>
COFRAME_INLINE void store_columns_by(const Lanes& first, const Lanes& second, double* const* rows, std::size_t offset) {
  store_pairs<kStore>(COFRAME_SHUFFLE(first, second, COFRAME_EVEN), rows, offset);
  store_pairs<kStore>(COFRAME_SHUFFLE(first, second, COFRAME_ODD), rows + 1, offset);
}
COFRAME_INLINE void store_columns(const Lanes& first, const Lanes& second, double* const* rows, std::size_t offset) {
  store_columns_by<store_pair>(first, second, rows, offset);
}
COFRAME_INLINE void store_shared_columns(const Lanes& first, const Lanes& second, double* const* rows,
                                         std::size_t offset) {
  store_columns_by<store_shared_pair>(first, second, rows, offset);
}
#else
using Lanes = double;

COFRAME_INLINE Lanes splat(double value) { return value; }
COFRAME_INLINE Lanes splat_bits(double value) { return value; }
COFRAME_INLINE Lanes sign_of(Lanes number) { return number < 0.0 ? -1.0 : 1.0; }
COFRAME_INLINE Lanes with_sign(Lanes number, Lanes sign) { return number * sign; }

COFRAME_INLINE void load_columns(const double* const* rows, std::size_t offset, Lanes& first, Lanes& second) {
  const volatile double* const numbers = rows[0] + offset;  // another thread may be writing them; see above
  first = numbers[0];
  second = numbers[1];
}

COFRAME_INLINE void store_columns(Lanes first, Lanes second, double* const* rows, std::size_t offset) {
  rows[0][offset] = first;
  rows[0][offset + 1] = second;
}
COFRAME_INLINE void store_shared_columns(Lanes first, Lanes second, double* const* rows, std::size_t offset) {
  volatile double* const numbers = rows[0] + offset;
  numbers[0] = first;
  numbers[1] = second;
}
#endif

// Stores four numbers of each of kLanes rows; the rows begin `step` numbers apart.
COFRAME_INLINE void store_fours(const Lanes& a, const Lanes& b, const Lanes& c, const Lanes& d, double* row,
                                std::size_t step) {
#if COFRAME_LANES == 4
  const __m256d low_ab = _mm256_unpacklo_pd((__m256d)a, (__m256d)b),
                high_ab = _mm256_unpackhi_pd((__m256d)a, (__m256d)b);
  const __m256d low_cd = _mm256_unpacklo_pd((__m256d)c, (__m256d)d),
                high_cd = _mm256_unpackhi_pd((__m256d)c, (__m256d)d);
  _mm256_storeu_pd(row, _mm256_permute2f128_pd(low_ab, low_cd, 0x20));
  _mm256_storeu_pd(row + step, _mm256_permute2f128_pd(high_ab, high_cd, 0x20));
  _mm256_storeu_pd(row + 2 * step, _mm256_permute2f128_pd(low_ab, low_cd, 0x31));
  _mm256_storeu_pd(row + 3 * step, _mm256_permute2f128_pd(high_ab, high_cd, 0x31));
#else
  double* rows[kLanes];
  for (std::size_t k = 0; k < kLanes; ++k) rows[k] = row + k * step;
  store_columns(a, b, rows, 0);
  store_columns(c, d, rows, 2);
#endif
}

COFRAME_INLINE Lanes load_lanes(const double* numbers) {
  Lanes lanes;
  std::memcpy(&lanes, numbers, sizeof(lanes));
  return lanes;
}
COFRAME_INLINE void store_lanes(const Lanes& lanes, double* numbers) { std::memcpy(numbers, &lanes, sizeof(lanes)); }

COFRAME_INLINE double root(double number) { return std::sqrt(number); }

#if COFRAME_LANES == 8
COFRAME_INLINE Lanes root(const Lanes& numbers) { return (Lanes)_mm512_maskz_sqrt_pd(0xff, (__m512d)numbers); }
COFRAME_INLINE bool all_above(const Lanes& numbers, double limit) {
  return _mm512_cmp_pd_mask((__m512d)numbers, _mm512_set1_pd(limit), _CMP_NGT_UQ) == 0;
}
#elif COFRAME_LANES == 4
COFRAME_INLINE Lanes root(const Lanes& numbers) { return (Lanes)_mm256_sqrt_pd((__m256d)numbers); }
COFRAME_INLINE bool all_above(const Lanes& numbers, double limit) {
  return _mm256_movemask_pd(_mm256_cmp_pd((__m256d)numbers, _mm256_set1_pd(limit), _CMP_NGT_UQ)) == 0;
}
#elif COFRAME_LANES == 2
COFRAME_INLINE Lanes root(const Lanes& numbers) { return Lanes{std::sqrt(numbers[0]), std::sqrt(numbers[1])}; }
COFRAME_INLINE bool all_above(const Lanes& numbers, double limit) { return numbers[0] > limit && numbers[1] > limit; }
#endif
COFRAME_INLINE bool all_above(double number, double limit) { return number > limit; }

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
