// SPDX-License-Identifier: Apache-2.0
// The transform tree for many threads: one thread writes at a time, readers take no lock.
//
// The layers of a lookup, outermost first. Each layer answers by calling one of the layers below it.
//
//   layer                        frames given as              path through the tree  waits  reports why it failed
//   bindings/buffer_lookups.cpp
//     py_lookup                  str objects, ids cached      cached, then walked    no     yes
//     lookup_general             names, any valid arguments   cached first           yes    yes
//     lookup_waiting             names                        cached, then walked    yes    yes
//   Buffer (repeats a read that a writer has interrupted)
//     lookup_by_name             names                        cached, then walked    no     yes
//     lookup_by_id               ids                          cached, then walked    no     yes
//     lookup_by_walking          ids                          walked                 no     yes
//     lookup_cached_path         ids                          cached                 no     no
//     check_cached_path          ids                          cached, no pose        no     no
//   core/lookup.hpp (one consistent state of the tree)
//     lookup_in_tree             ids                          cached, then walked    no     yes
//     extrapolate_in_tree        ids                          walked                 no     yes
//     lookup_path_in_tree        ids                          cached                 no     no
//     check_path_in_tree         ids                          cached, no pose        no     no
//
// "ids" are the numbers of two existing frames. "Cached" is a path of a PathCache, which may belong to the caller; it
// answers only if every edge on it has had one parent so far. "Walked" follows the parents sample by sample, as tf2
// does. lookup_full_by_id and lookup_many are built on lookup_by_id and lookup_by_name.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/batch.hpp"
#include "core/cdr.hpp"
#include "core/follower.hpp"
#include "core/fork_guard.hpp"
#include "core/light_mutex.hpp"
#include "core/lookup.hpp"
#include "core/query.hpp"
#include "core/renaming.hpp"
#include "core/tree.hpp"
#include "core/wait_queue.hpp"

namespace coframe {

// The messages of one publisher. A publisher sends the same names in the same order, so the previous names are compared
// first. Used by one thread at a time.
struct TransformStream {
  enum class Encoding : std::uint8_t { cdr, ros1 };
  // The names of further transforms of a message are not stored: there may be many publishers, and each may send large
  // messages.
  static constexpr std::size_t kMaxRemembered = 1024;
  bool is_static = false;
  Encoding encoding = Encoding::cdr;
  AuthorityId authority = 0;
  std::shared_ptr<const Renaming> renaming;  // may be null: names are not changed
  NameProblems name_problems;
  Stamp newest = 0;                     // newest stamp of the last message; 0: none
  std::vector<ExpectedNames> expected;  // by the received names, with the ids of the resulting frames
  std::vector<TransformView> decoded;
  std::vector<Inserted> inserted;
};

struct FrameSummary {
  std::string name, parent, authority;
  bool is_static;
  std::size_t samples;
  Stamp oldest, newest;
  double rate;
};

// Statistics of the edge between a frame and its parent. Durations are in nanoseconds.
struct EdgeSummary {
  FrameSummary frame;
  double mean_interval, interval_deviation, longest_interval;  // between neighboring samples; 0 if there are none
  std::uint64_t stored, late, repeated, old, self, nan, quaternion;
};

// Implemented in several files: buffer_ingest.cpp (received messages), buffer_insertions.cpp, buffer_lookups.cpp,
// buffer_many_lookups.cpp, buffer_summaries.cpp (frames and edges), and buffer.cpp (clear, freeze, follow).
class Buffer {
 public:
  // What other nodes and recordings can add; the program itself may insert more. The largest known trees have thousands
  // of frames.
  static constexpr std::size_t kMaxFrames = 250'000, kMaxNameBytes = 64 << 20;

  explicit Buffer(Stamp cache_length) : tree_(cache_length) {}
  // Writes to shared data.
  explicit Buffer(SharedTreeData shared) : tree_(std::move(shared)), woken_(tree_.access()) { tree_.recover(); }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  Stamp cache_length() const { return tree_.cache_length(); }
  bool along_screws() const { return tree_.along_screws(); }
  void set_along_screws(bool along_screws) { tree_.set_along_screws(along_screws); }

