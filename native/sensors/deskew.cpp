// SPDX-License-Identifier: Apache-2.0
#include "sensors/deskew.hpp"

#include <limits>

#include "core/parts.hpp"
#include "sensors/trajectory.hpp"

namespace coframe {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Points of one time, or between the same two samples, are worth a call of their own if there are so many.
constexpr std::size_t kLongRun = 8;

// The span of all given times, with `latest` for 0.
Span span_of_times(const Stamp* times, std::size_t count, Stamp latest) {
  Span span{std::numeric_limits<Stamp>::max(), std::numeric_limits<Stamp>::min()};
  for (std::size_t i = 0; i < count; ++i) {
    if (times[i] == kNoTime) continue;
    const Stamp time = times[i] == 0 ? latest : times[i];
    span = {std::min(span.first, time), std::max(span.last, time)};
  }
  return span;
}

// What one thread does, block by block.
class Worker {
 public:
  // `plain`: the trajectory covers all times, and none of them needs a replacement.
  Worker(const Trajectory& trajectory, const Deskewing& how, Stamp latest, bool plain)
      : trajectory_(trajectory), how_(how), latest_(latest), plain_(plain), hints_(trajectory.hints()) {}

  void run(const Grid& grid, const std::vector<Coordinates>& coordinates, std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kPointBlock) {
      const std::size_t count = std::min(kPointBlock, end - first);
      times_ = how_.times + first;
      const bool all = plain_ || clamp_times(count);
      const bool few = split_by_time(count);
      for (const Coordinates& each : coordinates) {
        block_.load(kernels_, each, grid, first, count);
        if (!all) blank(count);
        if (few) {
          transform_runs(each.is_direction);
        } else {
          transform_each(each.is_direction, count);
        }
        block_.store(kernels_, each, grid, first, count);
      }
    }
  }

 private:
  struct Run {
    std::size_t begin, end;
    Pose pose;
  };

  // False if some lie where there is no transform: they are brought to where there is one, and marked.
  bool clamp_times(std::size_t count) {
    bool all = true;
    for (std::size_t i = 0; i < count; ++i) {
      const Stamp time = times_[i] == 0 ? latest_ : times_[i];
      clamped_[i] = std::max(trajectory_.earliest(), std::min(time, trajectory_.latest()));
      missing_[i] = clamped_[i] != time;
      all = all && !missing_[i];
    }
    times_ = clamped_;
    return all;
  }

  void blank(std::size_t count) {
    const Points points = block_.points();
    for (std::size_t i = 0; i < count; ++i) {
      if (missing_[i]) points.x[i] = points.y[i] = points.z[i] = kNan;
    }
  }

  // The poses of points that were measured together, if they are few enough for that.
  bool split_by_time(std::size_t count) {
    if ((kernels_.changes(times_, count) + 1) * kLongRun > count) return false;
    runs_.clear();
    for (std::size_t i = 0; i < count;) {
      std::size_t end = i + 1;
      while (end < count && times_[end] == times_[i]) ++end;
      if (!pose_known_ || times_[i] != pose_time_) {
        pose_ = trajectory_.at(kernels_, times_[i], hints_);
        pose_time_ = times_[i];
        pose_known_ = true;
      }
      runs_.push_back({i, end, pose_});
      i = end;
    }
    return true;
  }

  void transform_runs(bool is_direction) {
    for (const Run& run : runs_) {
      kernels_.transform(affine_of(run.pose, is_direction), run.end - run.begin, block_.points_from(run.begin));
    }
  }

  void transform_each(bool is_direction, std::size_t count) {
    for (std::size_t i = 0; i < hints_.size(); ++i) {
      const Trajectory::Link& link = trajectory_.links()[i];
      if (link.stands_still()) {
        kernels_.transform(affine_of(link.poses.front(), is_direction), count, block_.points());
      } else {
        follow(link, hints_[i], is_direction, count);
      }
    }
  }

  // Along one link: between samples that are far apart for the points, motion by motion; else pose by pose.
  void follow(const Trajectory::Link& link, std::size_t& hint, bool is_direction, std::size_t count) {
    struct Stretch {
      std::size_t begin, interval;
    };
    Stretch stretches[kPointBlock + 1];
    std::size_t n = 0;
    for (std::size_t i = 0; i < count; ++n) {
      hint = link.interval(times_[i], hint);
      const Stamp start = link.start(hint);
      const std::uint64_t length = distance(start, link.stamps[hint + 1]);
      const std::size_t begin = i;
      stretches[n] = {begin, hint};
      ++i;
      i += kernels_.leading(times_ + i, count - i, start, length);
      link.shares(kernels_, hint, times_ + begin, i - begin, shares_ + begin);
    }
    stretches[n].begin = count;
    const bool together = n * kLongRun <= count;
    for (std::size_t k = 0; k < n; ++k) {
      const auto [begin, interval] = stretches[k];
      const std::size_t end = stretches[k + 1].begin;
      Motion motion{link.poses[interval], link.poses[interval + 1], link.inverse};
      if (is_direction) {
        std::fill_n(motion.older.p, 3, 0.0);
        std::fill_n(motion.newer.p, 3, 0.0);
      }
      if (together) {
        kernels_.transform_moving(motion, shares_ + begin, end - begin, block_.points_from(begin));
      } else {
        std::fill(older_ + begin, older_ + end, motion.older);
        std::fill(newer_ + begin, newer_ + end, motion.newer);
      }
    }
    if (together) return;
    kernels_.interpolate_many(older_, newer_, shares_, count, poses_);
    kernels_.transform_each(poses_, link.inverse, count, block_.points());
  }

