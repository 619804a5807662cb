// SPDX-License-Identifier: Apache-2.0
// Spherical linear interpolation (slerp) between two unit quaternions.
#pragma once

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

// sin(t theta) / sin(theta) as a series in y = cos(theta) - 1 with K terms (after D. Eberly, "A Fast and Accurate
// Algorithm for Computing SLERP"). It avoids libm calls, which took most of the time of a lookup.
template <int K, int J = 1, class T, class Angle>
COFRAME_INLINE T weight_series(const T& t2, const Angle& y) {
  constexpr double u = 1.0 / (J * (2.0 * J + 1.0)), v = J / (2.0 * J + 1.0);
  const T term = (t2 * u - v) * y;
  if constexpr (J == K) {
    return 1.0 + term;
  } else {
    return 1.0 + term * weight_series<K, J + 1>(t2, y);
  }
}

// The same kind of series for theta / sin(theta).
template <int K, int J = 1, class T>
COFRAME_INLINE T angle_series(const T& y) {
  const T term = y * (-J / (2.0 * J + 1.0));
  if constexpr (J == K) {
    return 1.0 + term;
  } else {
    return 1.0 + term * angle_series<K, J + 1>(y);
  }
}

// Computes the weight of one end for slerp, and theta / sin(theta), from the cosine of the angle theta between two
// quaternions, which is not negative. Larger angles need more terms. Each class below is exact to 1e-16 for cosines
// from `kMinCosine` to 1.
template <int K>
struct Series {
  template <class T, class Angle>
  COFRAME_INLINE static T weight(const T& t, const Angle& cosine) {
    const T t2 = t * t;
    const Angle y = cosine - 1.0;
    return t * weight_series<K>(t2, y);
  }
  template <class T>
  COFRAME_INLINE static T angle_by_sine(const T& cosine) {
    const T y = cosine - 1.0;
    return angle_series<K>(y);
  }

  // The same weight for many fractions of one angle: the series is expanded once into a polynomial in t^2.
  class WeightAt {
   public:
    COFRAME_INLINE explicit WeightAt(double cosine) {
      const double y = cosine - 1.0;
      factors_[0] = 1.0;
      for (int j = K; j >= 1; --j) {
        const double u = y / (j * (2.0 * j + 1.0)), v = y * j / (2.0 * j + 1.0);
        factors_[K - j + 1] = u * factors_[K - j];
        for (int i = K - j; i >= 1; --i) factors_[i] = u * factors_[i - 1] - v * factors_[i];
        factors_[0] = 1.0 - v * factors_[0];
      }
    }
    template <class T>
    COFRAME_INLINE T operator()(const T& t) const {
      const T t2 = t * t;
      T sum = t2 * factors_[K] + factors_[K - 1];
      for (int i = K - 2; i >= 0; --i) sum = sum * t2 + factors_[i];
      return t * sum;
    }

   private:
    double factors_[K + 1];
  };
};
struct TinyAngle : Series<2> {
  static constexpr double kMinCosine = 1.0 - 1.7e-5;
};
struct SmallAngle : Series<4> {
  static constexpr double kMinCosine = 1.0 - 1.9e-3;
};
struct MediumAngle : Series<8> {
  static constexpr double kMinCosine = 1.0 - 4.3e-2;
};
// Computed from half the angle: sin(2 t phi) / sin(2 phi) = sin(t phi) / sin(phi) * cos(t phi) / cos(phi).
struct LargeAngle {
  template <class T>
  COFRAME_INLINE static T weight(const T& t, const T& cosine) {
    const T half = root(T(0.5 + 0.5 * cosine));
    const T ratio = Series<18>::weight(t, half);
    return ratio * root(T(1.0 - ratio * ratio * (0.5 - 0.5 * cosine))) / half;
  }
  template <class T>
  COFRAME_INLINE static T angle_by_sine(const T& cosine) {
    const T half = root(T(0.5 + 0.5 * cosine));
    return Series<18>::angle_by_sine(half) / half;
  }

  class WeightAt {
   public:
    COFRAME_INLINE explicit WeightAt(double cosine) : cosine_(cosine) {}
    template <class T>
    COFRAME_INLINE T operator()(const T& t) const {
      return weight(t, cosine_);
    }

   private:
    double cosine_;
  };
};

// Calls `loop` with the cheapest class that is exact for all of these cosines.
template <class T, class Loop>
COFRAME_INLINE void choose_slerp(const T& cosine, Loop&& loop) {
  if (all_above(cosine, TinyAngle::kMinCosine)) return loop(TinyAngle());
  if (all_above(cosine, SmallAngle::kMinCosine)) return loop(SmallAngle());
  if (all_above(cosine, MediumAngle::kMinCosine)) return loop(MediumAngle());
  loop(LargeAngle());
}

// The slerp weights of both ends at the fraction t, and with kAngle also theta / sin(theta).
template <class T>
struct Weights {
  T first, second, angle_by_sine;
};

template <bool kAngle, class Slerp, class T>
COFRAME_INLINE Weights<T> weights_by(const T& t, const T& cosine) {
  const T rest = 1.0 - t;
  Weights<T> weights{Slerp::weight(rest, cosine), Slerp::weight(t, cosine), cosine};
  if constexpr (kAngle) weights.angle_by_sine = Slerp::angle_by_sine(cosine);
  return weights;
}

template <bool kAngle, class T>
COFRAME_INLINE Weights<T> weights_at(const T& t, const T& cosine) {
  if (all_above(cosine, TinyAngle::kMinCosine)) return weights_by<kAngle, TinyAngle>(t, cosine);
  if (all_above(cosine, SmallAngle::kMinCosine)) return weights_by<kAngle, SmallAngle>(t, cosine);
  if (all_above(cosine, MediumAngle::kMinCosine)) return weights_by<kAngle, MediumAngle>(t, cosine);
  return weights_by<kAngle, LargeAngle>(t, cosine);
}

struct Arc {
  double cosine, sign;
};

// Returns the shorter of the two arcs between two quaternions. On it, the second quaternion has the sign `sign`.
COFRAME_INLINE Arc arc(const double* a, const double* b) {
  const double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  const double sign = cosine < 0.0 ? -1.0 : 1.0;
  const double length = sign * cosine;
  return {length < 1.0 ? length : 1.0, sign};
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
