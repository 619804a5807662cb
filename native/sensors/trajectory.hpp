// SPDX-License-Identifier: Apache-2.0
// A copy of a buffer's samples between two frames over a span of time. All lookups on it see the same state of the tree
// and do not wait for other threads.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/buffer.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

class Trajectory {
 public:
  // An edge of the chain, from the source to the target. Without stamps it is constant: it has one pose and is not
  // inverse.
  struct Edge {
    std::vector<Stamp> stamps;
    std::vector<Pose> poses;
    double per_nanosecond = 0.0;  // samples per nanosecond, on average
    bool inverse = false;

    bool is_constant() const { return stamps.empty(); }
    // Returns i with stamps[i] <= stamp <= stamps[i + 1], chosen like a lookup does. `guess` is the likely result.
    std::size_t interval(Stamp stamp, std::size_t guess) const;
    // Returns the first stamp for which interval() returns this interval. The last one precedes the sample at its end.
    Stamp start(std::size_t interval) const;
    // Computes the positions of stamps in one interval, from 0 at its start to 1 at its end.
    void fractions(const Kernels& kernels, std::size_t interval, const Stamp* stamps, std::size_t n, double* out) const;
  };

  // The most recently used interval of each edge. Each thread has its own.
  using Hints = std::vector<std::size_t>;

  // Copies the samples between two different frames. Returns false if there is no chain, or if a frame in it has
  // changed its parent: then every time must be looked up.
  bool record(const Buffer& buffer, FrameId target, FrameId source, Stamp first, Stamp last);
  // Appends a constant edge: poses become relative to the frame in which the target has this pose.
  void append(const Pose& pose);

  // The span of time in which all edges have samples, so that at() is valid.
  Stamp earliest() const { return earliest_; }
  Stamp latest() const { return latest_; }
  const std::vector<Edge>& edges() const { return edges_; }
  bool along_screws() const { return along_screws_; }
  Hints hints() const { return Hints(edges_.size()); }
  Pose at(const Kernels& kernels, Stamp stamp, Hints& hints) const;

 private:
  bool copy(const PathCache::Path& path, Stamp first, Stamp last);
  void copy_edge(const PathCache::Step& step, const History::View& samples, Stamp first, Stamp last);
  void append_constant(Pose pose, bool inverse);

  std::vector<Edge> edges_;
  bool along_screws_ = false;
  Stamp earliest_ = std::numeric_limits<Stamp>::min(), latest_ = std::numeric_limits<Stamp>::max();
};

}  // namespace coframe
