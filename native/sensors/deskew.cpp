// SPDX-License-Identifier: Apache-2.0
#include "sensors/deskew.hpp"

#include <limits>

#include "core/parts.hpp"
#include "sensors/trajectory.hpp"

namespace coframe {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// Points with the same time, or between the same two samples, get their own kernel call if there are at least this many
// on average.
constexpr std::size_t kLongRun = 8;

// Returns the span of all valid times, where `latest` replaces 0.
Span span_of_times(const Stamp* times, std::size_t count, Stamp latest) {
  Span span{std::numeric_limits<Stamp>::max(), std::numeric_limits<Stamp>::min()};
  for (std::size_t i = 0; i < count; ++i) {
    if (times[i] == kNoTime) continue;
    const Stamp time = times[i] == 0 ? latest : times[i];
    span = {std::min(span.first, time), std::max(span.last, time)};
  }
  return span;
}

// The work of one thread, block by block.
class Worker {
 public:
  // `all_covered`: the trajectory covers all times, and none of them is 0 or kNoTime.
  Worker(const Trajectory& trajectory, const DeskewRequest& request, Stamp latest, bool all_covered)
      : trajectory_(trajectory),
        request_(request),
        latest_(latest),
        all_covered_(all_covered),
        hints_(trajectory.hints()) {}

