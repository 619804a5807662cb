// SPDX-License-Identifier: Apache-2.0
// The interpolation between two poses, for one processor level.
#pragma once

#include "kernels/lanes.hpp"
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

namespace {

#include "core/interpolation.inc"

COFRAME_INLINE Arc arc(const double* a, const double* b) {
  return shorter_arc(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]);
}

}  // namespace

}  // namespace coframe::COFRAME_LEVEL
