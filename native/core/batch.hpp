// SPDX-License-Identifier: Apache-2.0
// One query at many times: path and samples are found block by block, so that memory is fetched while numbers are
// worked on.
#pragma once

#include <cstddef>
#include <vector>

#include "core/paths.hpp"
#include "core/tree.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

// Some rows at work.
struct RowBlock {
  std::size_t count = 0;  // at most kRowBlock
  bool in_order = false;  // by their stamps, nearly
  bool with_twists = false;
  Stamp stamps[kRowBlock];
  bool ok[kRowBlock];
  PoseRows poses;
  TwistRows twists;
};

// The poses along a path, and how fast they change; not `ok` where the row has to be looked up alone: without a sample,
// with one of another parent, for the latest, or with twists where samples have the same stamp.
void follow_block(const PathCache::Path& path, RowBlock& rows);

// Puts rows that ask for about the same time beside each other, so that their samples are found in the first caches.
std::vector<std::uint32_t> order_by_time(const Stamp* stamps, std::size_t count);

// How fast a frame moves, in metres and radians per second along the axes of the frame that sees it.
struct Twist {
  double linear[3] = {0.0, 0.0, 0.0};
  double angular[3] = {0.0, 0.0, 0.0};
};

// The pose at one time and its rate of change by the interpolation between the samples there; at a sample, that of the
// interval after it, at the newest that of the one before. False as for follow_block.
bool follow_moving(const PathCache::Path& path, Stamp stamp, Pose& pose, Twist& twist);

// The time for which all links of the path have samples: from the latest beginning to the earliest end; 0, 0 where all
// are static. False where a link has none, or they have no common time.
bool common_span(const PathCache::Path& path, Stamp& first, Stamp& last);

}  // namespace coframe
