// SPDX-License-Identifier: Apache-2.0
// One lookup at many times. The path and the samples are found block by block, so that memory is prefetched while the
// previous numbers are processed.
#pragma once

#include <cstddef>
#include <vector>

#include "core/paths.hpp"
#include "core/tree.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

// The rows that are processed together.
struct RowBlock {
  std::size_t count = 0;  // at most kRowBlock
  bool in_order = false;  // almost sorted by stamp
  bool with_twists = false;
  bool along_screws = false;
  Stamp stamps[kRowBlock];
  bool ok[kRowBlock];
  PoseRows poses;
  TwistRows twists;
};

// Computes the poses along a path and, if wanted, their velocities. Clears `ok` for rows that must be looked up one by
// one: no sample, a sample with another parent, the latest time, or velocities where samples share a stamp.
void follow_block(const PathCache::Path& path, RowBlock& rows);

// Returns the rows in order of time, so that neighboring rows find their samples in the processor's cache.
std::vector<std::uint32_t> order_by_time(const Stamp* stamps, std::size_t count);

// The velocity of a frame in m/s and rad/s, expressed along the axes of the observing frame.
struct Twist {
  double linear[3] = {0.0, 0.0, 0.0};
  double angular[3] = {0.0, 0.0, 0.0};
};

// Computes the pose at one time and its rate of change by interpolation between the samples around it: at a sample the
// interval after it counts, at the newest sample the interval before it. Returns false for the same reasons as
// follow_block().
bool follow_moving(const PathCache::Path& path, Stamp stamp, bool along_screws, Pose& pose, Twist& twist);

// Computes the time span in which all edges of the path have samples; 0, 0 if all of them are static. Returns false if
// an edge has no samples, or if the edges have no common time.
bool common_span(const PathCache::Path& path, Stamp& first, Stamp& last);

}  // namespace coframe
