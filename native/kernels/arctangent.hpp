// SPDX-License-Identifier: Apache-2.0
// Arctangents of several numbers at a time, within 3e-16 of the exact values.
#pragma once

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

// Returns the angle of the vector (x, y) in [0, pi / 2], where x and y are not negative and not both zero. The rational
// function for |t| <= 0.66 and the constants are those of Cephes (S. Moshier, atan.c).
COFRAME_INLINE Lanes arctangent(const Lanes& y, const Lanes& x) {
  constexpr double kQuarter = 7.85398163397448309616e-01, kQuarterRest = 3.061616997868383017935e-17;
  constexpr double kHalf = 2.0 * kQuarter, kHalfRest = 2.0 * kQuarterRest;
  const auto is_steep = y > x;
  const Lanes low = is_steep ? x : y, high = is_steep ? y : x;
  const auto is_large = low > 0.66 * high;
  const Lanes difference = low - high, sum = low + high;
  const Lanes t = (is_large ? difference : low) / (is_large ? sum : high);
  const Lanes z = t * t;
  const Lanes p = (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
                   1.228866684490136173410e2) *
                      z -
                  6.485021904942025371773e1;
  const Lanes q =
      ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
       4.853903996359136964868e2) *
          z +
      1.945506571482613964425e2;
  const Lanes small_angle = t + t * (z * p / q);
  const Lanes large_angle = kQuarter + (small_angle + kQuarterRest);
  const Lanes angle = is_large ? large_angle : small_angle;
  const Lanes complement = kHalf - (angle - kHalfRest);
  return is_steep ? complement : angle;
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
