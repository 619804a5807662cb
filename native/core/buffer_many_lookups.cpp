// SPDX-License-Identifier: Apache-2.0
// Lookups at many times, with threads.
#include "core/buffer.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <limits>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace coframe {

namespace {

// Smaller batches are not sorted.
constexpr std::size_t kWorthSorting = 4 * kRowBlock;

void write_pose(const Pose& pose, double* row) {
  std::copy_n(pose.p, 3, row);
  std::copy_n(pose.q, 4, row + 3);
}

}  // namespace

std::size_t Buffer::lookup_many(const LookupQuery& query, const Extrapolation* extrapolation, const Batch& batch,
                                unsigned threads, Failure& failure) const {
  threads = static_cast<unsigned>(std::clamp<std::size_t>(batch.count / kRowBlock, 1, std::max(threads, 1u)));
  std::vector<std::size_t> missing(threads);
  std::vector<Failure> failures(threads);
  std::vector<std::exception_ptr> thrown(threads);
  const auto part = [&](unsigned i) {
    try {
      missing[i] = lookup_rows(query, extrapolation, batch, batch.count * i / threads, batch.count * (i + 1) / threads,
                               failures[i]);
    } catch (...) {
      thrown[i] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  for (unsigned i = 1; i < threads; ++i) {
    try {
      others.emplace_back(part, i);
    } catch (const std::system_error&) {  // the system has no more threads
      part(i);
    }
  }
  part(0);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& exception : thrown) {
    if (exception) std::rethrow_exception(exception);
  }
  for (unsigned i = 0; i < threads; ++i) {
    if (missing[i] == batch.count) continue;
    failure = std::move(failures[i]);
    return missing[i];
  }
  return batch.count;
}

std::size_t Buffer::lookup_rows(LookupQuery query, const Extrapolation* extrapolation, const Batch& batch,
                                std::size_t first, std::size_t last, Failure& failure) const {
  std::size_t missing = batch.count;
  PathCache::Path path;
  Failure ignored;
  const bool has_path = query.target != query.source && resolve_both(query, ignored);
  const bool by_path = has_path && !extrapolation;
  const bool is_sorted = std::is_sorted(batch.stamps + first, batch.stamps + last);
  const std::size_t rows_count = last - first;
  const bool reorder =
      by_path && !is_sorted && rows_count >= kWorthSorting && rows_count <= std::numeric_limits<std::uint32_t>::max();
  const std::vector<std::uint32_t> order =
      reorder ? order_by_time(batch.stamps + first, rows_count) : std::vector<std::uint32_t>{};
  std::array<std::size_t, kRowBlock> at;
  RowBlock rows;
  rows.in_order = is_sorted || reorder;
  rows.with_twists = batch.twists != nullptr;
  rows.along_screws = tree_.along_screws();
  for (std::size_t start = first; start < last; start += kRowBlock) {
    rows.count = std::min(kRowBlock, last - start);
    for (std::size_t i = 0; i < rows.count; ++i) {
      at[i] = reorder ? first + order[start - first + i] : start + i;
      rows.stamps[i] = batch.stamps[at[i]];
    }
    if (has_path) PathCache::update(tree_, query.target_id, query.source_id, path);
    if (path.usable && batch.missing == Batch::Missing::clip) {
      clip(path, rows.count, rows.stamps);
      for (std::size_t i = 0; i < rows.count; ++i) batch.stamps[at[i]] = rows.stamps[i];
    }
    if (by_path && path.usable) {
      read([&](const Tree&) {
        follow_block(path, rows);
        return true;
      });
      kernels().write_poses(rows.poses, rows.count, at.data(), batch.poses);
      if (batch.twists) kernels().write_twists(rows.twists, rows.count, at.data(), batch.twists);
    } else {
      std::fill_n(rows.ok, rows.count, false);
    }
    for (std::size_t i = 0; i < rows.count; ++i) {
      if (rows.ok[i]) continue;
      Failure row_failure;
      if (lookup_row(query, extrapolation, batch, at[i], row_failure)) continue;
      if (at[i] < missing) {
        missing = at[i];
        failure = std::move(row_failure);
      }
      if (batch.missing != Batch::Missing::nan && !reorder) return missing;
    }
  }
  return missing;
}

void Buffer::clip(const PathCache::Path& path, std::size_t count, Stamp* stamps) const {
  Stamp earliest, latest;
  if (!read([&](const Tree&) { return common_span(path, earliest, latest); }) || latest == 0) return;
  for (std::size_t i = 0; i < count; ++i) {
    if (stamps[i] != 0) stamps[i] = std::clamp(stamps[i], earliest, latest);
  }
}

bool Buffer::lookup_row(LookupQuery& query, const Extrapolation* extrapolation, const Batch& batch, std::size_t row,
                        Failure& failure) const {
  LookupResult result;
  query.stamp = batch.stamps[row];
  Extrapolation guess = extrapolation ? *extrapolation : Extrapolation{};
  bool ok = lookup_by_name(query, result, failure, extrapolation ? &guess : nullptr);
  if (ok && batch.twists) {
    Twist twist;
    if (query.target != query.source) {
      ok = read([&](const Tree& tree) {
        PathCache::Path path;
        Pose pose;
        PathCache::walk_at(tree, query.target_id, query.source_id, result.stamp, path);
        return path.usable && follow_moving(path, result.stamp, tree.along_screws(), pose, twist);
      });
    }
    std::copy_n(twist.linear, 3, batch.twists + 6 * row);
    std::copy_n(twist.angular, 3, batch.twists + 6 * row + 3);
  }
  if (!ok) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    std::fill_n(batch.poses + 7 * row, 7, kNan);
    if (batch.twists) std::fill_n(batch.twists + 6 * row, 6, kNan);
    if (batch.extrapolated) batch.extrapolated[row] = 0;
    return false;
  }
  write_pose(result.pose, batch.poses + 7 * row);
  batch.stamps[row] = result.stamp;
  if (batch.extrapolated) batch.extrapolated[row] = guess.furthest;
  return true;
}

bool Buffer::stamps_between(LookupQuery& query, Stamp first, Stamp last, std::vector<Stamp>& stamps,
                            Failure& failure) const {
  if (!resolve_both(query, failure)) return false;
  PathCache::Path path;
  PathCache::update(tree_, query.target_id, query.source_id, path);
  LookupResult ignored;
  if (!path.usable && !lookup_by_name(query, ignored, failure)) return false;
  return read([&](const Tree&) {
    stamps.clear();
    for (const PathCache::Step& edge : path.steps) {
      const History::View history = edge.history->view();
      if (history.is_static()) continue;
      for (std::size_t i = history.first_after(first - 1); i < history.size() && history.time(i) <= last; ++i) {
        stamps.push_back(history.time(i));
      }
    }
    std::sort(stamps.begin(), stamps.end());
    stamps.erase(std::unique(stamps.begin(), stamps.end()), stamps.end());
    return true;
  });
}

}  // namespace coframe