  void run(const Grid& grid, const std::vector<Coordinates>& coordinates, std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += kPointBlock) {
      const std::size_t count = std::min(kPointBlock, end - first);
      times_ = request_.times + first;
      const bool all_found = all_covered_ || clamp_times(count);
      const bool by_run = split_by_time(count);
      for (const Coordinates& each : coordinates) {
        block_.load(kernels_, each, grid, first, count);
        if (!all_found) set_missing_to_nan(count);
        if (by_run) {
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

  // Returns false if some times have no transform. These are marked as missing and clamped to the covered span.
  bool clamp_times(std::size_t count) {
    bool all_found = true;
    for (std::size_t i = 0; i < count; ++i) {
      const Stamp time = times_[i] == 0 ? latest_ : times_[i];
      clamped_[i] = std::max(trajectory_.earliest(), std::min(time, trajectory_.latest()));
      missing_[i] = clamped_[i] != time;
      all_found = all_found && !missing_[i];
    }
    times_ = clamped_;
    return all_found;
  }

  void set_missing_to_nan(std::size_t count) {
    const Points points = block_.points();
    for (std::size_t i = 0; i < count; ++i) {
      if (missing_[i]) points.x[i] = points.y[i] = points.z[i] = kNan;
    }
  }

  // Splits the block into runs of points with the same time and computes the pose of each run. Returns false if the
  // runs are too short on average.
  bool split_by_time(std::size_t count) {
    if ((kernels_.count_changes(times_, count) + 1) * kLongRun > count) return false;
    runs_.clear();
    for (std::size_t i = 0; i < count;) {
      std::size_t end = i + 1;
      while (end < count && times_[end] == times_[i]) ++end;
      if (!has_pose_ || times_[i] != pose_time_) {
        pose_ = trajectory_.at(kernels_, times_[i], hints_);
        pose_time_ = times_[i];
        has_pose_ = true;
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
      const Trajectory::Edge& edge = trajectory_.edges()[i];
      if (edge.is_constant()) {
        kernels_.transform(affine_of(edge.poses.front(), is_direction), count, block_.points());
      } else {
        transform_moving(edge, hints_[i], is_direction, count);
      }
    }
  }

  // Transforms the points along one edge: one motion per interval between samples if the intervals contain many points,
  // otherwise one pose per point.
  void transform_moving(const Trajectory::Edge& edge, std::size_t& hint, bool is_direction, std::size_t count) {
    struct Segment {
      std::size_t begin, interval;
    };
    Segment segments[kPointBlock + 1];
    std::size_t n = 0;
    for (std::size_t i = 0; i < count; ++n) {
      hint = edge.interval(times_[i], hint);
      const Stamp start = edge.start(hint);
      const std::uint64_t length = distance(start, edge.stamps[hint + 1]);
      const std::size_t begin = i;
      segments[n] = {begin, hint};
      ++i;
      i += kernels_.count_leading(times_ + i, count - i, start, length);
      edge.fractions(kernels_, hint, times_ + begin, i - begin, fractions_ + begin);
    }
    segments[n].begin = count;
    const bool in_segments = n * kLongRun <= count && !trajectory_.along_screws();
    for (std::size_t k = 0; k < n; ++k) {
      const auto [begin, interval] = segments[k];
      const std::size_t end = segments[k + 1].begin;
      Motion motion{edge.poses[interval], edge.poses[interval + 1], edge.inverse};
      if (is_direction) {
        std::fill_n(motion.older.p, 3, 0.0);
        std::fill_n(motion.newer.p, 3, 0.0);
      }
      if (in_segments) {
        kernels_.transform_moving(motion, fractions_ + begin, end - begin, block_.points_from(begin));
      } else {
        std::fill(older_ + begin, older_ + end, motion.older);
        std::fill(newer_ + begin, newer_ + end, motion.newer);
      }
    }
    if (in_segments) return;
    if (trajectory_.along_screws()) {
      interpolate_along_screws(count);
    } else {
      kernels_.interpolate_many(older_, newer_, fractions_, count, poses_);
    }
    kernels_.transform_each(poses_, edge.inverse, count, block_.points());
  }

  void interpolate_along_screws(std::size_t count) {
    constexpr std::ptrdiff_t kStep = sizeof(Pose) / sizeof(double);
    double rows[7 * kPointBlock];
    const PoseBatch older{older_->p, older_->q, kStep, kStep}, newer{newer_->p, newer_->q, kStep, kStep};
    kernels_.interpolate_batches(older, newer, {fractions_, 1}, true, count, rows);
    for (std::size_t i = 0; i < count; ++i) {
      std::copy_n(rows + 7 * i, 3, poses_[i].p);
      std::copy_n(rows + 7 * i + 3, 4, poses_[i].q);
    }
  }

  const Kernels& kernels_ = kernels();
  const Trajectory& trajectory_;
  const DeskewRequest& request_;
  const Stamp latest_;
  const bool all_covered_;
  Trajectory::Hints hints_;
  Stamp pose_time_ = 0;
  Pose pose_;
  bool has_pose_ = false;
  std::vector<Run> runs_;
  PointBlock block_;
  const Stamp* times_ = nullptr;
  Stamp clamped_[kPointBlock];
  bool missing_[kPointBlock];
  double fractions_[kPointBlock];
  Pose older_[kPointBlock], newer_[kPointBlock], poses_[kPointBlock];
};

Missing count_missing(const Trajectory& trajectory, const DeskewRequest& request, std::size_t count, Stamp latest) {
  Missing missing;
  for (std::size_t i = 0; i < count; ++i) {
    const Stamp time = request.times[i] == 0 ? latest : request.times[i];
    if (time >= trajectory.earliest() && time <= trajectory.latest()) continue;
    if (missing.count++ == 0) missing.first = i;
  }
  return missing;
}

bool may_write(const Missing& missing, const DeskewRequest& request, std::size_t count) {
  return missing.count == 0 || (request.nan_for_missing && missing.count < count);
}

// Looks up the pose of each point: if a frame has changed its parent, there is no trajectory. Points without a
// transform get a translation of NaN.
Missing look_up(const Buffer& buffer, const DeskewRequest& request, std::vector<Pose>& poses) {
  Missing missing;
  Failure ignored;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Stamp time = request.times[i];
    if (buffer.lookup_by_id(request.target, request.source, time, poses[i], ignored)) {
      compose(request.result_from_target, poses[i]);
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

Missing deskew_by_lookups(const Buffer& buffer, const DeskewRequest& request, const Grid& grid,
                          const std::vector<Coordinates>& coordinates) {
  std::vector<Pose> poses(grid.count());
  const Missing missing = look_up(buffer, request, poses);
  if (!may_write(missing, request, poses.size())) return missing;
  std::vector<Pose> rotations = poses;
  for (Pose& rotation : rotations) {
    for (double& length : rotation.p) length *= 0.0;  // NaN stays
  }
  for (const Coordinates& each : coordinates) transform_each(each.is_direction ? rotations : poses, grid, each);
  return missing;
}

}  // namespace

Missing deskew(const Buffer& buffer, const DeskewRequest& request, const Grid& grid,
               const std::vector<Coordinates>& coordinates) {
  const std::size_t count = grid.count();
  if (count == 0) return {};
  if (request.target == 0 || request.source == 0 || request.target == request.source) return {count, 0};
  Span span = kernels().span(request.times, count);
  Stamp latest = 0;
  bool all_covered = span.first > 0;
  if (!all_covered) {
    Pose ignored_pose;
    Failure ignored;
    buffer.lookup_by_id(request.target, request.source, latest, ignored_pose, ignored);
    span = span_of_times(request.times, count, latest);
  }
  Trajectory trajectory;
  if (!trajectory.record(buffer, request.target, request.source, span.first, span.last)) {
    return deskew_by_lookups(buffer, request, grid, coordinates);
  }
  trajectory.append(request.result_from_target);
  all_covered = all_covered && span.first >= trajectory.earliest() && span.last <= trajectory.latest();
  const Missing missing = all_covered ? Missing{} : count_missing(trajectory, request, count, latest);
  if (!may_write(missing, request, count)) return missing;
  in_parts(count, kPointBlock, request.threads, [&](std::size_t begin, std::size_t end) {
    Worker(trajectory, request, latest, all_covered).run(grid, coordinates, begin, end);
  });
  return missing;
}

}  // namespace coframe
