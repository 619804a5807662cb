// SPDX-License-Identifier: Apache-2.0
// Sine and cosine of several angles at a time, within 2e-16 of the exact values.
#pragma once

#include <cmath>

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

COFRAME_INLINE void sine_and_cosine(double angle, double& sine, double& cosine) {
  sine = std::sin(angle);
  cosine = std::cos(angle);
}

#if COFRAME_LANES > 1
// The series of fdlibm (k_sin.c, k_cos.c) around the nearest multiple of a quarter turn. The multiple is subtracted in
// three parts; the first two have 33 bits, so that their products with numbers up to 2^20 are exact.
COFRAME_INLINE void sine_and_cosine(const Lanes& angle, Lanes& sine, Lanes& cosine) {
  constexpr double kMax = 1e5;
  if (!all_above(kMax - with_sign(angle, sign_of(angle)), 0.0)) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      double s, c;
      sine_and_cosine(angle[i], s, c);
      sine[i] = s;
      cosine[i] = c;
    }
    return;
  }
  constexpr double kToInteger = 6755399441055744.0;  // 1.5 * 2^52: the last bits of the sum are the nearest integer
  const Lanes shifted = angle * 0.63661977236758134308 + kToInteger;
  const Lanes quarters = shifted - kToInteger;
  const Lanes r = ((angle - quarters * 1.57079632673412561417e+00) - quarters * 6.07710050630396597660e-11) -
                  quarters * 2.02226624879595063154e-21;
  const Lanes z = r * r;
  const Lanes s = r + r * z *
                          (-1.66666666666666324348e-01 +
                           z * (8.33333333332248946124e-03 +
                                z * (-1.98412698298579493134e-04 +
                                     z * (2.75573137070700676789e-06 +
                                          z * (-2.50507602534068634195e-08 + z * 1.58969099521155010221e-10)))));
  const Lanes c =
      (1.0 - 0.5 * z) + z * z *
                            (4.16666666666666019037e-02 +
                             z * (-1.38888888888741095749e-03 +
                                  z * (2.48015872894767294178e-05 +
                                       z * (-2.75573143513906633035e-07 +
                                            z * (2.08757232129817482790e-09 + z * -1.13596475577881948265e-11)))));
  const LaneBits quadrant = (LaneBits)shifted;
  const LaneBits is_odd = -(quadrant & 1);
  sine = (Lanes)((LaneBits)(is_odd ? c : s) ^ ((quadrant & 2) << 62));
  cosine = (Lanes)((LaneBits)(is_odd ? s : c) ^ (((quadrant + 1) & 2) << 62));
}
#endif

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
