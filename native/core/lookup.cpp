// SPDX-License-Identifier: Apache-2.0
#include "core/lookup.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace coframe {

namespace {

constexpr Stamp kNoTime = kLastStamp;

// `source_end` is 0 if the walk up from the source does not end.
bool fail_loop(FrameId target, FrameId source, Stamp stamp, FrameId source_end, Failure& failure) {
  failure.reset(ErrorCode::loop, target, source, stamp);
  failure.source_end = source_end;
  return false;
}

// The walks up from both frames ended at different frames.
bool fail_apart(FrameId target_end, FrameId source_end, Failure& failure) {
  failure.target_end = target_end;
  failure.source_end = source_end;
  return false;
}

ErrorCode code_of(Found found) {
  switch (found) {
    case Found::only_other: return ErrorCode::only_other;
    case Found::too_new: return ErrorCode::too_new;
    case Found::too_old: return ErrorCode::too_old;
    default: return ErrorCode::no_data;
  }
}

void fail_missing_sample(const History::View& history, Found found, FrameId edge, FrameId target, FrameId source,
                         Stamp stamp, Failure& failure) {
  failure.reset(code_of(found), target, source, stamp);
  failure.edge = edge;
  failure.earliest = history.oldest();
  failure.latest = history.newest();
}

// What a walk through the tree collects in both directions.
struct Walk {
  Pose source_pose;  // of the source frame, relative to the current frame of the walk
  Pose target_pose;
  std::vector<FrameId>* up = nullptr;    // optional: the frames from the source
  std::vector<FrameId>* down = nullptr;  // optional: the frames from the target
};

// Samples without extrapolation.
struct Exact {
  bool along_screws = false;
  Found at(const History::View& samples, Stamp stamp, Pose& pose, FrameId& parent) const {
    return samples.at(stamp, pose, parent, along_screws);
  }
};

// tf2's walkToTopParent: first from the source as far as there is data, then from the target to that frame. Which of
// several possible errors is reported depends on this order.
template <class Method>
bool walk_tree(const Tree& tree, Method& method, FrameId target, FrameId source, Stamp stamp, Walk& walk,
               Failure& failure) {
  Pose step;
  FrameId parent = 0;
  FrameId top = source;
  bool is_cut = false;  // the source's walk stopped at a missing sample, described by `failure`
  int depth = 0;
  for (FrameId frame = source;; frame = parent) {
    top = frame;
    if (walk.up) walk.up->push_back(frame);
    const History::View history = tree.history(frame);
    if (!history.exists()) break;
    const Found found = method.at(history, stamp, step, parent);
    if (found != Found::ok) {
      fail_missing_sample(history, found, frame, target, source, stamp, failure);
      is_cut = true;
      break;
    }
    if (frame == target) return true;
    compose(step, walk.source_pose);
    if (++depth > kMaxDepth) return fail_loop(target, source, stamp, 0, failure);
  }

  depth = 0;
  for (FrameId frame = target; frame != top; frame = parent) {
    if (walk.down) walk.down->push_back(frame);
    const History::View history = tree.history(frame);
    if (!history.exists()) {
      if (!is_cut) failure.reset(ErrorCode::not_connected, target, source, stamp);
      return fail_apart(frame, top, failure);
    }
    const Found found = method.at(history, stamp, step, parent);
    if (found != Found::ok) {
      fail_missing_sample(history, found, frame, target, source, stamp, failure);
      return fail_apart(frame, top, failure);
    }
    if (frame == source) {  // the source is an ancestor of the target: only this side counts
      walk.source_pose = Pose{};
      if (walk.up) walk.up->clear();
      return true;
    }
    compose(step, walk.target_pose);
    if (++depth > kMaxDepth) return fail_loop(target, source, stamp, top, failure);
  }
  return true;
}

template <class Method>
bool walk_pose(const Tree& tree, Method& method, FrameId target, FrameId source, Stamp stamp, Pose& pose,
               Failure& failure) {
  Walk walk;
  if (!walk_tree(tree, method, target, source, stamp, walk, failure)) return false;
  pose = walk.source_pose;
  compose_inverse(walk.target_pose, pose);
  return true;
}

// Computes the pose along a cached path from the target to the source. Returns false if an edge has no sample or a
// sample with another parent; the slow walk then finds out why.
bool path_pose(std::vector<PathCache::Step>& steps, Stamp stamp, Pose& pose) {
  constexpr std::size_t kEdges = 32;
  std::array<Edge, kEdges> edges;
  std::size_t remaining = steps.size();
  for (bool first = true; remaining > 0; first = false) {
    const std::size_t count = std::min(remaining, kEdges);
    for (std::size_t i = 0; i < count; ++i) {
      PathCache::Step& step = steps[--remaining];
      edges[i].down = step.down;
      if (!step.history->locate(stamp, step.parent, step.hint, edges[i])) return false;
    }
    Pose end;
    kernels().chain(edges.data(), count, &end);
    if (!first) compose(pose, end);
    pose = end;
  }
  return true;
}

// The same along screws.
bool path_pose_along_screws(const std::vector<PathCache::Step>& steps, Stamp stamp, Pose& pose) {
  pose = Pose{};
  for (const PathCache::Step& edge : steps) {
    Pose step;
    FrameId parent;
    if (edge.history->view().at(stamp, step, parent, true) != Found::ok || parent != edge.parent) return false;
    if (edge.down) {
      compose_inverse(step, pose);
    } else {
      compose(step, pose);
    }
  }
  return true;
}

// Static edges, and edges whose newest stamp is zero, do not limit the common time.
void keep_earlier(Stamp stamp, Stamp& common) {
  if (stamp != 0) common = std::min(common, stamp);
}

Stamp path_common_time(const std::vector<PathCache::Step>& steps) {
  Stamp common = kNoTime;
  for (const PathCache::Step& edge : steps) keep_earlier(edge.history->span().last, common);
  return common == kNoTime ? 0 : common;
}

// The transform of a frame to itself, at its newest stamp if none is requested.
bool identity(const Tree& tree, FrameId frame, Stamp& stamp, Pose& pose) {
  if (stamp == 0) stamp = tree.history(frame).newest();
  pose = Pose{};
  return true;
}

}  // namespace

