// SPDX-License-Identifier: Apache-2.0
// Where a frame was shortly before or after its samples: tf2 never says; who asks for it gets a bounded guess.
#pragma once

#include "core/history.hpp"

namespace coframe {

struct Extrapolation {
  enum class Method : std::uint8_t {
    twist,  // the motion between the two samples at that end goes on: constant twist, a screw in the frame itself
    hold,   // the sample at that end
  };

  Method method = Method::twist;
  Stamp limit = 0;     // nanoseconds beyond the samples
  Stamp furthest = 0;  // how far it was beyond, of all links asked so far

  Found at(const History::View& samples, Stamp stamp, Pose& pose, FrameId& parent);
};

// The part `share` of a motion, such that parts add up: exp(share * log(motion)). For any share.
Pose part_of_motion(const Pose& motion, double share);

}  // namespace coframe
