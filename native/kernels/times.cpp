// SPDX-License-Identifier: Apache-2.0
#include <cstring>

#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

Span span(const std::int64_t* times, std::size_t n) {
  std::int64_t first = times[0], last = times[0];
  for (std::size_t i = 0; i < n; ++i) {
    first = times[i] < first ? times[i] : first;
    last = times[i] > last ? times[i] : last;
  }
  return {first, last};
}

std::size_t count_changes(const std::int64_t* times, std::size_t n) {
  std::size_t count = 0;
  for (std::size_t i = 1; i < n; ++i) count += times[i] != times[i - 1] ? 1 : 0;
  return count;
}

std::size_t count_leading(const std::int64_t* times, std::size_t n, std::int64_t start, std::uint64_t length) {
  const auto origin = static_cast<std::uint64_t>(start);
  constexpr std::size_t kBlockSize = 16;
  std::size_t i = 0;
  for (; i + kBlockSize <= n; i += kBlockSize) {
    bool all_inside = true;
    for (std::size_t k = 0; k < kBlockSize; ++k)
      all_inside &= static_cast<std::uint64_t>(times[i + k]) - origin < length;
    if (!all_inside) break;
  }
  while (i < n && static_cast<std::uint64_t>(times[i]) - origin < length) ++i;
  return i;
}

void fractions(const std::int64_t* times, std::int64_t start, std::int64_t end, std::size_t n, double* out) {
  const auto origin = static_cast<std::uint64_t>(start);
  const std::uint64_t duration = static_cast<std::uint64_t>(end) - origin;
  const double scale = 1.0 / static_cast<double>(duration);
  constexpr std::uint64_t kExact = std::uint64_t{1} << 52;
  if (duration >= kExact) {
    for (std::size_t i = 0; i < n; ++i) {
      out[i] = static_cast<double>(static_cast<std::uint64_t>(times[i]) - origin) * scale;
    }
    return;
  }
  // Puts an integer below 2^52 into the mantissa of 2^52, because few processors have vector instructions that convert
  // 64-bit integers.
  constexpr std::uint64_t kBits = 0x4330000000000000;
  constexpr double kValue = 4503599627370496.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint64_t bits = (static_cast<std::uint64_t>(times[i]) - origin) | kBits;
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    out[i] = (value - kValue) * scale;
  }
}

}  // namespace coframe::COFRAME_LEVEL
