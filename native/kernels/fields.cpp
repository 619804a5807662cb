// Numbers as they lie in clouds.
#include <cstring>

#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

COFRAME_INLINE std::uint32_t swapped(std::uint32_t v) {
  return v >> 24 | (v >> 8 & 0xff00u) | (v << 8 & 0xff0000u) | v << 24;
}
COFRAME_INLINE std::uint64_t swapped(std::uint64_t v) {
  return static_cast<std::uint64_t>(swapped(static_cast<std::uint32_t>(v))) << 32 |
         swapped(static_cast<std::uint32_t>(v >> 32));
}

// How a number is kept: T, as it is or with its bytes the other way round.
template <class T, class Bits, bool kSwapped>
struct Kept {
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
void choose_kept(Number number, Loop&& loop) {
  switch (number) {
    case Number::float32: return loop(Kept<float, std::uint32_t, false>());
    case Number::float64: return loop(Kept<double, std::uint64_t, false>());
    case Number::float32_swapped: return loop(Kept<float, std::uint32_t, true>());
    case Number::float64_swapped: return loop(Kept<double, std::uint64_t, true>());
  }
}

}  // namespace

void load(const Column& from, std::size_t n, double* __restrict out) {
  choose_kept(from.number, [&](auto kept) {
    const char* const data = from.data;
    const std::ptrdiff_t step = from.step;
    for (std::size_t i = 0; i < n; ++i) out[i] = kept.load(data + static_cast<std::ptrdiff_t>(i) * step);
  });
}

void store(const Column& to, std::size_t n, const double* __restrict in) {
  choose_kept(to.number, [&](auto kept) {
    char* const data = to.data;
    const std::ptrdiff_t step = to.step;
    for (std::size_t i = 0; i < n; ++i) kept.store(data + static_cast<std::ptrdiff_t>(i) * step, in[i]);
  });
}

}  // namespace coframe::COFRAME_LEVEL
