// SPDX-License-Identifier: Apache-2.0
// One query to a buffer: where is a frame, seen from another, and when.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/history.hpp"

namespace coframe {

struct LookupQuery {
  std::string_view target, source;
  Stamp stamp = 0;  // of the target where the query travels in time
  // Time travel: the source at its own stamp, over a frame that stands still meanwhile.
  bool time_travel = false;
  std::string_view fixed;
  Stamp source_stamp = 0;
  // Numbers of the frames, where they are known already.
  FrameId target_id = 0, source_id = 0, fixed_id = 0;
};

struct LookupResult {
  Pose pose;
  Stamp stamp = 0;
};

// The same query at many times; arrays of the caller.
struct Batch {
  enum class Missing {
    stop,  // at the first row without answer
    nan,   // fill it with NaN and go on
    clip,  // take the nearest time for which all links have data
  };
  std::size_t count;
  Stamp* stamps;   // in: when, 0 is the latest; out: when that was
  double* poses;   // out: x, y, z, qx, qy, qz, qw a row
  double* twists;  // out, if wanted: vx, vy, vz, wx, wy, wz a row, m/s and rad/s along the target's axes
  Stamp* beyond;   // out, if extrapolated: nanoseconds beyond the data
  Missing missing = Missing::stop;
};

// One edge at many times; arrays of the caller.
struct Track {
  std::string_view parent, child;
  std::size_t count;
  const Stamp* stamps;
  const double* poses;  // x, y, z, qx, qy, qz, qw a row
};

}  // namespace coframe
