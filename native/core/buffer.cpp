// SPDX-License-Identifier: Apache-2.0
#include "core/buffer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "core/dump.hpp"
#include "core/frozen.hpp"
#include "core/ros1.hpp"

namespace coframe {

namespace {

bool fail_name(ErrorCode code, Argument argument, std::string_view name, Failure& failure) {
  failure = Failure{};
  failure.code = code;
  failure.argument = argument;
  failure.name = name;
  return false;
}

// Mean, standard deviation and longest of the intervals between neighbouring samples.
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

constexpr std::size_t kInsertBlock = 1024;
// Smaller batches are not sorted.
constexpr std::size_t kWorthSorting = 4 * kRowBlock;

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

void write_pose(const Pose& pose, double* row) {
  std::copy_n(pose.p, 3, row);
  std::copy_n(pose.q, 4, row + 3);
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

AuthorityId Buffer::authority(std::string_view name) {
  const std::lock_guard lock(writing_);
  if (following()) return 0;
  return tree_.authority(name);
}

TransformStream Buffer::open_stream(bool is_static, std::string_view authority,
                                    std::shared_ptr<const Renaming> renaming) {
  const std::lock_guard lock(writing_);
  TransformStream stream;
  stream.is_static = is_static;
  stream.renaming = std::move(renaming);
  stream.authority = following() ? 0 : tree_.authority(authority);
  return stream;
}

void Buffer::rename(TransformStream& stream, std::string_view authority) {
  const std::lock_guard lock(writing_);
  if (refusal_.load() != 0) return;
  const AuthorityId before = stream.authority;
  stream.authority = tree_.authority(authority);
  for (const ExpectedNames& names : stream.expected) tree_.change_authority(names.child, before, stream.authority);
}

DecodeFailure Buffer::ingest(TransformStream& stream, const std::uint8_t* data, std::size_t size, std::size_t& stored) {
  const DecodeFailure failure = ingest_without_notify(stream, data, size, stored);
  notify_ingested(stream);
  return failure;
}

DecodeFailure Buffer::ingest_without_notify(TransformStream& stream, const std::uint8_t* data, std::size_t size,
                                            std::size_t& stored) {
  stored = 0;
  const auto decode = stream.encoding == TransformStream::Encoding::cdr ? decode_tf_message : decode_ros1_tf_message;
  const DecodeFailure failure = decode(data, size, stream.decoded, stream.expected);
  const std::size_t transforms = stream.decoded.size();
  stream.inserted.resize(transforms);
  stream.newest = 0;
  for (const TransformView& view : stream.decoded) stream.newest = std::max(stream.newest, view.stamp);
  {
    const std::lock_guard lock(writing_);
    if (following()) {
      stream.inserted.assign(transforms, {.refusals = kShared});
      return failure;
    }
    TreeCounts& counts = tree_.counts();
    counts.messages.add(1);
    if (failure.reason) counts.malformed.add(1);
    for (std::size_t i = 0; i < transforms; ++i) {
      // Rejected old samples also change the tree: they create frames, and older samples may be pruned.
      store(stream, i, stream.decoded[i], stream.inserted[i]);
      if (count(stream.inserted[i].refusals)) ++stored;
    }
    if (transforms > 0) tree_.count_change();
  }
  return failure;
}

void Buffer::notify_ingested(TransformStream& stream) {
  notify(stream.inserted.data(), stream.inserted.size());
  if (stream.decoded.capacity() > TransformStream::kMaxRemembered) {
    stream.decoded = std::vector<TransformView>();  // unlike `= {}`, frees the memory
    stream.inserted = std::vector<Inserted>();
  }
}

void Buffer::store(TransformStream& stream, std::size_t index, const TransformView& view, Inserted& inserted) {
  if (const unsigned refusal = refusal_.load()) {
    inserted = {.refusals = refusal};
  } else if (view.as_expected) {
    const ExpectedNames& names = stream.expected[index];
    tree_.insert(names.parent, names.child, view.stamp, view.values, stream.is_static, stream.authority, inserted);
  } else {
    inserted = store_unexpected(stream, index, view);
  }
}

Inserted Buffer::store_unexpected(TransformStream& stream, std::size_t index, const TransformView& view) {
  if (!is_utf8(view.parent) || !is_utf8(view.child)) return {.refusals = kNoChildFrame};
  static const Renaming none;
  const Renaming& renaming = stream.renaming ? *stream.renaming : none;
  stream.name_problems.note(renaming, view.parent);
  stream.name_problems.note(renaming, view.child);
  if (!stream.renaming) return store_named(stream, index, view, view.parent, view.child);
  return store_named(stream, index, view, renaming(view.parent), renaming(view.child));
}

Inserted Buffer::store_named(TransformStream& stream, std::size_t index, const TransformView& view,
                             std::string_view parent, std::string_view child) {
  const std::size_t frames = tree_.frame_count();
  const bool is_full = frames >= kMaxFrames || received_name_bytes_ + parent.size() + child.size() > kMaxNameBytes ||
                       !tree_.has_room_for_names(parent.size() + child.size());
  if (is_full && (tree_.find(without_slash(parent)) == 0 || tree_.find(without_slash(child)) == 0)) {
    return {.refusals = kTooManyFrames};
  }
  const Inserted inserted = tree_.insert(parent, child, view.stamp, view.values, stream.is_static, stream.authority);
  if (tree_.frame_count() > frames) received_name_bytes_ += parent.size() + child.size();
  if (inserted.refusals == 0 && index < TransformStream::kMaxRemembered) {
    if (stream.expected.size() <= index) stream.expected.resize(index + 1);
    stream.expected[index] = {std::string(view.name_bytes), tree_.find(without_slash(parent)),
                              tree_.find(without_slash(child))};
  }
  return inserted;
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

void Buffer::clear() {
  {
    const std::lock_guard lock(writing_);
    if (refusal_.load() != 0) return;
    tree_.clear();
  }
  Inserted cleared;
  cleared.rewired = true;  // the next insertions may build another tree
  announce(&cleared, 1);
}

bool Buffer::remove_frame(std::string_view name) {
  Inserted removed;
  {
    const std::lock_guard lock(writing_);
    const FrameId frame = tree_.find(name);
    if (frame == 0 || refusal_.load() != 0) return false;
    tree_.remove(frame);
    removed.rewired = true;
  }
  announce(&removed, 1);
  return true;
}

std::shared_ptr<Buffer> Buffer::snapshot() const {
  const std::lock_guard lock(writing_);
  return std::shared_ptr<Buffer>(new Buffer(tree_));
}

bool Buffer::follow(SharedTreeData shared) {
  {
    const std::lock_guard lock(writing_);
    if (refusal_.load() != 0 || tree_.frame_count() > 1) return false;
    refusal_.store(kShared);
    tree_.become(std::move(shared));
    follower_.emplace(tree_, wait_queue_);
  }
  notify_of_other_data();
  return true;
}

void Buffer::stop_following() {
  {
    const std::lock_guard lock(writing_);
    if (!following()) return;
    follower_.reset();
    if (!tree_.become_private()) return;
    refusal_.store(0);
  }
  notify_of_other_data();
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

void Buffer::notify_of_other_data() {
  Inserted all;
  all.new_names = all.rewired = true;
  notify(&all, 1);
}

void Buffer::pause_reading(int attempt) {
  constexpr int kMost = 40'000;  // two seconds
  if (attempt > kMost) throw std::runtime_error("the shared buffer changes faster than this process can read it");
  std::this_thread::sleep_for(std::chrono::microseconds(50));
}

std::shared_ptr<Buffer> Buffer::restored(Stamp cache_length, std::span<const std::uint8_t> table,
                                         std::span<const std::uint8_t> chunks, std::shared_ptr<GuardedMemory> memory,
                                         const char*& reason) {
  auto buffer = std::make_shared<Buffer>(cache_length);
  reason = restore(buffer->tree_, table, chunks, std::move(memory));
  buffer->freeze();
  return reason ? nullptr : buffer;
}

// A sample at the latest common time may be pruned after that time was chosen and before the sample is read. A failure
// that repeats unchanged has another cause.
template <class Lookup>
bool Buffer::retry_until_stable(bool for_latest, const Failure& failure, Lookup&& lookup) const {
  std::pair<Stamp, Stamp> before{};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (consistent(lookup)) return true;
    const std::pair now(failure.requested, failure.earliest);
    const bool dropped = failure.code == ErrorCode::too_old || failure.code == ErrorCode::only_other;
    if (!for_latest || !dropped || now == before) break;
    before = now;
  }
  return false;
}

bool Buffer::lookup_by_id(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const {
  const PathLease paths(paths_);
  return lookup_by_id(paths.get(), target, source, stamp, pose, failure);
}

bool Buffer::lookup_by_walking(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const {
  return lookup_by_id(nullptr, target, source, stamp, pose, failure);
}

bool Buffer::lookup_by_id(PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                          Failure& failure) const {
  const Stamp asked = stamp;
  return retry_until_stable(asked == 0, failure, [&] {
    stamp = asked;
    return lookup_in_tree(tree_, paths, target, source, stamp, pose, failure);
  });
}

bool Buffer::lookup_cached_path(PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose) const {
  const std::uint64_t revision = tree_.start_reading();
  Stamp when = stamp;
  if (!lookup_path_in_tree(tree_, paths, target, source, when, pose) || !tree_.unchanged(revision)) return false;
  stamp = when;
  return true;
}

bool Buffer::lookup_full_by_id(FrameId target, Stamp& target_stamp, FrameId source, Stamp source_stamp, FrameId fixed,
                               Pose& pose, Failure& failure) const {
  const Stamp target_asked = target_stamp;
  const PathLease paths(paths_);
  return retry_until_stable(target_asked == 0 || source_stamp == 0, failure, [&] {
    Pose step;
    Stamp source_time = source_stamp;
    target_stamp = target_asked;
    if (!lookup_in_tree(tree_, paths.get(), fixed, source, source_time, pose, failure)) return false;
    if (!lookup_in_tree(tree_, paths.get(), target, fixed, target_stamp, step, failure)) return false;
    compose(step, pose);
    canonicalise(pose.q);
    return true;
  });
}

bool Buffer::extrapolate_by_id(Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                               Failure& failure) const {
  const Stamp asked = stamp;
  return consistent([&] {
    stamp = asked;
    return extrapolate_in_tree(tree_, extrapolation, target, source, stamp, pose, failure);
  });
}

// Finds the id of a frame, or fails with what is wrong with its name.
bool Buffer::resolve(std::string_view name, Argument argument, FrameId& frame, Failure& failure) const {
  if (name.empty()) return fail_name(ErrorCode::empty_name, argument, name, failure);
  if (name.front() == '/') return fail_name(ErrorCode::leading_slash, argument, name, failure);
  if (frame == 0 || !knows(frame)) frame = find(name);
  return frame != 0 || fail_name(ErrorCode::unknown_frame, argument, name, failure);
}

bool Buffer::resolve_both(LookupQuery& query, Failure& failure) const {
  return resolve(query.target, Argument::target_frame, query.target_id, failure) &&
         resolve(query.source, Argument::source_frame, query.source_id, failure);
}

bool Buffer::lookup_by_name(LookupQuery& query, LookupResult& result, Failure& failure,
                            Extrapolation* extrapolation) const {
  result.stamp = query.stamp;
  if (!query.time_travel && query.target == query.source) {  // also for a frame that does not exist
    result.pose = Pose{};
    const FrameId frame = find(query.target);
    return frame == 0 || lookup_by_id(frame, frame, result.stamp, result.pose, failure);
  }
  if (!resolve_both(query, failure)) return false;
  const FrameId target = query.target_id, source = query.source_id;
  if (extrapolation) return extrapolate_by_id(*extrapolation, target, source, result.stamp, result.pose, failure);
  if (!query.time_travel) return lookup_by_id(target, source, result.stamp, result.pose, failure);
  return resolve(query.fixed, Argument::fixed_frame, query.fixed_id, failure) &&
         lookup_full_by_id(target, result.stamp, source, query.source_stamp, query.fixed_id, result.pose, failure);
}

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
      Failure why;
      if (lookup_row(query, extrapolation, batch, at[i], why)) continue;
      if (at[i] < missing) {
        missing = at[i];
        failure = std::move(why);
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
  LookupResult one;
  query.stamp = batch.stamps[row];
  Extrapolation guess = extrapolation ? *extrapolation : Extrapolation{};
  bool ok = lookup_by_name(query, one, failure, extrapolation ? &guess : nullptr);
  if (ok && batch.twists) {
    Twist twist;
    if (query.target != query.source) {
      ok = read([&](const Tree& tree) {
        PathCache::Path path;
        Pose pose;
        PathCache::walk_at(tree, query.target_id, query.source_id, one.stamp, path);
        return path.usable && follow_moving(path, one.stamp, pose, twist);
      });
    }
    std::copy_n(twist.linear, 3, batch.twists + 6 * row);
    std::copy_n(twist.angular, 3, batch.twists + 6 * row + 3);
  }
  if (!ok) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    std::fill_n(batch.poses + 7 * row, 7, kNan);
    if (batch.twists) std::fill_n(batch.twists + 6 * row, 6, kNan);
    if (batch.beyond) batch.beyond[row] = 0;
    return false;
  }
  write_pose(one.pose, batch.poses + 7 * row);
  batch.stamps[row] = one.stamp;
  if (batch.beyond) batch.beyond[row] = guess.furthest;
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

bool Buffer::can_lookup(LookupQuery& query, Failure& failure) const {
  LookupResult ignored;
  if (!query.time_travel) return lookup_by_name(query, ignored, failure);
  if (!resolve_both(query, failure)) return false;
  if (!resolve(query.fixed, Argument::fixed_frame, query.fixed_id, failure)) return false;
  Stamp target_stamp = query.stamp, source_stamp = query.source_stamp;
  return lookup_by_id(query.target_id, query.fixed_id, target_stamp, ignored.pose, failure) &&
         lookup_by_id(query.fixed_id, query.source_id, source_stamp, ignored.pose, failure);
}

bool Buffer::latest_common_time(LookupQuery& query, Stamp& stamp, Failure& failure) const {
  return resolve_both(query, failure) && consistent([&] {
           return coframe::latest_common_time(tree_, query.target_id, query.source_id, stamp, failure);
         });
}

bool Buffer::chain(FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames, Failure& failure) const {
  return consistent([&] { return coframe::chain(tree_, target, source, stamp, frames, failure); });
}

std::vector<FrameSummary> Buffer::frames() const {
  return consistent([this] {
    std::vector<FrameSummary> all;
    for (FrameId id = 1; id < tree_.frame_count(); ++id) {
      if (tree_.frame(id).known) all.push_back(summary_of(tree_, id));
    }
    return all;
  });
}

std::vector<EdgeSummary> Buffer::edges() const {
  std::vector<EdgeSummary> all;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) {
    if (auto one = edge(id)) all.push_back(std::move(*one));
  }
  return all;
}

std::optional<EdgeSummary> Buffer::edge(FrameId child) const {
  EdgeSummary edge = consistent([&] {
    const Frame::Counts& counts = tree_.frame(child).counts;
    EdgeSummary one{summary_of(tree_, child), 0.0,        0.0,         0.0,        counts.stored,    counts.late,
                    counts.repeated,          counts.old, counts.self, counts.nan, counts.quaternion};
    measure_intervals(tree_.history(child), one);
    return one;
  });
  const bool has_something_to_tell = edge.frame.samples + edge.stored + edge.old + edge.self + edge.nan > 0;
  if (!tree_.frame(child).known || !has_something_to_tell) return std::nullopt;
  return edge;
}

std::vector<std::string> Buffer::frame_names() const {
  std::vector<std::string> names;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) {
    if (tree_.frame(id).known) names.push_back(tree_.name(id));
  }
  return names;
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
