#include "core/lookup.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "core/dump.hpp"

namespace coframe {

namespace {

constexpr int kMaxDepth = 1000;  // tf2's MAX_GRAPH_DEPTH
constexpr Stamp kNoTime = std::numeric_limits<Stamp>::max();

bool fail_loop(const Tree& tree, FrameId target, FrameId source, Failure& failure) {
  failure = Failure{};
  failure.code = ErrorCode::loop;
  failure.target = target;
  failure.source = source;
  failure.name = frames_as_string(tree);
  return false;
}

// The frame above which nobody says anything, by the newest data.
FrameId root_of(const Tree& tree, FrameId frame) {
  for (int depth = 0; depth <= kMaxDepth; ++depth) {
    const History* history = tree.history(frame);
    if (!history || history->empty()) break;
    frame = history->parent();
  }
  return frame;
}

bool fail_not_connected(const Tree& tree, FrameId target, FrameId source, Stamp stamp, Failure& failure) {
  failure = Failure{};
  failure.code = ErrorCode::not_connected;
  failure.target = target;
  failure.source = source;
  failure.requested = stamp;
  failure.target_root = root_of(tree, target);
  failure.source_root = root_of(tree, source);
  return false;
}

Failure missing_sample(const History& history, Found found, FrameId edge, FrameId target, FrameId source,
                       Stamp stamp) {
  Failure failure;
  switch (found) {
    case Found::only_other: failure.code = ErrorCode::only_other; break;
    case Found::too_new: failure.code = ErrorCode::too_new; break;
    case Found::too_old: failure.code = ErrorCode::too_old; break;
    default: failure.code = ErrorCode::no_data; break;
  }
  failure.target = target;
  failure.source = source;
  failure.edge = edge;
  failure.requested = stamp;
  failure.earliest = history.oldest();
  failure.latest = history.newest();
  return failure;
}

// What a walk through the tree meets, in both directions, is written here.
struct Walk {
  Pose source_pose;  // of the source frame, seen from where the walk stands
  Pose target_pose;
  std::vector<FrameId>* up = nullptr;    // frames from the source, if wanted
  std::vector<FrameId>* down = nullptr;  // frames from the target, if wanted
};

// tf2's walkToTopParent: first from the source as far as data reach, then from the target to that frame. Which of
// several possible errors is told depends on this order.
bool walk_tree(const Tree& tree, FrameId target, FrameId source, Stamp stamp, Walk& walk, Failure& failure) {
  Pose step;
  FrameId parent = 0;
  FrameId top = source;
  std::optional<Failure> gap;  // the link at which the source's walk stopped
  int depth = 0;
  for (FrameId frame = source;; frame = parent) {
    top = frame;
    if (walk.up) walk.up->push_back(frame);
    const History* history = tree.history(frame);
    if (!history) break;
    const Found found = history->at(stamp, step, parent);
    if (found != Found::ok) {
      gap = missing_sample(*history, found, frame, target, source, stamp);
      break;
    }
    if (frame == target) return true;
    compose(step, walk.source_pose);
    if (++depth > kMaxDepth) return fail_loop(tree, target, source, failure);
  }

  depth = 0;
  for (FrameId frame = target; frame != top; frame = parent) {
    if (walk.down) walk.down->push_back(frame);
    const History* history = tree.history(frame);
    if (!history) {
      if (!gap) return fail_not_connected(tree, target, source, stamp, failure);
      failure = std::move(*gap);
      return false;
    }
    const Found found = history->at(stamp, step, parent);
    if (found != Found::ok) {
      failure = missing_sample(*history, found, frame, target, source, stamp);
      return false;
    }
    if (frame == source) {  // the source lies on the target's way up: only this side counts
      walk.source_pose = Pose{};
      if (walk.up) walk.up->clear();
      return true;
    }
    compose(step, walk.target_pose);
    if (++depth > kMaxDepth) return fail_loop(tree, target, source, failure);
  }
  return true;
}

bool walk_pose(const Tree& tree, FrameId target, FrameId source, Stamp stamp, Pose& pose, Failure& failure) {
  Walk walk;
  if (!walk_tree(tree, target, source, stamp, walk, failure)) return false;
  pose = walk.source_pose;
  compose_inverse(walk.target_pose, pose);
  return true;
}

// Along a remembered path; false where a link has no sample, and the slow walk has to say what that means.
bool path_pose(const std::vector<PathCache::Step>& steps, Stamp stamp, Pose& pose) {
  pose = Pose{};
  Pose step;
  FrameId parent;
  for (const PathCache::Step& link : steps) {
    if (link.history->at(stamp, step, parent) != Found::ok) return false;
    if (link.down) {
      compose_inverse(step, pose);
    } else {
      compose(step, pose);
    }
  }
  return true;
}

// Links that are static, or whose newest stamp is zero, do not hold the common time back.
void keep_earlier(Stamp stamp, Stamp& common) {
  if (stamp != 0) common = std::min(common, stamp);
}

Stamp path_common_time(const std::vector<PathCache::Step>& steps) {
  Stamp common = kNoTime;
  for (const PathCache::Step& link : steps) keep_earlier(link.history->newest(), common);
  return common == kNoTime ? 0 : common;
}

}  // namespace

const PathCache::Path* PathCache::find(const Tree& tree, FrameId target, FrameId source) {
  const std::uint64_t key = (static_cast<std::uint64_t>(target) << 32) | source;
  auto found = paths_.find(key);
  if (found != paths_.end() && found->second.version == tree.version()) {
    return found->second.usable ? &found->second : nullptr;
  }
  if (paths_.size() >= kMaxEntries || steps_ >= kMaxSteps) {
    paths_.clear();
    steps_ = 0;
    found = paths_.end();
  }
  Path& path = found != paths_.end() ? found->second : paths_[key];
  steps_ -= path.steps.size();
  walk(tree, target, source, path);
  steps_ += path.steps.size();
  path.version = tree.version();
  return path.usable ? &path : nullptr;
}

void PathCache::walk(const Tree& tree, FrameId target, FrameId source, Path& path) {
  path.usable = false;
  path.steps.clear();
  const auto climb = [&tree](FrameId frame, std::vector<FrameId>& frames) {
    for (;;) {
      frames.push_back(frame);
      const History* history = tree.history(frame);
      if (!history) return true;
      if (history->empty() || !history->one_parent() || frames.size() > kMaxDepth) return false;
      frame = history->parent();
    }
  };
  std::vector<FrameId> up, down;
  if (!climb(source, up) || !climb(target, down) || up.back() != down.back()) return;
  while (up.size() > 1 && down.size() > 1 && up[up.size() - 2] == down[down.size() - 2]) {
    up.pop_back();
    down.pop_back();
  }
  for (std::size_t i = 0; i + 1 < up.size(); ++i) path.steps.push_back({tree.history(up[i]), false});
  for (std::size_t i = down.size() - 1; i > 0; --i) path.steps.push_back({tree.history(down[i - 1]), true});
  path.usable = true;
}

bool lookup(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
            Failure& failure) {
  if (target == source) {
    const History* history = tree.history(target);
    if (stamp == 0 && history) stamp = history->newest();
    pose = Pose{};
    return true;
  }
  if (const PathCache::Path* path = paths.find(tree, target, source)) {
    const Stamp when = stamp != 0 ? stamp : path_common_time(path->steps);
    if (path_pose(path->steps, when, pose)) {
      stamp = when;
      canonicalise(pose.q);
      return true;
    }
  }
  if (stamp == 0 && !latest_common_time(tree, target, source, stamp, failure)) return false;
  if (!walk_pose(tree, target, source, stamp, pose, failure)) return false;
  canonicalise(pose.q);
  return true;
}

bool latest_common_time(const Tree& tree, FrameId target, FrameId source, Stamp& stamp, Failure& failure) {
  stamp = 0;
  if (target == source) {
    if (const History* history = tree.history(source)) stamp = history->newest();
    return true;
  }
  struct Link {
    Stamp newest;
    FrameId parent;
  };
  std::vector<Link> links;  // from the source up
  Stamp common = kNoTime;
  const auto answer = [&] {
    stamp = common == kNoTime ? 0 : common;
    return true;
  };
  int depth = 0;
  for (FrameId frame = source;;) {
    const History* history = tree.history(frame);
    if (!history || history->empty()) break;
    keep_earlier(history->newest(), common);
    frame = history->parent();
    links.push_back({history->newest(), frame});
    if (frame == target) return answer();
    if (++depth > kMaxDepth) return fail_loop(tree, target, source, failure);
  }
  common = kNoTime;
  depth = 0;
  for (FrameId frame = target;;) {
    const History* history = tree.history(frame);
    if (!history || history->empty()) return fail_not_connected(tree, target, source, 0, failure);
    keep_earlier(history->newest(), common);
    frame = history->parent();
    const auto meeting = std::find_if(links.begin(), links.end(), [&](const Link& l) { return l.parent == frame; });
    if (meeting != links.end()) {
      for (auto link = links.begin(); link <= meeting; ++link) keep_earlier(link->newest, common);
      return answer();
    }
    if (frame == source) return answer();
    if (++depth > kMaxDepth) return fail_loop(tree, target, source, failure);
  }
}

bool chain(const Tree& tree, FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
           Failure& failure) {
  frames.clear();
  if (target == source) return true;
  if (stamp == 0 && !latest_common_time(tree, target, source, stamp, failure)) return false;
  std::vector<FrameId> down;
  Walk walk;
  walk.up = &frames;
  walk.down = &down;
  if (!walk_tree(tree, target, source, stamp, walk, failure)) return false;
  frames.insert(frames.end(), down.rbegin(), down.rend());
  return true;
}

}  // namespace coframe
