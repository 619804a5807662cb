// SPDX-License-Identifier: Apache-2.0
#include "core/batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace coframe {

namespace {

void add_step(const PathCache::Step& edge, const Pose& step, Pose& pose) {
  if (edge.down) {
    compose_inverse(step, pose);
  } else {
    compose(step, pose);
  }
}

// Finds the samples around the rows' stamps in a history of at least two samples. With kBoth, a row gets two different
// samples and their distance even if one sample alone gives the pose.
template <bool kBoth>
class Finder {
 public:
  Finder(const History::View& history, Between& rows, bool* ok)
      : history_(history), search_(history), rows_(rows), ok_(ok) {}

  void find(const Stamp* stamps, std::size_t count, bool in_order) {
    constexpr std::uint64_t kFewSamplesPerRow = 4;
    const std::uint64_t first = search_.guess(stamps[0]), last = search_.guess(stamps[count - 1]);
    if (in_order && last - first <= kFewSamplesPerRow * count) {
      find_in_order(stamps, count, first);
    } else {
      find_anywhere(stamps, count);
    }
  }

 private:
  using Interval = History::Interval;

  // Rows usually lie in the interval of the previous row or after it.
  void find_in_order(const Stamp* stamps, std::size_t count, std::uint64_t first) {
    Interval found{};
    double per_nanosecond = 0.0;
    std::uint64_t next = first, inner = 0;  // number of stamps strictly inside the interval
    for (std::size_t row = 0; row < count; ++row) {
      const Stamp stamp = stamps[row];
      const std::uint64_t elapsed = static_cast<std::uint64_t>(stamp) - static_cast<std::uint64_t>(found.start);
      if (elapsed - 1 < inner) {
        put(found, static_cast<double>(static_cast<std::int64_t>(elapsed)) * per_nanosecond, per_nanosecond, row);
      } else if (search_.covers(stamp)) {
        next = search_.next(stamp, next);
        found = search_.interval(next);
        per_nanosecond = put_found(found, stamp, row);
        inner = inner_stamps(found);
      } else {
        put_nothing(row);
      }
    }
    if (next > first) history_.prefetch_from(next + 1, std::min<std::uint64_t>(next - first, count));  // the next block
  }

  // Prefetches stamps and samples.
  void find_anywhere(const Stamp* stamps, std::size_t count) {
    std::array<std::uint64_t, kRowBlock> next;
    for (std::size_t row = 0; row < count; ++row) {
      next[row] = search_.guess(stamps[row]);
      history_.prefetch_stamp(next[row]);
    }
    for (std::size_t row = 0; row < count; ++row) {
      next[row] = search_.covers(stamps[row]) ? search_.next(stamps[row], next[row]) : search_.any();
      history_.prefetch_samples(next[row]);
    }
    for (std::size_t row = 0; row < count; ++row) {
      if (search_.covers(stamps[row])) {
        put_found(search_.interval(next[row]), stamps[row], row);
      } else {
        put_nothing(row);
      }
    }
  }

  // 0 if the number does not fit.
  static std::uint64_t inner_stamps(const Interval& found) {
    const std::uint64_t length = distance(found.start, found.end);
    return length == 0 || length >> 63 ? 0 : length - 1;
  }

  void put(const Interval& found, double fraction, double per_nanosecond, std::size_t row) {
    rows_.older[row] = found.older->numbers();
    rows_.newer[row] = found.newer->numbers();
    rows_.fraction[row] = fraction;
    if constexpr (kBoth) rows_.per_second[row] = 1e9 * per_nanosecond;
  }

  // At the stamp of a sample only that sample is used: the other one may be infinite.
  double put_found(const Interval& found, Stamp stamp, std::size_t row) {
    const std::uint64_t length = distance(found.start, found.end), past = distance(found.start, stamp);
    const double per_nanosecond = length == 0 ? 0.0 : 1.0 / static_cast<double>(length);
    if (kBoth && length == 0) ok_[row] = false;  // the velocity must be computed by another function
    if (search_.is_newest(stamp)) {
      put(found, 1.0, per_nanosecond, row);
      if (!kBoth) rows_.older[row] = rows_.newer[row];
    } else {
      put(found, static_cast<double>(past) * per_nanosecond, per_nanosecond, row);
      if (!kBoth && past == 0) rows_.newer[row] = rows_.older[row];
    }
    return per_nanosecond;
  }

  void put_nothing(std::size_t row) {
    ok_[row] = false;
    put(search_.interval(search_.any()), 0.0, 0.0, row);
  }

