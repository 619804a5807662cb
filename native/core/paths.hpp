// SPDX-License-Identifier: Apache-2.0
// Paths through the tree that were walked once.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "core/tree.hpp"

namespace coframe {

// Valid for one version of the tree. Used by one thread at a time; see PathLease.
class PathCache {
 public:
  struct Step {
    const History* history;
    FrameId parent;          // that all its samples had
    bool down;               // from parent to child: the pose is to be inverted
    std::uint64_t hint = 0;  // for History::place()
  };
  struct Path {
    std::uint64_t frames = 0;   // target and source
    std::uint64_t version = 0;  // 0: nothing here yet
    bool usable = false;        // false: not connected, too deep, or a frame on it changed its parent
    std::vector<Step> steps;
  };

  // The steps from `source` to `target` as of the newest data, or nullptr where the slow walk must decide.
  Path* find(const Tree& tree, FrameId target, FrameId source) {
    Path& path = place(target, source);
    if (path.version != tree.version() || path.frames != key_of(target, source)) update(tree, target, source, path);
    return path.usable ? &path : nullptr;
  }

  // Finds a path again if the tree has changed since, for who keeps one of his own.
  static void update(const Tree& tree, FrameId target, FrameId source, Path& path);
  // As of one time; for a look at that time only.
  static void walk_at(const Tree& tree, FrameId target, FrameId source, Stamp stamp, Path& path);

 private:
  friend class PathLease;
  void make_room();
  // A new path takes the place of another: a program may ask for every pair of a thousand frames.
  static constexpr std::size_t kEntries = 2048;

  struct Link {
    FrameId frame, parent;
  };
  static void walk(const Tree& tree, FrameId target, FrameId source, Path& path);
  static void join(const Tree& tree, std::vector<Link>& up, std::vector<Link>& down, Path& path);

  static std::uint64_t key_of(FrameId target, FrameId source) {
    return (static_cast<std::uint64_t>(target) << 32) | source;
  }
  Path& place(FrameId target, FrameId source) {
    if (paths_.empty()) make_room();
    return paths_[(key_of(target, source) * 0x9e3779b97f4a7c15u) >> 53];
  }

  std::vector<Path> paths_;
  std::atomic<bool> in_use_{false};
};

// The cache for this scope, or nothing where another thread has it: who does not wait walks.
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
