// SPDX-License-Identifier: Apache-2.0
#include "core/error.hpp"

#include <cstdio>

#include "core/dump.hpp"
#include "core/tree.hpp"

namespace coframe {

namespace {

const char* argument_text(Argument argument) {
  switch (argument) {
    case Argument::target_frame: return "target_frame";
    case Argument::source_frame: return "source_frame";
    default: return "fixed_frame";
  }
}

std::string seconds_text(Stamp stamp) {
  char text[64];
  const int length = std::snprintf(text, sizeof text, "%.6f", to_seconds(stamp));
  return std::string(text, static_cast<std::size_t>(length));
}

const char* invalid_name_reason(ErrorCode code) {
  switch (code) {
    case ErrorCode::empty_name: return "in tf2 frame_ids cannot be empty";
    case ErrorCode::leading_slash: return "in tf2 frame_ids cannot start with a '/'";
    default: return "frame does not exist";
  }
}

bool is_name_error(ErrorCode code) {
  return code == ErrorCode::empty_name || code == ErrorCode::leading_slash || code == ErrorCode::unknown_frame;
}

std::string extrapolation_head(const Failure& failure) {
  switch (failure.code) {
    case ErrorCode::only_other:
      return "Lookup would require extrapolation at time " + seconds_text(failure.requested) + ", but only time " +
             seconds_text(failure.latest) + " is in the buffer";
    case ErrorCode::too_new:
      return "Lookup would require extrapolation into the future.  Requested time " + seconds_text(failure.requested) +
             " but the latest data is at time " + seconds_text(failure.latest);
    case ErrorCode::too_old:
      return "Lookup would require extrapolation into the past.  Requested time " + seconds_text(failure.requested) +
             " but the earliest data is at time " + seconds_text(failure.earliest);
    default: return "";
  }
}

// The texts that all functions have in common, once the names are valid.
std::string tree_text(const Failure& failure, const Tree& tree) {
  if (failure.code == ErrorCode::not_connected) {
    return "Could not find a connection between '" + tree.name(failure.target) + "' and '" + tree.name(failure.source) +
           "' because they are not part of the same tree.Tf has two or more unconnected trees.";
  }
  if (failure.code == ErrorCode::loop) {
    return "The tf tree is invalid because it contains a loop.\n" + frames_as_string(tree) + "\n";
  }
  return extrapolation_head(failure) + ", when looking up transform from frame [" + tree.name(failure.source) +
         "] to frame [" + tree.name(failure.target) + "]";
}

std::string invalid_name_text(const Failure& failure, const std::string& where) {
  if (failure.code == ErrorCode::unknown_frame)
    return "\"" + failure.name + "\" passed to " + where + " does not exist. ";
  return "Invalid argument \"" + failure.name + "\" passed to " + where + " - " + invalid_name_reason(failure.code);
}

}  // namespace

std::string argument_name(const char* function, Argument argument) {
  return std::string(function) + " argument " + argument_text(argument);
}

std::string lookup_text(const Failure& failure, const Tree& tree) {
  if (!is_name_error(failure.code)) return tree_text(failure, tree);
  return invalid_name_text(failure, argument_name("lookupTransform", failure.argument));
}

std::string can_transform_text(const Failure& failure, const Tree& tree) {
  if (!is_name_error(failure.code)) return tree_text(failure, tree);
  return "Invalid frame ID \"" + failure.name + "\" passed to " + argument_name("canTransform", failure.argument) +
         " - " + invalid_name_reason(failure.code);
}

std::string latest_common_time_text(const Failure& failure, const Tree& tree) {
  if (!is_name_error(failure.code)) return tree_text(failure, tree);
  return invalid_name_text(failure, "get_latest_common_time");
}

}  // namespace coframe
