// SPDX-License-Identifier: Apache-2.0
#include "sensors/trajectory.hpp"

#include <algorithm>

#include "core/interpolation.hpp"
#include "core/screw.hpp"

namespace coframe {

// Of several samples with the oldest stamp the first one is used, of other equal stamps the last one, as in
// History::View. Rates are nearly constant, so linear interpolation between both ends is a good guess.
std::size_t Trajectory::Edge::interval(Stamp stamp, std::size_t guess) const {
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

Stamp Trajectory::Edge::start(std::size_t interval) const {
  const bool behind_oldest = interval > 0 && stamps[interval] == stamps.front();
  return stamps[interval] + (behind_oldest ? 1 : 0);
}

void Trajectory::Edge::fractions(const Kernels& kernels, std::size_t interval, const Stamp* times, std::size_t n,
                                 double* out) const {
  if (stamps[interval] < stamps[interval + 1]) {
    kernels.fractions(times, stamps[interval], stamps[interval + 1], n, out);
  } else {
    std::fill_n(out, n, interval + 2 == stamps.size() ? 1.0 : 0.0);  // several samples at the oldest or newest stamp
  }
}

bool Trajectory::record(const Buffer& buffer, FrameId target, FrameId source, Stamp first, Stamp last) {
  PathCache::Path path;
  return buffer.read([&](const Tree& tree) {
    PathCache::update(tree, target, source, path);
    if (!path.usable || !copy(path, first, last)) return false;
    along_screws_ = tree.along_screws();
    return true;
  });
}

bool Trajectory::copy(const PathCache::Path& path, Stamp first, Stamp last) {
  *this = {};
  for (const PathCache::Step& step : path.steps) {
    const History::View samples = step.history->view();
    if (samples.empty()) return false;
    if (samples.is_static()) {
      append_constant(samples.sample(0).pose, step.down);
      continue;
    }
    earliest_ = std::max(earliest_, samples.oldest());
    latest_ = std::min(latest_, samples.newest());
    copy_edge(step, samples, first, last);
  }
  return true;
}

// Copies the samples between `first` and `last`, and one more at each end.
void Trajectory::copy_edge(const PathCache::Step& step, const History::View& samples, Stamp first, Stamp last) {
  const std::size_t size = samples.size();
  const std::size_t begin = first <= samples.oldest() ? 0 : std::max<std::size_t>(samples.first_after(first), 1) - 1;
  const std::size_t end = std::min(samples.first_after(last) + 1, size);
  if (end <= begin + 1) return append_constant(samples.sample(begin).pose, step.down);
  Edge& edge = edges_.emplace_back();
  edge.inverse = step.down;
  edge.stamps.reserve(end - begin);
  edge.poses.reserve(end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    edge.stamps.push_back(samples.time(i));
    edge.poses.push_back(samples.sample(i).pose);
  }
  const std::uint64_t length = distance(edge.stamps.front(), edge.stamps.back());
  edge.per_nanosecond = length == 0 ? 0.0 : static_cast<double>(end - begin - 1) / static_cast<double>(length);
}

void Trajectory::append(const Pose& pose) { append_constant(pose, false); }

// Consecutive constant edges are combined. A constant edge is also multiplied into the samples of a moving edge before
// it, because interpolation commutes with a constant transform from the left.
void Trajectory::append_constant(Pose pose, bool inverse) {
  if (inverse) {
    const Pose step = pose;
    pose = Pose{};
    compose_inverse(step, pose);
  }
  if (!edges_.empty() && !edges_.back().inverse) {
    for (Pose& sample : edges_.back().poses) compose(pose, sample);
    return;
  }
  edges_.emplace_back().poses.push_back(pose);
}

Pose Trajectory::at(const Kernels& kernels, Stamp stamp, Hints& hints) const {
  Pose pose;
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Edge& edge = edges_[i];
    if (edge.is_constant()) {
      compose(edge.poses.front(), pose);
      continue;
    }
    const std::size_t k = hints[i] = edge.interval(stamp, hints[i]);
    double fraction;
    edge.fractions(kernels, k, &stamp, 1, &fraction);
    Pose step;
    if (along_screws_) {
      step = along_screw_motion(edge.poses[k], edge.poses[k + 1], fraction);
    } else {
      interpolate(edge.poses[k], edge.poses[k + 1], fraction, step);
    }
    if (edge.inverse) {
      compose_inverse(step, pose);
    } else {
      compose(step, pose);
    }
  }
  return pose;
}

}  // namespace coframe
