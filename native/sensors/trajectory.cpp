// SPDX-License-Identifier: Apache-2.0
#include "sensors/trajectory.hpp"

#include <algorithm>

namespace coframe {

// At the oldest stamp the first sample of that stamp holds, else the last one, as in History::View. Rates are nearly
// constant, so that a straight line through both ends lands close.
std::size_t Trajectory::Link::interval(Stamp stamp, std::size_t guess) const {
  const std::size_t last = stamps.size() - 2;
  if (stamp >= stamps.back()) return last;
  if (stamp <= stamps.front()) return 0;
  const auto holds = [&](std::size_t i) { return i <= last && stamps[i] <= stamp && stamp < stamps[i + 1]; };
  if (holds(guess)) return guess;
  if (holds(guess + 1)) return guess + 1;
  const double part = static_cast<double>(distance(stamps.front(), stamp));
  guess = std::min(last, static_cast<std::size_t>(part * per_nanosecond));
  for (const std::size_t i : {guess, guess + 1, guess - 1}) {
    if (holds(i)) return i;
  }
  const auto next = std::upper_bound(stamps.begin() + 1, stamps.end() - 1, stamp);
  return static_cast<std::size_t>(next - stamps.begin()) - 1;
}

Stamp Trajectory::Link::start(std::size_t interval) const {
  const bool behind_oldest = interval > 0 && stamps[interval] == stamps.front();
  return stamps[interval] + (behind_oldest ? 1 : 0);
}

void Trajectory::Link::shares(const Kernels& kernels, std::size_t interval, const Stamp* times, std::size_t n,
                              double* out) const {
  if (stamps[interval] < stamps[interval + 1]) {
    kernels.shares(times, stamps[interval], stamps[interval + 1], n, out);
  } else {
    std::fill_n(out, n, interval + 2 == stamps.size() ? 1.0 : 0.0);  // several samples at the oldest or newest stamp
  }
}

bool Trajectory::record(const Buffer& buffer, FrameId target, FrameId source, Stamp first, Stamp last) {
  PathCache::Path path;
  return buffer.read([&](const Tree& tree) {
    PathCache::update(tree, target, source, path);
    return path.usable && copy(path, first, last);
  });
}

bool Trajectory::copy(const PathCache::Path& path, Stamp first, Stamp last) {
  *this = {};
  for (const PathCache::Step& step : path.steps) {
    const History::View samples = step.history->view();
    if (samples.empty()) return false;
    if (samples.is_static()) {
      append_still(samples.sample(0).pose, step.down);
      continue;
    }
    earliest_ = std::max(earliest_, samples.oldest());
    latest_ = std::min(latest_, samples.newest());
    copy_link(step, samples, first, last);
  }
  return true;
}

// One sample more at both ends than lie within.
void Trajectory::copy_link(const PathCache::Step& step, const History::View& samples, Stamp first, Stamp last) {
  const std::size_t size = samples.size();
  const std::size_t begin = first <= samples.oldest() ? 0 : std::max<std::size_t>(samples.first_after(first), 1) - 1;
  const std::size_t end = std::min(samples.first_after(last) + 1, size);
  if (end <= begin + 1) return append_still(samples.sample(begin).pose, step.down);
  Link& link = links_.emplace_back();
  link.inverse = step.down;
  link.stamps.reserve(end - begin);
  link.poses.reserve(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    link.stamps.push_back(samples.time(i));
    link.poses.push_back(samples.sample(i).pose);
  }
  const std::uint64_t length = distance(link.stamps.front(), link.stamps.back());
  link.per_nanosecond = length == 0 ? 0.0 : static_cast<double>(end - begin - 1) / static_cast<double>(length);
}

void Trajectory::continue_to(const Pose& pose) { append_still(pose, false); }

// Links that stand still one behind the other are one. And one that stands still goes into the samples of a moving one
// before it: what is between two samples turns and shifts with them.
void Trajectory::append_still(Pose pose, bool inverse) {
  if (inverse) {
    const Pose step = pose;
    pose = Pose{};
    compose_inverse(step, pose);
  }
  if (!links_.empty() && !links_.back().inverse) {
    for (Pose& sample : links_.back().poses) compose(pose, sample);
    return;
  }
  links_.emplace_back().poses.push_back(pose);
}

Pose Trajectory::at(const Kernels& kernels, Stamp stamp, Hints& hints) const {
  Pose pose;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    if (link.stands_still()) {
      compose(link.poses.front(), pose);
      continue;
    }
    const std::size_t k = hints[i] = link.interval(stamp, hints[i]);
    double share;
    link.shares(kernels, k, &stamp, 1, &share);
    Pose step;
    interpolate(link.poses[k], link.poses[k + 1], share, step);
    if (link.inverse) {
      compose_inverse(step, pose);
    } else {
      compose(step, pose);
    }
  }
  return pose;
}

}  // namespace coframe
