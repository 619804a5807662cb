// The way from one rotation to another, and what is between.
#pragma once

#include <cmath>

#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

// sin(t theta) / sin(theta) as a series of K terms in y = cos(theta) - 1, as in core/pose.hpp.
template <int K, int J = 1, class Number>
COFRAME_INLINE Number series(const Number& t2, double y) {
  constexpr double u = 1.0 / (J * (2.0 * J + 1.0)), v = J / (2.0 * J + 1.0);
  if constexpr (J == K) {
    return 1.0 + (t2 * u - v) * y;
  } else {
    return 1.0 + (t2 * u - v) * y * series<K, J + 1>(t2, y);
  }
}

// What slerp weighs one of two quaternions by whose angle has this cosine, which is not negative. The further they are
// apart, the more it takes; each way is good to 1e-16 down to `kLeast`.
template <int K>
struct Series {
  template <class Number>
  COFRAME_INLINE static Number weight(const Number& t, double cosine) {
    return t * series<K>(t * t, cosine - 1.0);
  }
};
struct Nearest : Series<2> {
  static constexpr double kLeast = 1.0 - 1.7e-5;
};
struct Near : Series<4> {
  static constexpr double kLeast = 1.0 - 1.9e-3;
};
struct Middle : Series<8> {
  static constexpr double kLeast = 1.0 - 4.3e-2;
};
// By way of half the angle: sin(2 t phi) / sin(2 phi) = sin(t phi) / sin(phi) * cos(t phi) / cos(phi).
struct Far {
  COFRAME_INLINE static double weight(double t, double cosine) {
    const double half = std::sqrt(0.5 + 0.5 * cosine);
    const double ratio = Series<18>::weight(t, half);
    return ratio * std::sqrt(1.0 - ratio * ratio * (0.5 - 0.5 * cosine)) / half;
  }
};

// Calls `loop` with the shortest way that is good for angles up to that of the cosine `least`.
template <class Loop>
void choose_way(double least, Loop&& loop) {
  if (least > Nearest::kLeast) return loop(Nearest());
  if (least > Near::kLeast) return loop(Near());
  if (least > Middle::kLeast) return loop(Middle());
  loop(Far());
}

struct Arc {
  double cosine, sign;
};

// The shorter of the two arcs between two quaternions: `sign` is that of the second one on it.
COFRAME_INLINE Arc arc(const double* a, const double* b) {
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  const double length = sign * cosine;
  return {length < 1.0 ? length : 1.0, sign};
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
