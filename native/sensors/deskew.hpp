// SPDX-License-Identifier: Apache-2.0
// Deskewing: points that were measured one after the other while the sensor moved are transformed to one frame, each
// with the transform at its own time.
#pragma once

#include <limits>
#include <vector>

#include "core/buffer.hpp"
#include "sensors/fields.hpp"

namespace coframe {

// The time of a point without a valid time.
inline constexpr Stamp kNoTime = std::numeric_limits<Stamp>::min();

struct DeskewRequest {
  FrameId target, source;
  Pose result_from_target;  // the pose of the target in the frame of the result
  const Stamp* times;       // of each point; 0: the latest common time, kNoTime: none
  bool nan_for_missing;     // points without a transform become NaN; if false, no point changes if one has none
  unsigned threads;
};

struct Missing {
  std::size_t count = 0;  // points without a transform
  std::size_t first = 0;  // index of the first of them
};

// Transforms the points in place and returns which have no transform. Changes nothing if no point has a transform.
Missing deskew(const Buffer& buffer, const DeskewRequest& request, const Grid& grid,
               const std::vector<Coordinates>& coordinates);

}  // namespace coframe
