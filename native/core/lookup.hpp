// From frame to frame through the tree at one time: tf2's lookupTransform over a Tree.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/extrapolation.hpp"
#include "core/paths.hpp"
#include "core/pose.hpp"
#include "core/tree.hpp"

namespace coframe {

// `stamp` 0 asks for the latest common time and becomes it. False: `failure` says why; frames must exist (not 0).
// `paths` nullptr: every link is walked.
bool lookup(const Tree& tree, PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
            Failure& failure);

// The same along a remembered path, for two different frames; false where lookup() has to decide.
bool follow_path(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose);
// Whether follow_path() would answer.
bool check_path(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp stamp);

// The same beyond the data of a link, as far as `extrapolation` allows, which then knows how far it went.
bool lookup(const Tree& tree, Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
            Failure& failure);

// The newest time at which every link between both frames has data; 0 where all of them are static.
bool latest_common_time(const Tree& tree, FrameId target, FrameId source, Stamp& stamp, Failure& failure);

// The frames that lookup() would walk through from source to target, both included.
bool chain(const Tree& tree, FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
           Failure& failure);

}  // namespace coframe
