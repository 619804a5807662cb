// SPDX-License-Identifier: Apache-2.0
#include "core/paths.hpp"

namespace coframe {

void PathCache::update(const Tree& tree, FrameId target, FrameId source, Path& path) {
  const std::uint64_t version = tree.version();
  if (path.frames == key_of(target, source) && path.version == version) return;
  const std::uint64_t revision = tree.start_reading();
  walk(tree, target, source, path);
  path.frames = key_of(target, source);
  path.version = tree.unchanged(revision) ? version : 0;
}

void PathCache::make_room() { paths_.resize(kEntries); }

void PathCache::walk(const Tree& tree, FrameId target, FrameId source, Path& path) {
  const auto climb = [&tree](FrameId frame, std::vector<Edge>& edges) {
    for (;;) {
      const History::View history = tree.history(frame);
      edges.push_back({frame, history.parent()});
      if (!history.exists()) return true;
      if (history.empty() || !tree.frame(frame).history.one_parent() || edges.size() > kMaxDepth) return false;
      frame = history.parent();
    }
  };
  std::vector<Edge> up, down;
  path.usable = climb(source, up) && climb(target, down);
  if (path.usable) join(tree, up, down, path);
}

void PathCache::walk_at(const Tree& tree, FrameId target, FrameId source, Stamp stamp, Path& path) {
  const auto climb = [&](FrameId frame, std::vector<Edge>& edges) {
    Pose ignored;
    FrameId parent = 0;
    while (edges.size() <= kMaxDepth && tree.history(frame).at(stamp, ignored, parent) == Found::ok) {
      edges.push_back({frame, parent});
      frame = parent;
    }
    edges.push_back({frame, 0});
  };
  std::vector<Edge> up, down;
  climb(source, up);
  climb(target, down);
  join(tree, up, down, path);
}

// Joins the edges up from the source and down to the target, without those above their common ancestor.
void PathCache::join(const Tree& tree, std::vector<Edge>& up, std::vector<Edge>& down, Path& path) {
  path.steps.clear();
  path.usable = up.back().frame == down.back().frame;
  if (!path.usable) return;
  while (up.size() > 1 && down.size() > 1 && up[up.size() - 2].frame == down[down.size() - 2].frame) {
    up.pop_back();
    down.pop_back();
  }
  const auto add = [&](const Edge& edge, bool is_down) {
    path.steps.push_back({&tree.frame(edge.frame).history, edge.parent, is_down});
  };
  for (std::size_t i = 0; i + 1 < up.size(); ++i) add(up[i], false);
  for (std::size_t i = down.size() - 1; i > 0; --i) add(down[i - 1], true);
}

}  // namespace coframe
