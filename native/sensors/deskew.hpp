// SPDX-License-Identifier: Apache-2.0
// Points that were measured one after the other while the sensor moved, seen from one frame: each by where the sensor
// was at the point's own time.
#pragma once

#include <limits>
#include <vector>

#include "core/buffer.hpp"
#include "sensors/fields.hpp"

namespace coframe {

// The time of points that have none.
inline constexpr Stamp kNoTime = std::numeric_limits<Stamp>::min();

struct Deskewing {
  FrameId target, source;
  Pose onward;         // of the target, relative to the frame of the result
  const Stamp* times;  // of each point; 0 is the latest, kNoTime none
  bool nan_for_none;   // points without a transform become NaN; otherwise no point changes if one has none
  unsigned threads;
};

struct Missing {
  std::size_t count = 0;  // points without a transform
  std::size_t first = 0;  // the first of them
};

// In place. Nothing is touched where no point has a transform.
Missing deskew(const Buffer& buffer, const Deskewing& how, const Grid& grid,
               const std::vector<Coordinates>& coordinates);

}  // namespace coframe
