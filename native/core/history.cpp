#include "core/history.hpp"

#include <algorithm>
#include <limits>

namespace coframe {

namespace {

// By value, as 0.0 and -0.0 are one number.
bool same(const Sample& a, const Sample& b) {
  return a.parent == b.parent && std::equal(a.pose.q, a.pose.q + 4, b.pose.q) &&
         std::equal(a.pose.p, a.pose.p + 3, b.pose.p);
}

// Saturating: stamps may come from anywhere.
Stamp minus(Stamp stamp, Stamp length) {
  return stamp < std::numeric_limits<Stamp>::min() + length ? std::numeric_limits<Stamp>::min() : stamp - length;
}

// How far `stamp` lies on the way from `start` to `end`, for start <= stamp <= end, start < end.
double share_of(Stamp stamp, Stamp start, Stamp end) {
  const auto part = static_cast<std::uint64_t>(stamp) - static_cast<std::uint64_t>(start);
  const auto whole = static_cast<std::uint64_t>(end) - static_cast<std::uint64_t>(start);
  return static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

bool History::insert(Stamp stamp, const Sample& sample) {
  if (is_static_) {
    fixed_ = sample;
    size_ = 1;
    return true;
  }
  if (!empty() && cache_length_ != kKeepAll) {
    const Stamp window_start = minus(newest(), cache_length_);
    drop_older_than(window_start);
    if (stamp < window_start) return false;
  }
  const std::size_t position = empty() || newest() <= stamp ? size_ : first_after(stamp);
  if (repeats(position, stamp, sample)) return true;
  if (!empty() && sample.parent != parent()) one_parent_ = false;
  append_slot();
  for (std::size_t i = size_ - 1; i > position; --i) {
    time_slot(i) = time_slot(i - 1);
    sample_slot(i) = sample_slot(i - 1);
  }
  time_slot(position) = stamp;
  sample_slot(position) = sample;
  return true;
}

void History::clear() {
  if (is_static_) return;
  chunks_.clear();
  head_ = size_ = 0;
  one_parent_ = true;
}

Found History::at(Stamp stamp, Pose& pose, FrameId& parent) const {
  if (empty()) return Found::empty;
  if (is_static_ || stamp == 0) return take(size_ - 1, pose, parent);
  const Stamp last = newest();
  if (stamp == last) return take(size_ - 1, pose, parent);
  if (size_ == 1) return Found::only_other;
  if (stamp > last) return Found::too_new;
  const Stamp first = oldest();
  if (stamp == first) return take(0, pose, parent);
  if (stamp < first) return Found::too_old;

  const std::size_t next = first_after(stamp);
  const Sample& older = sample(next - 1);
  const Sample& newer = sample(next);
  const Stamp start = time(next - 1);
  if (start == stamp || older.parent != newer.parent) return take(next - 1, pose, parent);
  parent = older.parent;
  interpolate(older.pose, newer.pose, share_of(stamp, start, time(next)), pose);
  return Found::ok;
}

void History::append_slot() {
  if (slot(size_) == chunks_.size() * kChunk) chunks_.push_back(std::make_unique<Chunk>());
  ++size_;
}

void History::drop_older_than(Stamp stamp) {
  while (!empty() && time(0) < stamp) {
    --size_;
    if (++head_ == kChunk) {
      chunks_.erase(chunks_.begin());
      head_ = 0;
    }
  }
}

// True when one of the samples at `stamp`, which end before index `end`, is exactly `sample`.
bool History::repeats(std::size_t end, Stamp stamp, const Sample& sample) const {
  for (std::size_t i = end; i > 0 && time(i - 1) == stamp; --i) {
    if (same(this->sample(i - 1), sample)) return true;
  }
  return false;
}

// Index of the first sample newer than `stamp`; the caller knows that there is one. Rates are nearly constant, so
// a straight line through both ends lands close, and doubling steps from there find the rest.
std::size_t History::first_after(Stamp stamp) const {
  const Stamp first = time(0);
  if (stamp < first) return 0;
  const double share = share_of(stamp, first, newest());
  std::size_t low = 0, high = size_ - 1;  // time(low) <= stamp < time(high)
  const std::size_t guess = std::min(static_cast<std::size_t>(share * static_cast<double>(high)), high);
  std::size_t step = 1;
  if (time(guess) <= stamp) {
    for (low = guess; low + step < high && time(low + step) <= stamp; step *= 2) low += step;
    high = std::min(low + step, high);
  } else {
    for (high = guess; high > step && time(high - step) > stamp; step *= 2) high -= step;
    low = high > step ? high - step : 0;
  }
  while (high - low > 1) {
    const std::size_t middle = low + (high - low) / 2;
    (time(middle) <= stamp ? low : high) = middle;
  }
  return high;
}

Found History::take(std::size_t i, Pose& pose, FrameId& parent) const {
  const Sample& found = sample(i);
  pose = found.pose;
  parent = found.parent;
  return Found::ok;
}

}  // namespace coframe
