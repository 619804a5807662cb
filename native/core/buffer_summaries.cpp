// SPDX-License-Identifier: Apache-2.0
// What a buffer contains: its frames, the statistics of its edges, its newest samples as messages.
#include "core/buffer.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/dump.hpp"

namespace coframe {

namespace {

// Mean, standard deviation and longest of the intervals between neighboring samples.
void measure_intervals(const History::View& samples, EdgeSummary& edge) {
  edge.mean_interval = edge.interval_deviation = edge.longest_interval = 0.0;
  if (samples.is_static() || samples.size() < 2) return;
  const double count = static_cast<double>(samples.size() - 1);
  const auto interval = [&](std::size_t i) {
    return static_cast<double>(elapsed(samples.time(i - 1), samples.time(i)));
  };
  edge.mean_interval = static_cast<double>(elapsed(samples.oldest(), samples.newest())) / count;
  double squares = 0.0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double difference = interval(i) - edge.mean_interval;
    squares += difference * difference;
    edge.longest_interval = std::max(edge.longest_interval, interval(i));
  }
  edge.interval_deviation = std::sqrt(squares / count);
}

FrameSummary summary_of(const Tree& tree, FrameId id) {
  const Frame& frame = tree.frame(id);
  const History::View history = tree.history(id);
  if (history.empty()) return {std::string(frame.name.view()), "", "", false, 0, 0, 0, 0.0};
  return {std::string(frame.name.view()),
          tree.name(history.parent()),
          tree.authority_name(frame.authority),
          history.is_static(),
          history.size(),
          history.oldest(),
          history.newest(),
          history.is_static() ? 0.0 : average_rate(history)};
}

}  // namespace

std::vector<FrameSummary> Buffer::frames() const {
  return consistent([this] {
    std::vector<FrameSummary> summaries;
    for (FrameId id = 1; id < tree_.frame_count(); ++id) {
      if (tree_.frame(id).known) summaries.push_back(summary_of(tree_, id));
    }
    return summaries;
  });
}

std::vector<EdgeSummary> Buffer::edges() const {
  std::vector<EdgeSummary> summaries;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) {
    if (auto one = edge(id)) summaries.push_back(std::move(*one));
  }
  return summaries;
}

std::optional<EdgeSummary> Buffer::edge(FrameId child) const {
  EdgeSummary edge = consistent([&] {
    const Frame::Counts& counts = tree_.frame(child).counts;
    EdgeSummary one{summary_of(tree_, child), 0.0,        0.0,         0.0,        counts.stored,    counts.late,
                    counts.repeated,          counts.old, counts.self, counts.nan, counts.quaternion};
    measure_intervals(tree_.history(child), one);
    return one;
  });
  const bool has_statistics = edge.frame.samples + edge.stored + edge.old + edge.self + edge.nan > 0;
  if (!tree_.frame(child).known || !has_statistics) return std::nullopt;
  return edge;
}

std::vector<std::string> Buffer::frame_names() const {
  std::vector<std::string> names;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) {
    if (tree_.frame(id).known) names.push_back(tree_.name(id));
  }
  return names;
}

std::vector<FrameId> Buffer::static_frames() const {
  return consistent([this] {
    std::vector<FrameId> frames;
    for (FrameId id = 1; id < tree_.frame_count(); ++id) {
      if (tree_.history(id).is_static()) frames.push_back(id);
    }
    return frames;
  });
}

std::string Buffer::encode(bool is_static) const {
  return consistent([&] {
    std::vector<TransformView> views;
    for (FrameId id = 1; id < tree_.frame_count(); ++id) {
      const History::View history = tree_.history(id);
      if (history.empty() || history.is_static() != is_static) continue;
      const Sample sample = history.sample(history.size() - 1);
      const Pose& pose = sample.pose;
      views.push_back({tree_.frame(sample.parent).name,
                       tree_.frame(id).name,
                       history.newest(),
                       {{pose.p[0], pose.p[1], pose.p[2]}, {pose.q[0], pose.q[1], pose.q[2], pose.q[3]}}});
    }
    return encode_tf_message(views);
  });
}

}  // namespace coframe
