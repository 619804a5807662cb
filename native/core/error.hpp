// SPDX-License-Identifier: Apache-2.0
// Why a look-up failed: a code and its facts. The text, tf2's to the letter, is made only when somebody reads it.
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
  only_other,     // ExtrapolationException: one sample, at another time
  too_new,        // ExtrapolationException: requested lies after the newest sample
  too_old,        // ExtrapolationException: requested lies before the oldest sample
  no_data,        // ExtrapolationException: the link's samples were cleared
};

// Which argument holds an invalid or unknown name.
enum class Argument : std::uint8_t { target_frame, source_frame, fixed_frame };

struct Failure {
  ErrorCode code = ErrorCode::none;
  Argument argument = Argument::target_frame;
  FrameId target = 0, source = 0;  // of the leg that failed
  // Where the walks up from both ended, at a root or for want of a sample; 0 where one was not begun or did not end.
  FrameId target_end = 0, source_end = 0;
  FrameId edge = 0;  // the child frame of the link without a sample at `requested`
  Stamp requested = 0;
  Stamp earliest = 0, latest = 0;  // what that link has
  std::string name;                // the invalid or unknown name

  // Begins anew, for a leg at a time.
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

// Why a transform was refused, as bits: tf2 runs all checks and logs each.
enum Refusal : unsigned {
  kSelfTransform = 1u << 0,
  kNoChildFrame = 1u << 1,
  kNoParentFrame = 1u << 2,
  kNan = 1u << 3,
  kDenormalisedQuaternion = 1u << 4,
  kOldData = 1u << 5,
  kFrozen = 1u << 6,  // not tf2's: the buffer takes nothing any more
};

}  // namespace coframe