  const History::View& history_;
  const History::Search search_;
  Between& rows_;
  bool* const ok_;
};

// Kernels process whole groups, so the last one is padded.
void pad(std::size_t count, Between& rows) {
  for (std::size_t row = count; row % kMaxLanes != 0; ++row) {
    rows.fraction[row] = rows.per_second[row] = 0.0;
    rows.older[row] = rows.older[count - 1];
    rows.newer[row] = rows.newer[count - 1];
  }
}

// Applies one edge of the path to all rows; `first` starts a new path.
void compose_edge(const PathCache::Step& edge, bool first, RowBlock& rows) {
  const Kernels& kernels = coframe::kernels();
  const History::View history = edge.history->view();
  // All visible samples have that parent: a writer clears the flag before it stores a sample with another one.
  const bool known = !history.empty() && edge.history->one_parent() && history.parent() == edge.parent;
  if (!known) std::fill_n(rows.ok, rows.count, false);
  if (history.is_static() || history.size() < 2) {
    for (std::size_t row = 0; row < rows.count; ++row) {
      Pose step;
      FrameId parent;
      rows.ok[row] = rows.ok[row] && history.at(rows.stamps[row], step, parent) == Found::ok;
    }
    const Pose step = history.empty() ? Pose{} : history.sample(0).pose;
    if (rows.with_twists) {
      kernels.compose_constant_with_twists(step, edge.down, first, rows.count, rows.poses, rows.twists);
    } else {
      kernels.compose_constant(step, edge.down, first, rows.count, rows.poses);
    }
    return;
  }
  Between between;
  if (rows.along_screws) {
    if (rows.with_twists) std::fill_n(rows.ok, rows.count, false);  // one by one
    Finder<false>(history, between, rows.ok).find(rows.stamps, rows.count, rows.in_order);
    pad(rows.count, between);
    kernels.compose_rows_along_screws(between, edge.down, first, rows.count, rows.poses);
  } else if (rows.with_twists) {
    Finder<true>(history, between, rows.ok).find(rows.stamps, rows.count, rows.in_order);
    pad(rows.count, between);
    kernels.compose_rows_with_twists(between, edge.down, first, rows.count, rows.poses, rows.twists);
  } else {
    Finder<false>(history, between, rows.ok).find(rows.stamps, rows.count, rows.in_order);
    pad(rows.count, between);
    kernels.compose_rows(between, edge.down, first, rows.count, rows.poses);
  }
}

void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

// The velocity between two samples: straight for the translation, about one axis for the rotation, expressed in the
// parent's axes.
Twist rate_between(const Sample& a, const Sample& b, double seconds) {
  Twist rate;
  for (int i = 0; i < 3; ++i) rate.linear[i] = (b.pose.p[i] - a.pose.p[i]) / seconds;
  const double conjugate[4] = {-a.pose.q[0], -a.pose.q[1], -a.pose.q[2], a.pose.q[3]};
  double rotation[4];
  multiply(b.pose.q, conjugate, rotation);
  const double sign = rotation[3] < 0.0 ? -1.0 : 1.0;
  const double sine = std::sqrt(rotation[0] * rotation[0] + rotation[1] * rotation[1] + rotation[2] * rotation[2]);
  const double scale = sine > 0.0 ? sign * 2.0 * std::atan2(sine, sign * rotation[3]) / (sine * seconds) : 0.0;
  for (int i = 0; i < 3; ++i) rate.angular[i] = scale * rotation[i];
  return rate;
}

// The same along a screw at a pose of it.
Twist screw_rate_between(const Sample& a, const Sample& b, double seconds, const Pose& pose) {
  Pose motion = b.pose;
  compose_inverse(a.pose, motion);
  double twist[6];
  kernels().logarithms({motion.p, motion.q, 0, 0}, 1, twist);
  for (double& number : twist) number /= seconds;
  Twist rate;
  rotate(pose.q, twist, rate.linear);
  rotate(pose.q, twist + 3, rate.angular);
  return rate;
}

// `pose` is the pose of the child at that time.
Twist rate_at(const History::View& history, Stamp stamp, bool along_screws, const Pose& pose) {
  if (history.is_static() || history.size() < 2) return {};
  std::size_t next = history.first_after(stamp);
  next = std::clamp<std::size_t>(next, 1, history.size() - 1);
  while (next > 1 && history.time(next) == history.time(next - 1)) --next;
  const double seconds = static_cast<double>(elapsed(history.time(next - 1), history.time(next))) * 1e-9;
  const Sample a = history.sample(next - 1), b = history.sample(next);
  if (!(seconds > 0.0) || a.parent != b.parent) return {};
  return along_screws ? screw_rate_between(a, b, seconds, pose) : rate_between(a, b, seconds);
}

// From the child to the parent of the step, which also observes the motion of the step.
void add_rate(const Pose& step, const Twist& rate, const Pose& pose, Twist& twist) {
  Twist result;
  double arm[3], swing[3];
  rotate(step.q, twist.linear, result.linear);
  rotate(step.q, twist.angular, result.angular);
  rotate(step.q, pose.p, arm);
  cross(rate.angular, arm, swing);
  for (int i = 0; i < 3; ++i) {
    result.linear[i] += rate.linear[i] + swing[i];
    result.angular[i] += rate.angular[i];
  }
  twist = result;
}

// From the parent to the child of the step, which does not observe its own motion.
void subtract_rate(const Pose& step, const Twist& rate, const Pose& pose, Twist& twist) {
  const double conjugate[4] = {-step.q[0], -step.q[1], -step.q[2], step.q[3]};
  double arm[3], swing[3], linear[3], angular[3];
  for (int i = 0; i < 3; ++i) arm[i] = pose.p[i] - step.p[i];
  cross(rate.angular, arm, swing);
  for (int i = 0; i < 3; ++i) {
    linear[i] = twist.linear[i] - rate.linear[i] - swing[i];
    angular[i] = twist.angular[i] - rate.angular[i];
  }
  rotate(conjugate, linear, twist.linear);
  rotate(conjugate, angular, twist.angular);
}

}  // namespace