bool lookup_path_in_tree(const Tree& tree, PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose) {
  PathCache::Path* path = paths.find(tree, target, source);
  if (!path) return false;
  const Stamp when = stamp != 0 ? stamp : path_common_time(path->steps);
  if (tree.along_screws() ? !path_pose_along_screws(path->steps, when, pose) : !path_pose(path->steps, when, pose)) {
    return false;
  }
  stamp = when;
  canonicalise(pose.q);
  return true;
}

bool lookup_in_tree(const Tree& tree, PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                    Failure& failure) {
  if (target == source) return identity(tree, target, stamp, pose);
  if (paths && lookup_path_in_tree(tree, *paths, target, source, stamp, pose)) return true;
  if (stamp == 0 && !latest_common_time(tree, target, source, stamp, failure)) return false;
  Exact exact{tree.along_screws()};
  if (!walk_pose(tree, exact, target, source, stamp, pose, failure)) return false;
  canonicalise(pose.q);
  return true;
}

bool extrapolate_in_tree(const Tree& tree, Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp,
                         Pose& pose, Failure& failure) {
  extrapolation.furthest = 0;
  extrapolation.along_screws = tree.along_screws();
  if (target == source) return identity(tree, target, stamp, pose);
  if (stamp == 0 && !latest_common_time(tree, target, source, stamp, failure)) return false;
  if (!walk_pose(tree, extrapolation, target, source, stamp, pose, failure)) return false;
  canonicalise(pose.q);
  return true;
}

bool latest_common_time(const Tree& tree, FrameId target, FrameId source, Stamp& stamp, Failure& failure) {
  stamp = 0;
  if (target == source) {
    stamp = tree.history(source).newest();
    return true;
  }
  struct Edge {
    Stamp newest;
    FrameId parent;
  };
  std::vector<Edge> edges;  // from the source up
  Stamp common = kNoTime;
  const auto finish = [&] {
    stamp = common == kNoTime ? 0 : common;
    return true;
  };
  int depth = 0;
  // A view may contain a sample more than a span, which cached paths use: both must have the same latest time.
  for (FrameId frame = source;;) {
    const History::Span span = tree.span(frame);
    if (span.first > span.last) break;
    keep_earlier(span.last, common);
    frame = span.parent;
    edges.push_back({span.last, frame});
    if (frame == target) return finish();
    if (++depth > kMaxDepth) return fail_loop(target, source, 0, 0, failure);
  }
  const FrameId source_root = edges.empty() ? source : edges.back().parent;
  common = kNoTime;
  depth = 0;
  for (FrameId frame = target;;) {
    const History::Span span = tree.span(frame);
    if (span.first > span.last) {
      failure.reset(ErrorCode::not_connected, target, source, 0);
      return fail_apart(frame, source_root, failure);
    }
    keep_earlier(span.last, common);
    frame = span.parent;
    const auto meeting =
        std::find_if(edges.begin(), edges.end(), [&](const Edge& edge) { return edge.parent == frame; });
    if (meeting != edges.end()) {
      for (auto edge = edges.begin(); edge <= meeting; ++edge) keep_earlier(edge->newest, common);
      return finish();
    }
    if (frame == source) return finish();
    if (++depth > kMaxDepth) return fail_loop(target, source, 0, source_root, failure);
  }
}

namespace {

// Both walks end with the same frames, and those above the last common one are removed. If only the source itself is
// left on its side, tf2 does not change that side.
void join_walks(std::vector<FrameId>& up_frames, std::vector<FrameId>& down_frames) {
  down_frames.push_back(up_frames.back());
  std::size_t m = down_frames.size(), n = up_frames.size();
  while (m > 0 && n > 0 && down_frames[m - 1] == up_frames[n - 1]) {
    --m;
    --n;
  }
  if (n > 1) up_frames.resize(n + 1);
  while (m > 0) up_frames.push_back(down_frames[--m]);
}

}  // namespace

bool chain(const Tree& tree, FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
           Failure& failure) {
  frames.clear();
  if (target == source) return true;
  if (stamp == 0 && !latest_common_time(tree, target, source, stamp, failure)) return false;
  std::vector<FrameId> down_frames;
  Walk walk;
  walk.up = &frames;
  walk.down = &down_frames;
  Exact exact;
  if (!walk_tree(tree, exact, target, source, stamp, walk, failure)) return false;
  if (frames.empty()) {
    frames.assign(down_frames.rbegin(), down_frames.rend());
  } else if (!down_frames.empty()) {
    join_walks(frames, down_frames);
  }
  return true;
}

}  // namespace coframe
