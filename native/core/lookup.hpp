// From frame to frame through the tree at one time: tf2's lookupTransform over a Tree.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/tree.hpp"

namespace coframe {

// Paths that were walked once, valid for one version of the tree. All are forgotten when they become too many: a
// program may ask for every pair of a thousand frames.
class PathCache {
 public:
  struct Step {
    const History* history;
    bool down;  // from parent to child: the pose is to be inverted
  };
  struct Path {
    std::uint64_t version = 0;
    bool usable = false;  // false: not connected, too deep, or a frame on it changed its parent
    std::vector<Step> steps;
  };

  // The steps from `source` to `target` as of the newest data, or nullptr where the slow walk must decide.
  const Path* find(const Tree& tree, FrameId target, FrameId source);

 private:
  // About 4 MB: entries and steps.
  static constexpr std::size_t kMaxEntries = 1 << 14;
  static constexpr std::size_t kMaxSteps = 1 << 17;

  static void walk(const Tree& tree, FrameId target, FrameId source, Path& path);

  std::size_t steps_ = 0;  // of all paths
  std::unordered_map<std::uint64_t, Path> paths_;
};

// `stamp` 0 asks for the latest common time and becomes it. False: `failure` says why; frames must exist (not 0).
bool lookup(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
            Failure& failure);

// The newest time at which every link between both frames has data; 0 where all of them are static.
bool latest_common_time(const Tree& tree, FrameId target, FrameId source, Stamp& stamp, Failure& failure);

// The frames that lookup() would walk through from source to target, both included.
bool chain(const Tree& tree, FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
           Failure& failure);

}  // namespace coframe
