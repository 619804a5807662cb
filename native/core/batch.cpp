#include "core/batch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/pose_rows.hpp"

namespace coframe {

namespace {

void add_step(const PathCache::Step& link, const Pose& step, Pose& pose) {
  if (link.down) {
    compose_inverse(step, pose);
  } else {
    compose(step, pose);
  }
}

// One link of the path for all rows: where the samples lie, then the samples, each asked from memory in advance.
void follow_link(const PathCache::Step& link, const Stamp* stamps, std::size_t count, PoseRows& poses, bool* ok) {
  const History::View history = link.history->view();
  if (history.is_static() || history.size() < 2) {
    for (std::size_t row = 0; row < count; ++row) {
      Pose step;
      FrameId parent;
      ok[row] = ok[row] && history.at(stamps[row], step, parent) == Found::ok && parent == link.parent;
    }
    if (!history.empty()) compose_rows(history.sample(0).pose, link.down, count, poses);
    return;
  }
  std::array<std::uint64_t, kBlock> next;
  const History::Search search(history);
  for (std::size_t row = 0; row < count; ++row) {
    next[row] = search.guess(stamps[row]);
    history.prefetch_stamp(next[row]);
  }
  for (std::size_t row = 0; row < count; ++row) {
    ok[row] = ok[row] && search.covers(stamps[row]);
    next[row] = ok[row] ? search.next(stamps[row], next[row]) : search.any();
    history.prefetch_samples(next[row]);
  }
  PoseRows older, newer;
  std::array<double, kBlock> part, whole;
  for (std::size_t row = 0; row < count; ++row) {
    const History::Pair pair = history.pair(next[row], stamps[row]);
    ok[row] = ok[row] && pair.older->parent() == link.parent;
    older.load(row, *pair.older);
    newer.load(row, *pair.newer);
    part[row] = pair.part;
    whole[row] = pair.whole;
  }
  interpolate_rows(older, newer, part.data(), whole.data(), count, older);
  compose_rows(older, link.down, count, poses);
}

void cross(const double* a, const double* b, double* out) {
  out[0] = a[1] * b[2] - a[2] * b[1];
  out[1] = a[2] * b[0] - a[0] * b[2];
  out[2] = a[0] * b[1] - a[1] * b[0];
}

// The rate of change between two samples: straight for the translation, about one axis for the rotation, told in the
// parent's axes.
Twist rate_between(const Sample& a, const Sample& b, double seconds) {
  Twist rate;
  for (int i = 0; i < 3; ++i) rate.linear[i] = (b.pose.p[i] - a.pose.p[i]) / seconds;
  const double conjugate[4] = {-a.pose.q[0], -a.pose.q[1], -a.pose.q[2], a.pose.q[3]};
  double turn[4];
  multiply(b.pose.q, conjugate, turn);
  const double sign = turn[3] < 0.0 ? -1.0 : 1.0;
  const double sine = std::sqrt(turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2]);
  const double scale = sine > 0.0 ? sign * 2.0 * std::atan2(sine, sign * turn[3]) / (sine * seconds) : 0.0;
  for (int i = 0; i < 3; ++i) rate.angular[i] = scale * turn[i];
  return rate;
}

Twist rate_at(const History::View& history, Stamp stamp) {
  if (history.is_static() || history.size() < 2) return {};
  std::size_t next = history.first_after(stamp);
  next = std::clamp<std::size_t>(next, 1, history.size() - 1);
  while (next > 1 && history.time(next) == history.time(next - 1)) --next;
  const double seconds = static_cast<double>(history.time(next) - history.time(next - 1)) * 1e-9;
  const Sample a = history.sample(next - 1), b = history.sample(next);
  return seconds > 0.0 && a.parent == b.parent ? rate_between(a, b, seconds) : Twist{};
}

// From the step's child to its parent: the parent sees the step move as well.
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

// From the step's parent to its child, which does not see itself move.
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

void follow_block(const PathCache::Path& path, const Stamp* stamps, std::size_t count, PoseRows& poses, bool* ok) {
  poses.set_identity(count);
  for (std::size_t row = 0; row < count; ++row) ok[row] = stamps[row] != 0;
  for (const PathCache::Step& link : path.steps) follow_link(link, stamps, count, poses, ok);
  canonicalise_rows(count, poses);
}

// Counting sort into buckets of equal time: near enough, and much cheaper than sorting.
std::vector<std::uint32_t> order_by_time(const Stamp* stamps, std::size_t count) {
  constexpr std::size_t kFew = 4 * kBlock, kBuckets = 2048;
  if (count < kFew || count > std::numeric_limits<std::uint32_t>::max()) return {};
  if (std::is_sorted(stamps, stamps + count)) return {};
  const auto [first, last] = std::minmax_element(stamps, stamps + count);
  const Stamp start = *first;
  const double scale = static_cast<double>(kBuckets - 1) / static_cast<double>(distance(start, *last));
  const auto bucket_of = [&](Stamp stamp) {
    return static_cast<std::size_t>(static_cast<double>(distance(start, stamp)) * scale);
  };
  std::array<std::uint32_t, kBuckets + 1> begin{};
  for (std::size_t row = 0; row < count; ++row) ++begin[bucket_of(stamps[row]) + 1];
  for (std::size_t i = 1; i <= kBuckets; ++i) begin[i] += begin[i - 1];
  std::vector<std::uint32_t> order(count);
  for (std::size_t row = 0; row < count; ++row) order[begin[bucket_of(stamps[row])]++] = static_cast<std::uint32_t>(row);
  return order;
}

bool follow_moving(const PathCache::Path& path, Stamp stamp, Pose& pose, Twist& twist) {
  pose = Pose{};
  twist = Twist{};
  for (const PathCache::Step& link : path.steps) {
    const History::View history = link.history->view();
    Pose step;
    FrameId parent;
    if (history.at(stamp, step, parent) != Found::ok || parent != link.parent) return false;
    const Twist rate = rate_at(history, stamp);
    if (link.down) {
      subtract_rate(step, rate, pose, twist);
    } else {
      add_rate(step, rate, pose, twist);
    }
    add_step(link, step, pose);
  }
  canonicalise(pose.q);
  return true;
}

bool common_span(const PathCache::Path& path, Stamp& first, Stamp& last) {
  constexpr Stamp kFirst = std::numeric_limits<Stamp>::min(), kLast = std::numeric_limits<Stamp>::max();
  first = kFirst;
  last = kLast;
  for (const PathCache::Step& link : path.steps) {
    const History::View history = link.history->view();
    if (history.empty()) return false;
    if (history.is_static()) continue;
    first = std::max(first, history.oldest());
    last = std::min(last, history.newest());
  }
  if (first == kFirst && last == kLast) first = last = 0;
  return first <= last;
}

}  // namespace coframe
