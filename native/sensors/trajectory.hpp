// SPDX-License-Identifier: Apache-2.0
// A copy of a buffer's data for one frame relative to another over a span of time. Many lookups on it see one state of
// the tree, without waiting for other threads.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "core/buffer.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

class Trajectory {
 public:
  // Between the frames on the way, from the source on. Without stamps it stands still: one pose, not inverse.
  struct Link {
    std::vector<Stamp> stamps;
    std::vector<Pose> poses;
    double per_nanosecond = 0.0;  // samples, on average
    bool inverse = false;

    bool stands_still() const { return stamps.empty(); }
    // Returns i with stamps[i] <= stamp <= stamps[i + 1], chosen like a lookup does. `guess` is the likely result.
    std::size_t interval(Stamp stamp, std::size_t guess) const;
    // The first stamp for which interval() is this one; all up to the stamp at its end follow.
    Stamp start(std::size_t interval) const;
    // Where stamps of one interval lie between its ends.
    void shares(const Kernels& kernels, std::size_t interval, const Stamp* stamps, std::size_t n, double* out) const;
  };

  // The intervals of all links that were asked for last; each thread has its own.
  using Hints = std::vector<std::size_t>;

  // Records two different frames. Returns false if every time must be looked up: there is no path, or a frame on it has
  // changed its parent.
  bool record(const Buffer& buffer, FrameId target, FrameId source, Stamp first, Stamp last);
  // Makes the poses relative to another frame, in which the target has this pose.
  void continue_to(const Pose& pose);

  // When all links have data, and so at() an answer.
  Stamp earliest() const { return earliest_; }
  Stamp latest() const { return latest_; }
  const std::vector<Link>& links() const { return links_; }
  Hints hints() const { return Hints(links_.size()); }
  Pose at(const Kernels& kernels, Stamp stamp, Hints& hints) const;

 private:
  bool copy(const PathCache::Path& path, Stamp first, Stamp last);
  void copy_link(const PathCache::Step& step, const History::View& samples, Stamp first, Stamp last);
  void append_still(Pose pose, bool inverse);

  std::vector<Link> links_;
  Stamp earliest_ = std::numeric_limits<Stamp>::min(), latest_ = std::numeric_limits<Stamp>::max();
};

}  // namespace coframe
