// Points with float32 x, y and z side by side, as most clouds have them, four at a time.
#pragma once

#include <cstddef>

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"
#include "kernels/rotation.hpp"

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

// Also reads the four bytes behind each point, which must be there: not for the last one.
COFRAME_INLINE Vector<FourDoubles> load_four(const char* data, std::ptrdiff_t step) {
  const FourFloats a = load_floats(data), b = load_floats(data + step), c = load_floats(data + 2 * step),
                   d = load_floats(data + 3 * step);
  const FourFloats ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const FourFloats x = __builtin_shufflevector(ab, cd, 0, 1, 4, 5), y = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  const FourFloats ab_z = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd_z = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  const FourFloats z = __builtin_shufflevector(ab_z, cd_z, 0, 1, 4, 5);
  return {__builtin_convertvector(x, FourDoubles), __builtin_convertvector(y, FourDoubles), __builtin_convertvector(z, FourDoubles)};
}

// Nothing but the twelve bytes of each point: what is behind may be another thread's.
COFRAME_INLINE void store_four(const Vector<FourDoubles>& points, char* data, std::ptrdiff_t step) {
  const FourFloats x = __builtin_convertvector(points.x, FourFloats), y = __builtin_convertvector(points.y, FourFloats),
                   z = __builtin_convertvector(points.z, FourFloats);
  const FourFloats low = __builtin_shufflevector(x, y, 0, 4, 1, 5), high = __builtin_shufflevector(x, y, 2, 6, 3, 7);
  const float values[4][3] = {
      {low[0], low[1], z[0]}, {low[2], low[3], z[1]}, {high[0], high[1], z[2]}, {high[2], high[3], z[3]}};
  for (std::size_t k = 0; k < 4; ++k) {
    __builtin_memcpy(data + static_cast<std::ptrdiff_t>(k) * step, values[k], 8);
    __builtin_memcpy(data + static_cast<std::ptrdiff_t>(k) * step + 8, values[k] + 2, 4);
  }
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL

#endif
