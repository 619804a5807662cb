// SPDX-License-Identifier: Apache-2.0
#include "core/extrapolation.hpp"

#include <algorithm>

#include "core/screw.hpp"

namespace coframe {

namespace {

// Returns the nearest neighbor of the first or last sample that has another stamp and the same parent; that sample
// itself if there is none.
std::size_t neighbor(const History::View& samples, std::size_t end, bool forward) {
  const Stamp stamp = samples.time(end);
  for (std::size_t i = end; forward ? i > 0 : i + 1 < samples.size();) {
    i = forward ? i - 1 : i + 1;
    if (samples.parent_at(i) != samples.parent_at(end)) break;
    if (samples.time(i) != stamp) return i;
  }
  return end;
}

}  // namespace

Found Extrapolation::at(const History::View& samples, Stamp stamp, Pose& pose, FrameId& parent) {
  const Found found = samples.at(stamp, pose, parent, along_screws);
  if (found == Found::ok || found == Found::empty) return found;
  const bool forward = found == Found::too_new || (found == Found::only_other && stamp > samples.time(0));
  const std::size_t end = forward ? samples.size() - 1 : 0;
  const std::uint64_t overshoot = distance(stamp, samples.time(end));
  if (overshoot > static_cast<std::uint64_t>(limit)) return found;
  furthest = std::max(furthest, static_cast<Stamp>(overshoot));
  const Sample last = samples.sample(end);
  pose = last.pose;
  parent = last.parent;
  const std::size_t before = method == Method::twist ? neighbor(samples, end, forward) : end;
  if (before == end) return Found::ok;
  Pose motion = last.pose;  // the end sample relative to its neighbor
  compose_inverse(samples.sample(before).pose, motion);
  const double step = static_cast<double>(distance(samples.time(end), samples.time(before)));
  pose = part_of_motion(motion, static_cast<double>(overshoot) / step);
  compose(last.pose, pose);
  return Found::ok;
}

}  // namespace coframe
