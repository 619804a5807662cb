// SPDX-License-Identifier: Apache-2.0
// One lookup: the pose of a frame relative to another at a time.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/history.hpp"

namespace coframe {

struct LookupQuery {
  std::string_view target, source;
  Stamp stamp = 0;  // the target's, for time travel
  // Time travel: the source is looked up at its own stamp, through a frame that does not move in between.
  bool time_travel = false;
  std::string_view fixed;
  Stamp source_stamp = 0;
  // The ids of the frames, if they are known already.
  FrameId target_id = 0, source_id = 0, fixed_id = 0;
};

struct LookupResult {
  Pose pose;
  Stamp stamp = 0;
};

// One lookup at many times. The arrays belong to the caller.
struct Batch {
  enum class Missing {
    stop,  // stop at the first row without a transform
    nan,   // fill the row with NaN and continue
    clip,  // use the nearest time at which all edges have data
  };
  std::size_t count;
  Stamp* stamps;        // in: requested, 0 for the latest; out: of the results
  double* poses;        // out: x, y, z, qx, qy, qz, qw a row
  double* twists;       // out, if wanted: vx, vy, vz, wx, wy, wz a row, m/s and rad/s along the target's axes
  Stamp* extrapolated;  // out, optional: nanoseconds of extrapolation
  Missing missing = Missing::stop;
};

// Many samples of one edge. The arrays belong to the caller.
struct Track {
  std::string_view parent, child;
  std::size_t count;
  const Stamp* stamps;
  const double* poses;  // x, y, z, qx, qy, qz, qw a row
};

}  // namespace coframe
