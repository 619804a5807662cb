// SPDX-License-Identifier: Apache-2.0
// Screw motions: the motions of a body with a constant twist.
#pragma once

#include "core/pose.hpp"

namespace coframe {

// Returns the fraction `share` of a motion such that fractions add up: exp(share * log(motion)). Any share is valid.
Pose part_of_motion(const Pose& motion, double share);

// Returns the pose at a fraction of the screw motion from a to b.
Pose along_screw_motion(const Pose& a, const Pose& b, double share);

}  // namespace coframe