void follow_block(const PathCache::Path& path, RowBlock& rows) {
  for (std::size_t row = 0; row < rows.count; ++row) rows.ok[row] = rows.stamps[row] != 0;
  bool first = true;
  for (const PathCache::Step& edge : path.steps) {
    compose_edge(edge, first, rows);
    first = false;
  }
}

// A radix sort in two passes, by the lower and the upper half of a stamp's position between the first and the last
// stamp. The order is approximate, which suffices, and much cheaper to compute than by comparisons.
std::vector<std::uint32_t> order_by_time(const Stamp* stamps, std::size_t count) {
  constexpr unsigned kBits = 11;
  constexpr std::uint32_t kBuckets = 1u << kBits;
  struct Place {
    std::uint32_t row, upper;
  };
  const auto [first, last] = std::minmax_element(stamps, stamps + count);
  const Stamp start = *first;
  const double scale = static_cast<double>(kBuckets * kBuckets - 1) / static_cast<double>(distance(start, *last));
  const auto places = std::make_unique_for_overwrite<std::uint32_t[]>(count);
  const auto half_sorted = std::make_unique_for_overwrite<Place[]>(count);
  std::array<std::uint32_t, kBuckets + 1> lower{}, upper{};
  for (std::size_t row = 0; row < count; ++row) {
    const auto place = static_cast<std::uint32_t>(
        static_cast<std::int64_t>(static_cast<double>(distance(start, stamps[row])) * scale));
    places[row] = place;
    ++lower[place % kBuckets + 1];
    ++upper[place / kBuckets + 1];
  }
  for (std::size_t i = 1; i <= kBuckets; ++i) {
    lower[i] += lower[i - 1];
    upper[i] += upper[i - 1];
  }
  for (std::uint32_t row = 0; row < count; ++row)
    half_sorted[lower[places[row] % kBuckets]++] = {row, places[row] / kBuckets};
  std::vector<std::uint32_t> order(count);
  for (std::size_t i = 0; i < count; ++i) order[upper[half_sorted[i].upper]++] = half_sorted[i].row;
  return order;
}

bool follow_moving(const PathCache::Path& path, Stamp stamp, bool along_screws, Pose& pose, Twist& twist) {
  pose = Pose{};
  twist = Twist{};
  for (const PathCache::Step& edge : path.steps) {
    const History::View history = edge.history->view();
    Pose step;
    FrameId parent;
    if (history.at(stamp, step, parent, along_screws) != Found::ok || parent != edge.parent) return false;
    const Twist rate = rate_at(history, stamp, along_screws, step);
    if (edge.down) {
      subtract_rate(step, rate, pose, twist);
    } else {
      add_rate(step, rate, pose, twist);
    }
    add_step(edge, step, pose);
  }
  canonicalise(pose.q);
  return true;
}

bool common_span(const PathCache::Path& path, Stamp& first, Stamp& last) {
  constexpr Stamp kFirst = std::numeric_limits<Stamp>::min(), kLast = std::numeric_limits<Stamp>::max();
  first = kFirst;
  last = kLast;
  for (const PathCache::Step& edge : path.steps) {
    const History::View history = edge.history->view();
    if (history.empty()) return false;
    if (history.is_static()) continue;
    first = std::max(first, history.oldest());
    last = std::min(last, history.newest());
  }
  if (first == kFirst && last == kLast) first = last = 0;
  return first <= last;
}

}  // namespace coframe
