// SPDX-License-Identifier: Apache-2.0
// COFRAME_SHUFFLE(a, b, places...): the numbers of two vectors in another order, where those of `b` are counted after
// those of `a`. Not defined for compilers without vector extensions.
#pragma once

#if !defined(__has_builtin)
// MSVC, and GCC before version 10
#elif __has_builtin(__builtin_shufflevector)

#define COFRAME_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)

#elif __has_builtin(__builtin_shuffle)

#include <type_traits>

#include "kernels/level.hpp"

#define COFRAME_SHUFFLE(a, b, ...) shuffled<__VA_ARGS__>(a, b)

namespace coframe::COFRAME_LEVEL {

namespace {

// The function of GCC 10 and 11 returns as many numbers as each of its arguments has.
template <int... kPlaces, class Numbers>
COFRAME_INLINE auto shuffled(const Numbers& a, const Numbers& b) {
  if constexpr (sizeof...(kPlaces) * sizeof(a[0]) == sizeof(Numbers)) {
    using Place = std::conditional_t<sizeof(a[0]) == 8, long long, int>;
    typedef Place Places __attribute__((vector_size(sizeof(Numbers))));
    return __builtin_shuffle(a, b, Places{kPlaces...});
  } else {
    typedef double Both __attribute__((vector_size(8 * sizeof...(kPlaces))));
    const std::size_t n = sizeof(a) / sizeof(a[0]);
    return Both{(kPlaces < n ? a[kPlaces % n] : b[kPlaces % n])...};
  }
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL

#endif
