// SPDX-License-Identifier: Apache-2.0
// The transform tree for many threads: one thread writes at a time, readers take no lock.
//
// The layers of a lookup, outermost first. Each layer answers by calling one of the layers below it.
//
//   layer                        frames given as              path through the tree  waits  reports why it failed
//   bindings/buffer.cpp
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

#include "core/batch.hpp"
#include "core/cdr.hpp"
#include "core/light_mutex.hpp"
#include "core/lookup.hpp"
#include "core/query.hpp"
#include "core/renaming.hpp"
#include "core/tree.hpp"
#include "core/wait_queue.hpp"

namespace coframe {

struct Counts {
  std::uint64_t messages = 0;   // TFMessages taken in as bytes
  std::uint64_t malformed = 0;  // of those, not decodable
  std::uint64_t stored = 0;     // transforms
  std::uint64_t refused = 0;    // transforms with bad names or values, or for a frozen buffer
  std::uint64_t old = 0;        // transforms older than the cache
};

// One source of messages: the same publisher sends the same names in the same order, so the last ones are tried
// first. Used by one thread at a time.
struct TransformStream {
  enum class Encoding : std::uint8_t { cdr, ros1 };
  // More of one message's transforms are not remembered: there may be many sources, and any of them may send much.
  static constexpr std::size_t kMaxRemembered = 1024;
  bool is_static = false;
  Encoding encoding = Encoding::cdr;
  AuthorityId authority = 0;
  std::shared_ptr<const Renaming> renaming;  // may be null: names are taken as they are
  NameProblems name_problems;
  Stamp newest = 0;                     // of the last message; 0: it had none
  std::vector<ExpectedNames> expected;  // by the names as they come, with the numbers of the frames that they became
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

// What is known of the link between a frame and its parent. Spans of time are nanoseconds.
struct EdgeSummary {
  FrameSummary frame;
  double mean_interval, interval_deviation, longest_interval;  // between neighbouring samples; 0 where there are none
  std::uint64_t stored, late, repeated, old, self, nan, quaternion;
};

class Buffer {
 public:
  explicit Buffer(Stamp cache_length) : tree_(cache_length) {}
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  Stamp cache_length() const { return tree_.cache_length(); }

  // 0, or why it was refused (Refusal bits).
  unsigned insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                  bool is_static, AuthorityId authority);
  // For who knows the numbers of two different frames.
  unsigned insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                  AuthorityId authority);
  // As one insert() after the other, in the order of the stamps. Where a row's values are refused nothing is stored,
  // and `bad_row` is the first of them; what is older than the cache is left out.
  unsigned insert_many(const Track& track, bool is_static, AuthorityId authority, std::size_t& stored,
                       std::size_t& bad_row);
  AuthorityId authority(std::string_view name);
  TransformStream open_stream(bool is_static, std::string_view authority,
                              std::shared_ptr<const Renaming> renaming = nullptr);
  // The source has another name: notes it for the frames that its last messages told of, and for all to come.
  void rename(TransformStream& stream, std::string_view authority);
  DecodeFailure ingest(TransformStream& stream, const std::uint8_t* data, std::size_t size, std::size_t& stored);
  // The same in two steps: first the transforms are there, then those who wait for them are woken.
  DecodeFailure ingest_without_notify(TransformStream& stream, const std::uint8_t* data, std::size_t size,
                                      std::size_t& stored);
  void notify_ingested(TransformStream& stream);
  void clear();
  // Forgets a frame with its link to its parent and those of its children to it; false if nobody knows it.
  bool remove_frame(std::string_view name);

  // What is in here now, as a frozen buffer of its own; the samples are shared, not copied.
  std::shared_ptr<Buffer> snapshot() const;
  // What was frozen into a file, used where it lies; nullptr, and `reason` says why, where the bytes are not that.
  static std::shared_ptr<Buffer> restored(Stamp cache_length, std::span<const std::uint8_t> table,
                                          std::span<const std::uint8_t> chunks, std::shared_ptr<const void> memory,
                                          const char*& reason);
  // From now on nothing is taken in, nor forgotten.
  void freeze() { frozen_.store(true); }
  bool frozen() const { return frozen_.load(); }

  FrameId find(std::string_view name) const { return tree_.find(name); }
  // Whether a number that find() once gave still stands for a frame.
  bool knows(FrameId frame) const { return tree_.frame(frame).known; }
  const std::string& name(FrameId frame) const { return tree_.name(frame); }

