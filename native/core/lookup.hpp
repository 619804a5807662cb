// SPDX-License-Identifier: Apache-2.0
// From frame to frame through the tree at one time: tf2's lookupTransform over a Tree.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "core/extrapolation.hpp"
#include "core/paths.hpp"
#include "core/pose.hpp"
#include "core/tree.hpp"

namespace coframe {

// `stamp` 0 asks for the latest common time and becomes it. False: `failure` says why; frames must exist (not 0).
// `paths` nullptr: every link is walked.
bool lookup_in_tree(const Tree& tree, PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                    Failure& failure);

// The same along a remembered path, for two different frames; false where lookup() has to decide.
bool lookup_path_in_tree(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose);
// Whether lookup_path_in_tree() would answer: all links have samples at a time that lies in what all of them reach.
inline bool check_path_in_tree(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp stamp) {
  const PathCache::Path* path = paths.find(tree, target, source);
  if (!path) return false;
  Stamp begin = kFirstStamp, end = kLastStamp;
  for (const PathCache::Step& link : path->steps) {
    const History::Span span = link.history->span();
    if (span.parent != link.parent) return false;
    begin = std::max(begin, span.first);
    end = std::min(end, span.last);
  }
  if (stamp != 0) return begin <= stamp && stamp <= end;
  return begin <= end && end != 0;  // a newest stamp of zero does not hold the common time back
}

// The same beyond the data of a link, as far as `extrapolation` allows, which then knows how far it went.
bool extrapolate_in_tree(const Tree& tree, Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp,
                         Pose& pose, Failure& failure);

// The newest time at which every link between both frames has data; 0 where all of them are static.
bool latest_common_time(const Tree& tree, FrameId target, FrameId source, Stamp& stamp, Failure& failure);

// The frames that lookup() would walk through from source to target, both included.
bool chain(const Tree& tree, FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
           Failure& failure);

}  // namespace coframe
