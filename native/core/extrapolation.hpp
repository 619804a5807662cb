// SPDX-License-Identifier: Apache-2.0
// Bounded extrapolation shortly before or after the samples of a frame. tf2 never extrapolates; callers opt in.
#pragma once

#include "core/history.hpp"

namespace coframe {

struct Extrapolation {
  enum class Method : std::uint8_t {
    twist,  // continue the motion between the two samples at that end: constant twist, a screw motion
    hold,   // keep the sample at that end
  };

  Method method = Method::twist;
  Stamp limit = 0;            // nanoseconds beyond the samples
  Stamp furthest = 0;         // the largest extrapolation over all edges so far
  bool along_screws = false;  // how poses between samples are interpolated

  Found at(const History::View& samples, Stamp stamp, Pose& pose, FrameId& parent);
};

}  // namespace coframe
