// One question to a buffer: where is a frame, seen from another, and when.
#pragma once

#include <cstddef>
#include <string_view>

#include "core/history.hpp"

namespace coframe {

struct Question {
  std::string_view target, source;
  Stamp stamp = 0;  // of the target where the question travels in time
  // Time travel: the source at its own stamp, over a frame that stands still meanwhile.
  bool travels = false;
  std::string_view fixed;
  Stamp source_stamp = 0;
  // Numbers of the frames, where they are known already.
  FrameId target_id = 0, source_id = 0, fixed_id = 0;
};

struct Answer {
  Pose pose;
  Stamp stamp = 0;
};

// The same question at many times; arrays of the caller.
struct Batch {
  std::size_t count;
  Stamp* stamps;         // in: when, 0 is the latest; out: when that was
  double* translations;  // out, 3 a row
  double* quaternions;   // out, 4 a row
  Stamp* beyond;         // out: nanoseconds beyond the data
  bool nan_for_none;     // go on after a row without answer; else stop
};

}  // namespace coframe