  bool lookup_by_id(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const;
  // The two legs are answered together: `stamp` is the target leg's, in and out.
  bool lookup_full_by_id(FrameId target, Stamp& target_stamp, FrameId source, Stamp source_stamp, FrameId fixed,
                         Pose& pose, Failure& failure) const;
  // The same for two frames that a lookup_cached_path() has not helped.
  bool lookup_by_walking(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const;
  // The same without a word of what is missing, for two different frames and with paths that only the caller uses;
  // false may also mean that lookup() has to decide.
  bool lookup_cached_path(PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose) const;
  // Whether lookup() would answer; false may also mean that it has to decide.
  bool check_cached_path(PathCache& paths, FrameId target, FrameId source, Stamp stamp) const {
    const std::uint64_t revision = tree_.revision().start_reading();
    return check_path_in_tree(tree_, paths, target, source, stamp) && tree_.revision().unchanged(revision);
  }
  // By name; notes the numbers of the frames in the query. With `extrapolation` also beyond the data, as far as it
  // allows; it learns how far that was.
  bool lookup_by_name(LookupQuery& query, LookupResult& result, Failure& failure,
                      Extrapolation* extrapolation = nullptr) const;
  // Returns the first row that has no answer, and `failure` says why; batch.count if there is none.
  std::size_t lookup_many(const LookupQuery& query, const Extrapolation* extrapolation, const Batch& batch,
                          unsigned threads, Failure& failure) const;
  // The stamps of all samples between two times on the links between two frames, in order, each once.
  bool stamps_between(LookupQuery& query, Stamp first, Stamp last, std::vector<Stamp>& stamps, Failure& failure) const;
  // Whether answer() would: where it travels in time, the target's leg is asked for first here, as in tf2.
  bool can_lookup(LookupQuery& query, Failure& failure) const;
  bool latest_common_time(LookupQuery& query, Stamp& stamp, Failure& failure) const;
  bool chain(FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames, Failure& failure) const;

  std::vector<FrameSummary> frames() const;
  std::vector<EdgeSummary> edges() const;
  // Of the link between a frame and its parent; nothing where nobody has told of it.
  std::optional<EdgeSummary> edge(FrameId child) const;
  std::vector<std::string> frame_names() const;
  // The newest sample of every static or every dynamic frame, as a TFMessage's CDR.
  std::string encode(bool is_static) const;
  Counts counts() const;
  // Runs `read` on the tree such that it sees one state of it; it may be run several times.
  template <class Read>
  auto read(Read&& read) const {
    return consistent([&] { return read(tree_); });
  }

  WaitQueue& wait_queue() { return wait_queue_; }
  // Counts what changed the tree.
  std::uint64_t changes() const { return changes_.load(); }

 private:
  explicit Buffer(const Tree& tree) : tree_(tree), frozen_(true) {}

  // Readers try again while writers change what they read. After so many times in vain they lock the writers out.
  static constexpr int kAttempts = 200;
  template <class Read>
  auto consistent(Read&& read) const {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      const std::uint64_t revision = tree_.revision().start_reading();
      auto result = read();
      if (tree_.revision().unchanged(revision)) return result;
    }
    const std::lock_guard lock(writing_);
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
  template <class Insert>
  unsigned insert_and_announce(Insert&& insert);
  void store(TransformStream& stream, std::size_t index, const TransformView& view, Inserted& inserted);
  Inserted store_unexpected(TransformStream& stream, std::size_t index, const TransformView& view);
  Inserted store_named(TransformStream& stream, std::size_t index, const TransformView& view, std::string_view parent,
                       std::string_view child);
  bool count(unsigned refusals);
  void count_change() { changes_.store(changes_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }
  void announce(const Inserted* inserted, std::size_t count);
  void notify(const Inserted* inserted, std::size_t count);

  mutable LightMutex writing_;
  Tree tree_;
  mutable PathCache paths_;
  Counts counts_;  // guarded by writing_
  std::atomic<bool> frozen_{false};
  WaitQueue wait_queue_{tree_, [this](LookupQuery& query, LookupResult& result, Failure& failure) {
                          return this->lookup_by_name(query, result, failure);
                        }};
  std::atomic<std::uint64_t> changes_{0};  // written under writing_
};

}  // namespace coframe
