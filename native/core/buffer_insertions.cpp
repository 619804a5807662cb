// SPDX-License-Identifier: Apache-2.0
// Insertions by the program itself; after each, the lookups that wait for it are woken.
#include "core/buffer.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace coframe {

namespace {

constexpr std::size_t kInsertBlock = 1024;

TransformValues values_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }

// Returns why the first invalid row is rejected; 0, with `row` past the last one, if all are valid.
unsigned track_refusals(const Track& track, unsigned refused_names, std::size_t& row) {
  for (row = 0; row < track.count; ++row) {
    if (refused_names == 0) row += kernels().count_valid_rows(track.poses + 7 * row, track.count - row);
    if (row == track.count) break;
    if (const unsigned refusals = refused_names | check_values(values_of(track.poses + 7 * row))) return refusals;
  }
  return 0;
}

std::vector<std::size_t> order_of(const Track& track) {
  std::vector<std::size_t> order(track.count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return track.stamps[a] < track.stamps[b]; });
  return order;
}

}  // namespace

template <class Insert>
unsigned Buffer::insert_and_announce(Insert&& insert) {
  Inserted inserted;
  {
    const std::lock_guard lock(writing_);
    if (const unsigned refusal = refusal_.load()) return refuse(refusal, 1);
    insert(inserted);
    count(inserted.refusals);
    tree_.count_change();
  }
  notify(&inserted, 1);
  return inserted.refusals;
}

unsigned Buffer::insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                        bool is_static, AuthorityId authority) {
  return insert_and_announce(
      [&](Inserted& inserted) { inserted = tree_.insert(parent, child, stamp, values, is_static, authority); });
}

unsigned Buffer::insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                        AuthorityId authority) {
  return insert_and_announce(
      [&](Inserted& inserted) { tree_.insert(parent, child, stamp, values, is_static, authority, inserted); });
}

unsigned Buffer::insert_many(const Track& track, bool is_static, AuthorityId authority, std::size_t& stored,
                             std::size_t& bad_row) {
  stored = 0;
  if (const unsigned refusals = track_refusals(track, check_names(track.parent, track.child), bad_row)) return refusals;
  const bool is_sorted = std::is_sorted(track.stamps, track.stamps + track.count);
  const std::vector<std::size_t> order = is_sorted ? std::vector<std::size_t>{} : order_of(track);
  std::vector<Stamp> stamps(is_sorted ? 0 : kInsertBlock);
  std::vector<double> poses(is_sorted ? 0 : 7 * kInsertBlock);
  // In blocks, so that other threads get the lock in between.
  for (std::size_t first = 0; first < track.count; first += kInsertBlock) {
    const std::size_t count = std::min(kInsertBlock, track.count - first);
    for (std::size_t i = 0; !is_sorted && i < count; ++i) {
      stamps[i] = track.stamps[order[first + i]];
      std::copy_n(track.poses + 7 * order[first + i], 7, &poses[7 * i]);
    }
    const Track block{track.parent, track.child, count, is_sorted ? track.stamps + first : stamps.data(),
                      is_sorted ? track.poses + 7 * first : poses.data()};
    std::vector<Inserted> inserted;
    const ForkSafeScope scope;
    {
      const std::lock_guard lock(writing_);
      if (const unsigned refusal = refusal_.load()) return refuse(refusal, track.count - first);
      stored += insert_block(block, is_static, authority, inserted);
    }
    announce(inserted.data(), inserted.size());
  }
  return 0;
}

// Runs of rows that are newer than the stored samples take the fast path.
std::size_t Buffer::insert_block(const Track& block, bool is_static, AuthorityId authority,
                                 std::vector<Inserted>& inserted) {
  std::size_t stored = 0;
  for (std::size_t i = 0; i < block.count;) {
    const std::size_t run = is_static ? 0
                                      : tree_.append_run(block.parent, block.child, block.stamps + i,
                                                         block.poses + 7 * i, block.count - i, authority);
    tree_.counts().stored.add(run);
    stored += run;
    i += run;
    if (run > 0) inserted.push_back({0, tree_.find(without_slash(block.child)), false, false});
    if (i == block.count) break;
    inserted.push_back(
        tree_.insert(block.parent, block.child, block.stamps[i], values_of(block.poses + 7 * i), is_static, authority));
    stored += count(inserted.back().refusals);
    ++i;
  }
  return stored;
}

// Returns true for a stored transform.
bool Buffer::count(unsigned refusals) {
  TreeCounts& counts = tree_.counts();
  (refusals == 0 ? counts.stored : refusals & kOldData ? counts.old : counts.refused).add(1);
  if (refusals & kTooManyFrames) counts.over_limit.add(1);
  return refusals == 0;
}

unsigned Buffer::refuse(unsigned refusal, std::uint64_t transforms) {
  if (refusal == kFrozen) tree_.counts().refused.add(transforms);
  return refusal;
}

void Buffer::announce(const Inserted* inserted, std::size_t count) {
  {
    const std::lock_guard lock(writing_);
    tree_.count_change();
  }
  notify(inserted, count);
}

// Unlocking was a full barrier between storing the data and checking for waiters; a waiter has one between registering
// and reading the data.
void Buffer::notify(const Inserted* inserted, std::size_t count) {
  if (woken_) woken_->wake();
  if (wait_queue_.empty()) return;
  for (std::size_t i = 0; i < count; ++i) wait_queue_.notify(inserted[i]);
}

}  // namespace coframe