  // Inserts a transform; returns 0, or why it was rejected (Refusal bits).
  unsigned insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                  bool is_static, AuthorityId authority);
  // For callers that know the ids of two different frames.
  unsigned insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                  AuthorityId authority);
  // Equivalent to one insert() per row in the order of the stamps. If the values of a row are invalid, nothing is
  // stored and `bad_row` is the first such row. Rows older than the cache are skipped.
  unsigned insert_many(const Track& track, bool is_static, AuthorityId authority, std::size_t& stored,
                       std::size_t& bad_row);
  AuthorityId authority(std::string_view name);
  TransformStream open_stream(bool is_static, std::string_view authority,
                              std::shared_ptr<const Renaming> renaming = nullptr);
  // The publisher has another name: changes it for the frames of its last message and for all further messages.
  void rename(TransformStream& stream, std::string_view authority);
  DecodeFailure ingest(TransformStream& stream, const std::uint8_t* data, std::size_t size, std::size_t& stored);
  // The same in two steps: store the transforms, then notify the waiters.
  DecodeFailure ingest_without_notify(TransformStream& stream, const std::uint8_t* data, std::size_t size,
                                      std::size_t& stored);
  void notify_ingested(TransformStream& stream);
  void clear();
  // Removes a frame with the edge to its parent and the edges of its children to it; returns false if there is no such
  // frame.
  bool remove_frame(std::string_view name);

  // Returns a frozen copy of the current state. The samples are shared, not copied.
  std::shared_ptr<Buffer> snapshot() const;
  // Opens the bytes of a frozen file in place. Returns nullptr if they are invalid; `reason` says why.
  static std::shared_ptr<Buffer> restored(Stamp cache_length, std::span<const std::uint8_t> table,
                                          std::span<const std::uint8_t> chunks, std::shared_ptr<GuardedMemory> memory,
                                          const char*& reason);
  // From now on, nothing is inserted or removed. Waits for an insertion that is in progress.
  void freeze() {
    const std::lock_guard lock(writing_);
    refusal_.store(kFrozen);
  }
  bool frozen() const { return refusal_.load() == kFrozen; }

  // Continues as a reader of shared data. Returns false if the buffer already contains a frame, or is frozen.
  bool follow(SharedTreeData shared);
  // Stops: continues with a copy of the shared data, to which it can insert. If they are lost, nothing changes.
  void stop_following();
  // Whether the buffer reads shared data, and refuses insertions.
  bool following() const { return refusal_.load() == kShared; }
  // Whether the buffer writes shared data.
  bool shares() const { return woken_ != nullptr; }
  // Whether shared data contain static transforms that are no longer published; their writer decides.
  bool outdated() const { return tree_.outdated(); }
  void set_outdated(bool outdated) {
    const std::lock_guard lock(writing_);
    tree_.set_outdated(outdated);
  }
  // The frames that have a static transform.
  std::vector<FrameId> static_frames() const;
  // Waits until the shared data have changed since `known_changes`, or `timeout_ns` has passed. May return earlier.
  void wait_for_change(std::uint64_t known_changes, std::int64_t timeout_ns) const {
    if (SharedAccess* access = tree_.access()) access->wait_for_change(known_changes, timeout_ns);
  }

  FrameId find(std::string_view name) const { return tree_.find(name); }
  // Returns whether an id that find() returned earlier still is a frame.
  bool knows(FrameId frame) const { return tree_.frame(frame).known; }
  std::string name(FrameId frame) const { return tree_.name(frame); }

  bool lookup_by_id(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const;
  // Both legs are read from one state of the tree. `target_stamp` is in and out.
  bool lookup_full_by_id(FrameId target, Stamp& target_stamp, FrameId source, Stamp source_stamp, FrameId fixed,
                         Pose& pose, Failure& failure) const;
  // Like lookup_by_id(), without the path cache: for callers that have tried lookup_cached_path() before.
  bool lookup_by_walking(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const;
  // Like lookup_by_id(), for two different frames, with the caller's own cache and without failure facts. False may
  // also mean that lookup_by_id() has to decide.
  bool lookup_cached_path(PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose) const;
  // Returns whether lookup_by_id() would succeed. False may also mean that it has to decide.
  bool check_cached_path(PathCache& paths, FrameId target, FrameId source, Stamp stamp) const {
    const std::uint64_t revision = tree_.start_reading();
    return check_path_in_tree(tree_, paths, target, source, stamp) && tree_.unchanged(revision);
  }
  // Looks up by name and stores the ids of the frames in the query. With `extrapolation`, also beyond the data as far
  // as it allows; `extrapolation->furthest` is set.
  bool lookup_by_name(LookupQuery& query, LookupResult& result, Failure& failure,
                      Extrapolation* extrapolation = nullptr) const;
  // Returns the first row without a transform, for which `failure` says why; batch.count if there is none.
  std::size_t lookup_many(const LookupQuery& query, const Extrapolation* extrapolation, const Batch& batch,
                          unsigned threads, Failure& failure) const;
  // The stamps of all samples between two times on the edges between two frames, sorted and unique.
  bool stamps_between(LookupQuery& query, Stamp first, Stamp last, std::vector<Stamp>& stamps, Failure& failure) const;
  // Returns whether lookup_by_name() would succeed. For time travel the target's leg is checked first, as in tf2's
  // canTransform.
  bool can_lookup(LookupQuery& query, Failure& failure) const;
  bool latest_common_time(LookupQuery& query, Stamp& stamp, Failure& failure) const;
  bool chain(FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames, Failure& failure) const;

  std::vector<FrameSummary> frames() const;
  std::vector<EdgeSummary> edges() const;
  // Statistics of the edge between a frame and its parent; nothing if no transform was published for it.
  std::optional<EdgeSummary> edge(FrameId child) const;
  std::vector<std::string> frame_names() const;
  // Returns the newest sample of every static or every dynamic frame as the CDR of a TFMessage.
  std::string encode(bool is_static) const;
  Counts counts() const { return tree_.counts().get(); }
  // Calls `read` with one consistent state of the tree. It may be called several times.
  template <class Read>
  auto read(Read&& read) const {
    return consistent([&] { return read(tree_); });
  }

  WaitQueue& wait_queue() { return wait_queue_; }
  // Throws LostMemory if another program has truncated the file with the data.
  void check_memory() const { tree_.check_memory(); }
  // The number of changes of the tree so far.
  std::uint64_t changes() const { return tree_.changes().load(); }

 private:
  explicit Buffer(const Tree& tree) : tree_(tree), refusal_(kFrozen) {}

  // Readers retry while writers change what they read. After this many attempts they lock the writers out.
  static constexpr int kAttempts = 200;
  template <class Read>
  auto consistent(Read&& read) const {
    for (int attempt = 0;; ++attempt) {
      const std::uint64_t revision = tree_.start_reading();
      auto result = read();
      if (tree_.unchanged(revision)) return result;
      if (attempt < kAttempts) continue;
      if (!tree_.read_only()) break;
      pause_reading(attempt);
    }
    const ForkSafeLock lock(writing_);
    return read();
  }

  bool lookup_by_id(PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const;
  template <class Lookup>
  bool retry_until_stable(bool for_latest, const Failure& failure, Lookup&& lookup) const;
  bool extrapolate_by_id(Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                         Failure& failure) const;
  std::size_t lookup_rows(LookupQuery query, const Extrapolation* extrapolation, const Batch& batch, std::size_t first,
                          std::size_t last, Failure& failure) const;
  void clip(const PathCache::Path& path, std::size_t count, Stamp* stamps) const;
  bool lookup_row(LookupQuery& query, const Extrapolation* extrapolation, const Batch& batch, std::size_t row,
                  Failure& failure) const;
  bool resolve_both(LookupQuery& query, Failure& failure) const;
  bool resolve(std::string_view name, Argument argument, FrameId& frame, Failure& failure) const;
  std::size_t insert_block(const Track& block, bool is_static, AuthorityId authority, std::vector<Inserted>& inserted);
  static void pause_reading(int attempt);
  template <class Insert>
  unsigned insert_and_announce(Insert&& insert);
  void store(TransformStream& stream, std::size_t index, const TransformView& view, Inserted& inserted);
  Inserted store_unexpected(TransformStream& stream, std::size_t index, const TransformView& view);
  Inserted store_named(TransformStream& stream, std::size_t index, const TransformView& view, std::string_view parent,
                       std::string_view child);
  bool count(unsigned refusals);
  unsigned refuse(unsigned refusal, std::uint64_t transforms);
  void announce(const Inserted* inserted, std::size_t count);
  void notify(const Inserted* inserted, std::size_t count);
  void notify_of_other_data();

  mutable LightMutex writing_;
  Tree tree_;
  mutable PathCache paths_;
  std::size_t received_name_bytes_ = 0;  // guarded by writing_
  std::atomic<unsigned> refusal_{0};     // kFrozen, kShared, or 0: accepts insertions
  SharedAccess* woken_ = nullptr;        // of a writer of shared data
  WaitQueue wait_queue_{tree_, [this](LookupQuery& query, LookupResult& result, Failure& failure) {
                          return this->lookup_by_name(query, result, failure);
                        }};
  std::optional<ChangeFollower> follower_;  // of a reader of shared data; last: its thread uses the members above
};

}  // namespace coframe
