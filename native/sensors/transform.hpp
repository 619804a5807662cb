// SPDX-License-Identifier: Apache-2.0
// All points of a cloud, seen from another frame at one time.
#pragma once

#include <vector>

#include "sensors/fields.hpp"

namespace coframe {

// In place.
void transform_points(const Pose& pose, const Grid& grid, const std::vector<Coordinates>& coordinates,
                      unsigned threads);

}  // namespace coframe
