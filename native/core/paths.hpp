// SPDX-License-Identifier: Apache-2.0
// A cache of paths through the tree.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/tree.hpp"

namespace coframe {

// Entries are valid for one version of the tree. Used by one thread at a time; see PathLease.
class PathCache {
 public:
  struct Step {
    const History* history;
    FrameId parent;          // the parent in all samples of the edge
    bool down;               // from parent to child: the pose must be inverted
    std::uint64_t hint = 0;  // for History::locate()
  };
  struct Path {
    std::uint64_t frames = 0;   // target and source
    std::uint64_t version = 0;  // 0: empty
    bool usable = false;        // false: not connected, too deep, or a frame on it changed its parent
    std::vector<Step> steps;
  };

  // Returns the steps from `source` to `target` according to the newest data, or nullptr if the slow walk must decide.
  Path* find(const Tree& tree, FrameId target, FrameId source) {
    Path& path = slot(target, source);
    if (path.version != tree.version() || path.frames != key_of(target, source)) update(tree, target, source, path);
    return path.usable ? &path : nullptr;
  }

  // Recomputes a path that the caller keeps, if the tree has changed since.
  static void update(const Tree& tree, FrameId target, FrameId source, Path& path);
  // Computes the path at one time, valid for that time only.
  static void walk_at(const Tree& tree, FrameId target, FrameId source, Stamp stamp, Path& path);

 private:
  friend class PathLease;
  void make_room();
  // A new path replaces another one: a program may look up every pair of a thousand frames.
  static constexpr std::size_t kEntries = 2048;

  struct Edge {
    FrameId frame, parent;
  };
  static void walk(const Tree& tree, FrameId target, FrameId source, Path& path);
  static void join(const Tree& tree, std::vector<Edge>& up, std::vector<Edge>& down, Path& path);

  static std::uint64_t key_of(FrameId target, FrameId source) {
    return (static_cast<std::uint64_t>(target) << 32) | source;
  }
  Path& slot(FrameId target, FrameId source) {
    if (paths_.empty()) make_room();
    return paths_[(key_of(target, source) * 0x9e3779b97f4a7c15u) >> 53];
  }

  std::vector<Path> paths_;
  std::atomic<bool> in_use_{false};
};

// The cache for one scope, or nullptr if another thread is using it: such a lookup walks the tree instead of waiting.
class PathLease {
 public:
  explicit PathLease(PathCache& cache)
      : cache_(cache.in_use_.exchange(true, std::memory_order_acquire) ? nullptr : &cache) {}
  PathLease(const PathLease&) = delete;
  PathLease& operator=(const PathLease&) = delete;
  ~PathLease() {
    if (cache_) cache_->in_use_.store(false, std::memory_order_release);
  }
  PathCache* get() const { return cache_; }

 private:
  PathCache* cache_;
};

}  // namespace coframe
