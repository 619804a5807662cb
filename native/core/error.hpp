// SPDX-License-Identifier: Apache-2.0
// Why a lookup failed: an error code and its facts. tf2's text is composed only when it is read.
#pragma once

#include <cstdint>
#include <string>

#include "core/history.hpp"

namespace coframe {

class Tree;

enum class ErrorCode : std::uint8_t {
  none,
  empty_name,     // InvalidArgumentException
  leading_slash,  // InvalidArgumentException
  unknown_frame,  // LookupException
  loop,           // LookupException
  not_connected,  // ConnectivityException
  only_other,     // ExtrapolationException: the only sample has another time
  too_new,        // ExtrapolationException: requested lies after the newest sample
  too_old,        // ExtrapolationException: requested lies before the oldest sample
  no_data,        // ExtrapolationException: the edge's samples were cleared
};

// Which argument holds an invalid or unknown name.
enum class Argument : std::uint8_t { target_frame, source_frame, fixed_frame };

struct Failure {
  ErrorCode code = ErrorCode::none;
  Argument argument = Argument::target_frame;
  FrameId target = 0, source = 0;  // of the leg that failed
  // The frames at which the walks towards the root ended, at a root or at a missing sample; 0 if a walk was not started
  // or did not end.
  FrameId target_end = 0, source_end = 0;
  FrameId edge = 0;  // the child frame of the edge that has no sample at `requested`
  Stamp requested = 0;
  Stamp earliest = 0, latest = 0;  // the range of that edge's samples
  std::string name;                // the invalid or unknown name

  // Resets the failure for the next leg of a lookup.
  void reset(ErrorCode reason, FrameId leg_target, FrameId leg_source, Stamp stamp) {
    code = reason;
    argument = Argument::target_frame;
    target = leg_target;
    source = leg_source;
    target_end = source_end = edge = 0;
    requested = stamp;
    earliest = latest = 0;
    name.clear();
  }
};

// "lookupTransform argument target_frame", as tf2's messages name an argument of `function`.
std::string argument_name(const char* function, Argument argument);

// The text of the exception that lookupTransform raises.
std::string lookup_text(const Failure& failure, const Tree& tree);
// The text that canTransform gives back.
std::string can_transform_text(const Failure& failure, const Tree& tree);
// The text of the exception that get_latest_common_time raises.
std::string latest_common_time_text(const Failure& failure, const Tree& tree);

// Why a transform was rejected, as bits: tf2 runs all checks and logs each failure.
enum Refusal : unsigned {
  kSelfTransform = 1u << 0,
  kNoChildFrame = 1u << 1,
  kNoParentFrame = 1u << 2,
  kNan = 1u << 3,
  kDenormalizedQuaternion = 1u << 4,
  kOldData = 1u << 5,
  kFrozen = 1u << 6,         // not a check of tf2: the buffer is frozen
  kTooManyFrames = 1u << 7,  // not a check of tf2: other nodes have published more names than the buffer stores
  kShared = 1u << 8,         // not a check of tf2: the buffer only reads what another buffer writes
};

}  // namespace coframe
