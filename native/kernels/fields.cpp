// SPDX-License-Identifier: Apache-2.0
// Reads, writes and transforms the numbers in the memory of point clouds.
#include <cstring>

#include "kernels/level.hpp"
#include "kernels/packed.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

COFRAME_INLINE std::uint32_t swapped(std::uint32_t v) {
  return v >> 24 | (v >> 8 & 0xff00u) | (v << 8 & 0xff0000u) | v << 24;
}
COFRAME_INLINE std::uint64_t swapped(std::uint64_t v) {
  return static_cast<std::uint64_t>(swapped(static_cast<std::uint32_t>(v))) << 32 |
         swapped(static_cast<std::uint32_t>(v >> 32));
}

// The format of a number in memory: T, in native or in swapped byte order.
template <class T, class Bits, bool kSwapped>
struct Stored {
  COFRAME_INLINE static double load(const char* data) {
    Bits bits;
    std::memcpy(&bits, data, sizeof(bits));
    if constexpr (kSwapped) bits = swapped(bits);
    T value;
    std::memcpy(&value, &bits, sizeof(value));
    return static_cast<double>(value);
  }
  COFRAME_INLINE static void store(char* data, double number) {
    const T value = static_cast<T>(number);
    Bits bits;
    std::memcpy(&bits, &value, sizeof(bits));
    if constexpr (kSwapped) bits = swapped(bits);
    std::memcpy(data, &bits, sizeof(bits));
  }
};

template <class Loop>
void choose_number(Number number, Loop&& loop) {
  switch (number) {
    case Number::float32: return loop(Stored<float, std::uint32_t, false>());
    case Number::float64: return loop(Stored<double, std::uint64_t, false>());
    case Number::float32_swapped: return loop(Stored<float, std::uint32_t, true>());
    case Number::float64_swapped: return loop(Stored<double, std::uint64_t, true>());
  }
}

void load_column(const Column& from, std::size_t begin, std::size_t end, double* __restrict out) {
  choose_number(from.number, [&](auto stored) {
    const char* const data = from.data;
    const std::ptrdiff_t step = from.step;
    for (std::size_t i = begin; i < end; ++i) out[i] = stored.load(data + static_cast<std::ptrdiff_t>(i) * step);
  });
}

void store_column(const Column& to, std::size_t begin, std::size_t end, const double* __restrict in) {
  choose_number(to.number, [&](auto stored) {
    char* const data = to.data;
    const std::ptrdiff_t step = to.step;
    for (std::size_t i = begin; i < end; ++i) stored.store(data + static_cast<std::ptrdiff_t>(i) * step, in[i]);
  });
}

// Loads packed points except the last few; returns how many were loaded.
std::size_t load_packed([[maybe_unused]] const Columns& from, [[maybe_unused]] std::size_t n,
                        [[maybe_unused]] const Points& out) {
  std::size_t i = 0;
#if COFRAME_LANES > 1
  if (!are_packed(from)) return 0;
  for (; i + 4 < n; i += 4) {
    const Vector<FourDoubles> points =
        load_four(from.x.data + static_cast<std::ptrdiff_t>(i) * from.x.step, from.x.step);
    __builtin_memcpy(out.x + i, &points.x, sizeof(FourDoubles));
    __builtin_memcpy(out.y + i, &points.y, sizeof(FourDoubles));
    __builtin_memcpy(out.z + i, &points.z, sizeof(FourDoubles));
  }
#endif
  return i;
}

std::size_t store_packed([[maybe_unused]] const Columns& to, [[maybe_unused]] std::size_t n,
                         [[maybe_unused]] const Points& in) {
  std::size_t i = 0;
#if COFRAME_LANES > 1
  if (!are_packed(to)) return 0;
  for (; i + 4 <= n; i += 4) {
    Vector<FourDoubles> points;
    __builtin_memcpy(&points.x, in.x + i, sizeof(FourDoubles));
    __builtin_memcpy(&points.y, in.y + i, sizeof(FourDoubles));
    __builtin_memcpy(&points.z, in.z + i, sizeof(FourDoubles));
    store_four(points, to.x.data + static_cast<std::ptrdiff_t>(i) * to.x.step, to.x.step);
  }
#endif
  return i;
}

// Transforms packed points in registers, without intermediate arrays; returns how many were transformed.
std::size_t transform_packed([[maybe_unused]] const Affine& affine, [[maybe_unused]] std::size_t n,
                             [[maybe_unused]] const Columns& columns) {
  std::size_t i = 0;
#if COFRAME_LANES > 1
  if (!are_packed(columns)) return 0;
  double m[3][4];  // a copy: the compiler can assume that stores of points do not change it
  std::memcpy(m, affine.m, sizeof(m));
  for (; i + 4 < n; i += 4) {
    char* const data = columns.x.data + static_cast<std::ptrdiff_t>(i) * columns.x.step;
    const Vector<FourDoubles> p = load_four(data, columns.x.step);
    // Beginning with the offset, each product and sum becomes one fused instruction.
    const Vector<FourDoubles> moved{m[0][3] + m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z,
                                    m[1][3] + m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z,
                                    m[2][3] + m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z};
    store_four(moved, data, columns.x.step);
  }
#endif
  return i;
}

}  // namespace

void load(const Columns& from, std::size_t n, Points out) {
  const std::size_t begin = load_packed(from, n, out);
  load_column(from.x, begin, n, out.x);
  load_column(from.y, begin, n, out.y);
  load_column(from.z, begin, n, out.z);
}

void store(const Columns& to, std::size_t n, Points in) {
  const std::size_t begin = store_packed(to, n, in);
  store_column(to.x, begin, n, in.x);
  store_column(to.y, begin, n, in.y);
  store_column(to.z, begin, n, in.z);
}

void transform_columns(const Affine& affine, std::size_t n, const Columns& columns) {
  constexpr std::size_t kBlock = 128;
  double x[kBlock], y[kBlock], z[kBlock];
  for (std::size_t done = transform_packed(affine, n, columns); done < n; done += kBlock) {
    const std::size_t count = n - done < kBlock ? n - done : kBlock;
    const auto from = [done](const Column& c) {
      return Column{c.data + static_cast<std::ptrdiff_t>(done) * c.step, c.step, c.number};
    };
    const Columns block{from(columns.x), from(columns.y), from(columns.z)};
    load(block, count, {x, y, z});
    transform(affine, count, {x, y, z});
    store(block, count, {x, y, z});
  }
}

}  // namespace coframe::COFRAME_LEVEL