  const Kernels& kernels_ = kernels();
  const Trajectory& trajectory_;
  const Deskewing& how_;
  const Stamp latest_;
  const bool plain_;
  Trajectory::Hints hints_;
  Stamp pose_time_ = 0;
  Pose pose_;
  bool pose_known_ = false;
  std::vector<Run> runs_;
  PointBlock block_;
  const Stamp* times_ = nullptr;
  Stamp clamped_[kPointBlock];
  bool missing_[kPointBlock];
  double shares_[kPointBlock];
  Pose older_[kPointBlock], newer_[kPointBlock], poses_[kPointBlock];
};

Missing count_missing(const Trajectory& trajectory, const Deskewing& how, std::size_t count, Stamp latest) {
  Missing missing;
  for (std::size_t i = 0; i < count; ++i) {
    const Stamp time = how.times[i] == 0 ? latest : how.times[i];
    if (time >= trajectory.earliest() && time <= trajectory.latest()) continue;
    if (missing.count++ == 0) missing.first = i;
  }
  return missing;
}

bool goes_on(const Missing& missing, const Deskewing& how, std::size_t count) {
  return missing.count == 0 || (how.nan_for_none && missing.count < count);
}

// If frames have changed their parents there is no trajectory, and each point is looked up. Points without a transform
// get a translation of NaN.
Missing look_up(const Buffer& buffer, const Deskewing& how, std::vector<Pose>& poses) {
  Missing missing;
  Failure ignored;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Stamp time = how.times[i];
    if (buffer.lookup_by_id(how.target, how.source, time, poses[i], ignored)) {
      compose(how.onward, poses[i]);
    } else {
      std::fill_n(poses[i].p, 3, kNan);
      if (missing.count++ == 0) missing.first = i;
    }
  }
  return missing;
}

void transform_each(const std::vector<Pose>& poses, const Grid& grid, const Coordinates& coordinates) {
  const Kernels& kernels = coframe::kernels();
  PointBlock block;
  for (std::size_t first = 0; first < poses.size(); first += kPointBlock) {
    const std::size_t count = std::min(kPointBlock, poses.size() - first);
    block.load(kernels, coordinates, grid, first, count);
    kernels.transform_each(&poses[first], false, count, block.points());
    block.store(kernels, coordinates, grid, first, count);
  }
}

Missing deskew_by_lookups(const Buffer& buffer, const Deskewing& how, const Grid& grid,
                          const std::vector<Coordinates>& coordinates) {
  std::vector<Pose> poses(grid.count());
  const Missing missing = look_up(buffer, how, poses);
  if (!goes_on(missing, how, poses.size())) return missing;
  std::vector<Pose> turns = poses;
  for (Pose& turn : turns) {
    for (double& length : turn.p) length *= 0.0;  // NaN stays
  }
  for (const Coordinates& each : coordinates) transform_each(each.is_direction ? turns : poses, grid, each);
  return missing;
}

}  // namespace

Missing deskew(const Buffer& buffer, const Deskewing& how, const Grid& grid,
               const std::vector<Coordinates>& coordinates) {
  const std::size_t count = grid.count();
  if (count == 0) return {};
  if (how.target == 0 || how.source == 0 || how.target == how.source) return {count, 0};
  Span span = kernels().span(how.times, count);
  Stamp latest = 0;
  bool plain = span.first > 0;
  if (!plain) {
    Pose ignored_pose;
    Failure ignored;
    buffer.lookup_by_id(how.target, how.source, latest, ignored_pose, ignored);
    span = span_of_times(how.times, count, latest);
  }
  Trajectory trajectory;
  if (!trajectory.record(buffer, how.target, how.source, span.first, span.last)) {
    return deskew_by_lookups(buffer, how, grid, coordinates);
  }
  trajectory.continue_to(how.onward);
  plain = plain && span.first >= trajectory.earliest() && span.last <= trajectory.latest();
  const Missing missing = plain ? Missing{} : count_missing(trajectory, how, count, latest);
  if (!goes_on(missing, how, count)) return missing;
  in_parts(count, kPointBlock, how.threads, [&](std::size_t begin, std::size_t end) {
    Worker(trajectory, how, latest, plain).run(grid, coordinates, begin, end);
  });
  return missing;
}

}  // namespace coframe
