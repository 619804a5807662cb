// SPDX-License-Identifier: Apache-2.0
// Lookups in one consistent state of a Tree: tf2's lookupTransform.
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

// Looks up a transform. `stamp` 0 requests the latest common time and is replaced by it. Returns false with the reason
// in `failure`. The frames must exist (not be 0). Without `paths` every edge is walked.
bool lookup_in_tree(const Tree& tree, PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                    Failure& failure);

// The same along a cached path, for two different frames. Returns false if lookup_in_tree() has to decide.
bool lookup_path_in_tree(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose);
// Returns whether lookup_path_in_tree() would succeed: all edges have data, and the time lies in their common range.
inline bool check_path_in_tree(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp stamp) {
  const PathCache::Path* path = paths.find(tree, target, source);
  if (!path) return false;
  Stamp begin = kFirstStamp, end = kLastStamp;
  for (const PathCache::Step& edge : path->steps) {
    const History::Span span = edge.history->span();
    if (span.parent != edge.parent) return false;
    begin = std::max(begin, span.first);
    end = std::min(end, span.last);
  }
  if (stamp != 0) return begin <= stamp && stamp <= end;
  return begin <= end && end != 0;  // a newest stamp of zero does not limit the common time
}

// The same, beyond the data of an edge as far as `extrapolation` allows; `furthest` is set.
bool extrapolate_in_tree(const Tree& tree, Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp,
                         Pose& pose, Failure& failure);

// Computes the newest time at which every edge between both frames has data; 0 if all of them are static.
bool latest_common_time(const Tree& tree, FrameId target, FrameId source, Stamp& stamp, Failure& failure);

// Computes the frames on the chain from source to target, both included.
bool chain(const Tree& tree, FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
           Failure& failure);

}  // namespace coframe
