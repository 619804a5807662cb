// SPDX-License-Identifier: Apache-2.0
// Transforms all points of a cloud by one pose.
#pragma once

#include <vector>

#include "sensors/fields.hpp"

namespace coframe {

// Transforms the points in place.
void transform_points(const Pose& pose, const Grid& grid, const std::vector<Coordinates>& coordinates,
                      unsigned threads);

}  // namespace coframe
