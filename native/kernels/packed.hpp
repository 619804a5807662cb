// SPDX-License-Identifier: Apache-2.0
// Loads and stores four points at a time whose float32 x, y and z are adjacent, as in most clouds.
#pragma once

#include <cstddef>

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/rotation.hpp"
#include "kernels/shuffle.hpp"

#if COFRAME_LANES > 1

namespace coframe::COFRAME_LEVEL {

namespace {

typedef float FourFloats __attribute__((vector_size(16)));
typedef double FourDoubles __attribute__((vector_size(32)));

COFRAME_INLINE bool are_packed(const Columns& c) {
  return c.x.number == Number::float32 && c.y.number == Number::float32 && c.z.number == Number::float32 &&
         c.y.data == c.x.data + 4 && c.z.data == c.x.data + 8 && c.y.step == c.x.step && c.z.step == c.x.step &&
         c.x.step >= 12;
}

COFRAME_INLINE FourFloats load_floats(const char* data) {
  FourFloats floats;
  __builtin_memcpy(&floats, data, sizeof(floats));
  return floats;
}

// With AVX, GCC compiles __builtin_convertvector to code that goes through memory.
COFRAME_INLINE void convert(const FourFloats& from, FourDoubles& to) {
#if defined(__AVX__)
  to = (FourDoubles)_mm256_cvtps_pd((__m128)from);
#else
  to = __builtin_convertvector(from, FourDoubles);
#endif
}
COFRAME_INLINE void convert(const FourDoubles& from, FourFloats& to) {
#if defined(__AVX__)
  to = (FourFloats)_mm256_cvtpd_ps((__m256d)from);
#else
  to = __builtin_convertvector(from, FourFloats);
#endif
}

// Also reads the four bytes after each point, so these must exist: not for the last point of a cloud.
COFRAME_INLINE Vector<FourDoubles> load_four(const char* data, std::ptrdiff_t step) {
  const FourFloats a = load_floats(data), b = load_floats(data + step), c = load_floats(data + 2 * step),
                   d = load_floats(data + 3 * step);
  const FourFloats ab = COFRAME_SHUFFLE(a, b, 0, 4, 1, 5), cd = COFRAME_SHUFFLE(c, d, 0, 4, 1, 5);
  const FourFloats x = COFRAME_SHUFFLE(ab, cd, 0, 1, 4, 5), y = COFRAME_SHUFFLE(ab, cd, 2, 3, 6, 7);
  const FourFloats ab_z = COFRAME_SHUFFLE(a, b, 2, 6, 3, 7), cd_z = COFRAME_SHUFFLE(c, d, 2, 6, 3, 7);
  const FourFloats z = COFRAME_SHUFFLE(ab_z, cd_z, 0, 1, 4, 5);
  Vector<FourDoubles> points;
  convert(x, points.x);
  convert(y, points.y);
  convert(z, points.z);
  return points;
}

// Writes only the twelve bytes of each point: the bytes after it may belong to another thread.
COFRAME_INLINE void store_four(const Vector<FourDoubles>& points, char* data, std::ptrdiff_t step) {
  FourFloats x, y, z;
  convert(points.x, x);
  convert(points.y, y);
  convert(points.z, z);
  // x and y of a point are written as one number of eight bytes.
  const Pair low = (Pair)COFRAME_SHUFFLE(x, y, 0, 4, 1, 5);
  const Pair high = (Pair)COFRAME_SHUFFLE(x, y, 2, 6, 3, 7);
  const double xy[4] = {low[0], low[1], high[0], high[1]};
  for (std::size_t k = 0; k < 4; ++k) {
    const float last = z[k];
    __builtin_memcpy(data + static_cast<std::ptrdiff_t>(k) * step, &xy[k], 8);
    __builtin_memcpy(data + static_cast<std::ptrdiff_t>(k) * step + 8, &last, 4);
  }
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL

#endif
