// SPDX-License-Identifier: Apache-2.0
// Four numbers that are processed together: a quaternion, or a vector and one more number. They are one register if the
// processor has AVX2. With shorter registers, compilers generate code that is slower than with plain numbers.
#pragma once

#include <cstdint>
#include <cstring>

#include "kernels/level.hpp"
#include "kernels/shuffle.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

#if defined(__AVX2__) && defined(COFRAME_SHUFFLE)

using Four = double __attribute__((vector_size(32)));
using Two = double __attribute__((vector_size(16)));

// Returns the numbers of `v` at these indices.
template <int A, int B, int C, int D>
COFRAME_INLINE Four ordered(const Four& v) {
  return COFRAME_SHUFFLE(v, v, A, B, C, D);
}

#else

struct Four {
  double numbers[4];
  COFRAME_INLINE double& operator[](int i) { return numbers[i]; }
  COFRAME_INLINE double operator[](int i) const { return numbers[i]; }
};

COFRAME_INLINE Four operator+(const Four& a, const Four& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}
COFRAME_INLINE Four operator-(const Four& a, const Four& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}
COFRAME_INLINE Four operator*(const Four& a, const Four& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2], a[3] * b[3]};
}
COFRAME_INLINE Four operator*(double a, const Four& b) { return {a * b[0], a * b[1], a * b[2], a * b[3]}; }

template <int A, int B, int C, int D>
COFRAME_INLINE Four ordered(const Four& v) {
  return {v[A], v[B], v[C], v[D]};
}

struct Two {
  double numbers[2];
  COFRAME_INLINE double operator[](int i) const { return numbers[i]; }
};
COFRAME_INLINE Two operator+(double a, const Two& b) { return {a + b[0], a + b[1]}; }
COFRAME_INLINE Two operator-(const Two& a, double b) { return {a[0] - b, a[1] - b}; }
COFRAME_INLINE Two operator*(const Two& a, double b) { return {a[0] * b, a[1] * b}; }
COFRAME_INLINE Two operator*(const Two& a, const Two& b) { return {a[0] * b[0], a[1] * b[1]}; }

#endif

// Returns one of the numbers four times.
template <int I>
COFRAME_INLINE Four spread(const Four& v) {
  return ordered<I, I, I, I>(v);
}

// Loads part of a sample that another thread may be writing; lanes.hpp explains why this is safe.
COFRAME_INLINE Four load_shared(const double* numbers) {
  Four v;
#if defined(COFRAME_CHECKS_THREADS)
  std::uint64_t bits[4];
  for (int i = 0; i < 4; ++i) {
    bits[i] = __atomic_load_n(reinterpret_cast<const std::uint64_t*>(numbers) + i, __ATOMIC_RELAXED);
  }
  std::memcpy(&v, bits, sizeof(v));
#else
  std::memcpy(&v, numbers, sizeof(v));
#endif
  return v;
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
