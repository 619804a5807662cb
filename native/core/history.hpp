// SPDX-License-Identifier: Apache-2.0
// The samples of one frame in time order (tf2's TimeCache and StaticCache), searched instead of walked. One thread
// writes, any number of threads read without a lock; what they read is consistent if the tree's revision did not change
// meanwhile.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/chunks.hpp"
#include "core/pose.hpp"
#include "core/relaxed_atomic.hpp"
#include "core/revision.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

inline constexpr Stamp kKeepAll = -1;  // an unlimited cache length
// Of a history with a limited cache length, because a publisher may send any number of stamps within that length; the
// oldest samples are dropped. 10 s at 100 kHz.
inline constexpr std::uint64_t kMaxSamples = 1 << 20;
inline constexpr Stamp kFirstStamp = std::numeric_limits<Stamp>::min(), kLastStamp = std::numeric_limits<Stamp>::max();

// The result of the search for a sample.
enum class Found { ok, empty, only_other, too_new, too_old };

// The result of an insertion.
enum class Insertion { appended, put_before_newer, repeated, refused_as_old };

// A frame without a history is the root of a tree: no transform was published for it.
enum class HistoryKind : std::uint8_t { none, dynamic, fixed };

struct Interrupted;

// Where the histories of a tree are stored.
struct HistoryStorage {
  Memory& memory;
  ChunkPool& pool;
  Chunk* nothing;            // fills entries without a chunk
  Interrupted* interrupted;  // of a shared tree, otherwise nullptr
};

// What all histories of a tree share.
struct HistoryContext {
  Stamp cache_length;
  const HistoryStorage& storage;
  Revision& revision;
};

// Prefetches memory that is needed soon.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

class History {
  // Chunk n since the start of the history is stored at index n modulo the size.
  struct Directory {
    static Directory* create(const HistoryStorage& storage, std::uint64_t size);
    static std::size_t bytes(std::uint64_t size) { return sizeof(Directory) + size * sizeof(RelativePointer<Chunk>); }

    std::uint64_t mask;
    // The entries follow.
    RelativePointer<Chunk>& chunk(std::uint64_t number) {
      return reinterpret_cast<RelativePointer<Chunk>*>(this + 1)[number & mask];
    }
    const RelativePointer<Chunk>& chunk(std::uint64_t number) const {
      return reinterpret_cast<const RelativePointer<Chunk>*>(this + 1)[number & mask];
    }
  };

 public:
  class Search;

  // Two samples and the fraction of the way between them: part / whole.
  struct Pair {
    const SharedSample *older, *newer;
    double part, whole;
  };

  // Two consecutive samples and their stamps.
  struct Interval {
    const SharedSample *older, *newer;
    Stamp start, end;
  };

  // What a reader sees: the samples at the time of its creation. Samples appended later are not visible.
  class View {
   public:
    bool exists() const { return kind_ != HistoryKind::none; }
    bool is_static() const { return kind_ == HistoryKind::fixed; }
    bool empty() const { return end_ <= begin_; }
    std::size_t size() const { return empty() ? 0 : static_cast<std::size_t>(end_ - begin_); }

    Stamp time(std::size_t i) const { return stamp_of(begin_ + i); }
    Sample sample(std::size_t i) const { return sample_of(begin_ + i).load(); }
    FrameId parent_at(std::size_t i) const { return sample_of(begin_ + i).parent(); }
    // Stamps of the oldest and newest sample; 0 for a static or empty history, as in tf2.
    Stamp oldest() const { return is_static() || empty() ? 0 : time(0); }
    Stamp newest() const { return is_static() || empty() ? 0 : time(size() - 1); }
    // The parent in the newest sample; 0 if there is none.
    FrameId parent() const { return empty() ? 0 : parent_at(size() - 1); }

    // Computes the pose at `stamp` and its parent frame, without extrapolation. Between samples the pose is
    // interpolated like in tf2, or along a screw.
    Found at(Stamp stamp, Pose& pose, FrameId& parent, bool along_screw = false) const;
    // Finds the samples that at() interpolates between; `next` is the number of the newer one.
    Found find(Stamp stamp, Pair& pair, std::uint64_t& next) const;
    // Returns whether `stamp` lies strictly between the sample `next` and the one before, both in one chunk: the case
    // of most lookups. False also if `next` is not the number of a sample.
    bool bracket_in_chunk(Stamp stamp, std::uint64_t next, Pair& pair) const {
      const std::size_t i = next % Chunk::kSize;
      if (i == 0 || next <= begin_ || next >= end_) return false;
      const Chunk& chunk = chunk_of(next);
      const Stamp start = chunk.stamps[i - 1], end = chunk.stamps[i];
      const auto duration = static_cast<std::int64_t>(distance(start, end));
      if (start >= stamp || stamp >= end || duration < 0) return false;
      pair = {&chunk.samples[i - 1], &chunk.samples[i], static_cast<double>(stamp - start),
              static_cast<double>(duration)};
      return true;
    }
    // Copies the stamps and samples of one chunk from that index on, without those beyond the last one. Not for a
    // static history.
    void copy(std::size_t first, char* stamps, char* samples) const;
    // Returns the index of the first sample newer than `stamp`; size() if there is none.
    std::size_t first_after(Stamp stamp) const;

    // For batch lookups. Samples are numbered since the start of the history, as in Search.
    void prefetch_stamp(std::uint64_t number) const { prefetch(&chunk_of(number).stamps[number % Chunk::kSize]); }
    void prefetch_samples(std::uint64_t next) const {
      prefetch(&chunk_of(next - 1).samples[(next - 1) % Chunk::kSize]);
      prefetch(&chunk_of(next).samples[next % Chunk::kSize]);
    }
    // Prefetches `count` samples.
    void prefetch_from(std::uint64_t number, std::uint64_t count) const {
      for (const std::uint64_t end = std::min(number + count, end_); number < end; ++number) {
        prefetch(&chunk_of(number).samples[number % Chunk::kSize]);
      }
    }
    // Finds the two samples that the pose at `stamp` lies between, or the same sample twice. `stamp` lies between the
    // sample `next` and the one before. At the stamp of a sample there is no interpolation: the newest sample counts,
    // or else the last one with that stamp, and at the oldest stamp the first one. A change of the parent is not
    // interpolated: the older sample counts (tf2's findClosest).
    Pair pair(std::uint64_t next, Stamp stamp) const {
      const std::size_t i = next % Chunk::kSize;
      const Chunk& chunk = chunk_of(next);
      const Chunk& before = i != 0 ? chunk : chunk_of(next - 1);
      const std::size_t j = (next - 1) % Chunk::kSize;
      const SharedSample *older = &before.samples[j], *newer = &chunk.samples[i];
      const Stamp start = before.stamps[j], end = chunk.stamps[i];
      if (stamp == end && next == end_ - 1) return {newer, newer, 0.0, 1.0};
      if (stamp == start || newer->parent() != older->parent()) return {older, older, 0.0, 1.0};
      return {older, newer, static_cast<double>(distance(start, stamp)), static_cast<double>(distance(start, end))};
    }

   private:
    friend class History;
    friend class Search;
    // By number since the start of the history.
    const Chunk& chunk_of(std::uint64_t number) const { return *directory_->chunk(number / Chunk::kSize).known(); }
    Stamp stamp_of(std::uint64_t number) const { return chunk_of(number).stamps[number % Chunk::kSize]; }
    const SharedSample& sample_of(std::uint64_t number) const {
      return is_static() ? *fixed_ : chunk_of(number).samples[number % Chunk::kSize];
    }
    const Directory* directory_;
    const SharedSample* fixed_;
    std::uint64_t begin_, end_;
    HistoryKind kind_;
  };

  // Finds stamps in a dynamic history of at least two samples.
  class Search {
   public:
    explicit Search(const View& samples);

    bool covers(Stamp stamp) const { return stamp >= first_ && stamp <= last_; }
    // Guesses a sample for any stamp by linear interpolation between both ends: rates are nearly constant.
    std::uint64_t guess(Stamp stamp) const {
      if (stamp <= first_) return low_;
      // Numbers that change in the meantime may be in any order; the result must be a valid sample.
      const double offset = static_cast<double>(distance(first_, stamp)) * per_nanosecond_;
      const auto last_offset = static_cast<double>(high_ - low_);
      return low_ + static_cast<std::uint64_t>(offset < last_offset ? offset : last_offset);
    }
    // Finds the first sample newer than a stamp that is covered and not the newest, in doubling steps from the guess.
    std::uint64_t first_after(Stamp stamp, std::uint64_t guess) const;
    // Returns the newer of the two samples that View::between() needs, for a covered stamp.
    std::uint64_t next(Stamp stamp, std::uint64_t guess) const {
      if (stamp == last_) return high_;
      if (stamp == first_) return low_ + 1;
      // Usually it directly follows the guess.
      const bool is_next = samples_.stamp_of(guess) <= stamp && stamp < samples_.stamp_of(std::min(guess + 1, high_));
      return is_next ? guess + 1 : first_after(stamp, guess);
    }
    // Returns the interval between the previous sample and this one.
    Interval interval(std::uint64_t next) const {
      const Chunk &before = samples_.chunk_of(next - 1), &chunk = samples_.chunk_of(next);
      const std::size_t i = (next - 1) % Chunk::kSize, j = next % Chunk::kSize;
      return {&before.samples[i], &chunk.samples[j], before.stamps[i], chunk.stamps[j]};
    }
    bool is_newest(Stamp stamp) const { return stamp == last_; }
    // A placeholder for stamps that are not covered.
    std::uint64_t any() const { return low_ + 1; }

   private:
    const View& samples_;
    Stamp first_, last_;
    std::uint64_t low_, high_;  // the oldest and the newest sample
    double per_nanosecond_;     // samples
  };

  History() = default;
  History(const History&) = delete;
  History& operator=(const History&) = delete;

  // Reads the beginning before the end: samples that are pruned in between are still in place.
  View view() const {
    View view;
    view.kind_ = kind_;
    view.fixed_ = &fixed_;
    view.begin_ = begin_.load(std::memory_order_acquire);
    view.end_ = end_.load(std::memory_order_acquire);
    view.directory_ = directory_.known();
    return view;
  }
  // The range of stamps with samples and the parent in the newest one, without access to the samples. The range of a
  // static history is from the first possible stamp to the last, that of an empty one the reverse.
  struct Span {
    Stamp first, last;
    FrameId parent;
  };
  // Reads the last stamp before the parent: a reader that sees a newer sample also sees its parent.
  Span span() const {
    Span span;
    span.last = last_.load(std::memory_order_acquire);
    span.first = first_.load(std::memory_order_acquire);
    span.parent = parent_;
    return span;
  }
  // True while every sample has the same parent: paths through this history may then be cached.
  bool one_parent() const { return one_parent_; }

  // Finds the samples and the fraction for the pose at `stamp` if both are relative to `parent`. Returns false if
  // View::at() has to find out why not. `hint` stores the position of the caller's last lookup, because the next one is
  // usually close in time.
  bool locate(Stamp stamp, FrameId parent, std::uint64_t& hint, Edge& edge) const {
    const View samples = view();
    Pair pair;
    if (!samples.bracket_in_chunk(stamp, hint, pair) && !find_elsewhere(samples, stamp, hint, pair)) return false;
    if (pair.older->parent() != parent || pair.newer->parent() != parent) return false;
    edge.older = pair.older->numbers();
    edge.newer = pair.newer->numbers();
    edge.fraction = pair.part / pair.whole;
    return true;
  }
  // Returns whether a sample is relative to that frame.
  bool mentions(FrameId parent) const;

  // The methods below are for the only writer.

  // Stores a sample like tf2: prunes by the newest stamp before this insertion, rejects samples older than the cache
  // length, ignores exact repetitions, and stores equal stamps one after the other. Not for HistoryKind::none.
  Insertion insert(const HistoryContext& context, Stamp stamp, const Sample& sample);
  // insert() for the usual case: a sample newer than all others, with the same parent, and without an allocation.
  // Returns false if nothing was done.
  bool append_newer(const HistoryContext& context, Stamp stamp, const Sample& sample) {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (kind_ != HistoryKind::dynamic || !one_parent_ || end == room_end_) return false;
    const Stamp newest = last_.load(std::memory_order_relaxed);
    if (stamp <= newest || parent_ != sample.parent) return false;
    prune(context, newest);
    put(end, stamp, sample);
    end_.store(end + 1, std::memory_order_release);
    last_.store(stamp, std::memory_order_release);
    return true;
  }
  // Stores the leading rows of 7, x, y, z, qx, qy, qz, qw, that can be normalized and are each newer than all before;
  // returns how many.
  std::size_t append_run(const HistoryContext& context, const Stamp* stamps, const double* rows, std::size_t count,
                         FrameId parent);
  // Resets to another kind.
  void reset(const HistoryContext& context, HistoryKind kind);
  // Removes all samples of a dynamic history. A static one does not change.
  void clear(const HistoryContext& context);
  // Copies the current state of `other`. The samples are shared.
  void share(const HistoryStorage& storage, const History& other);
  // Copies the current state of `other` with its newest samples, at most `max_samples`. Requires that `other` does not
  // change meanwhile, or that the caller discards the copy then.
  void copy(const HistoryContext& context, const History& other, std::size_t max_samples);
  // Uses samples that are owned elsewhere and never change: contiguous chunks, all full except the last.
  void map(const HistoryStorage& storage, const Chunk* chunks, std::uint64_t samples, bool one_parent,
           const Span& span);
  void release(const HistoryStorage& storage);

  // For a tree with limited memory: returns whether one more sample can be stored.
  bool has_room(const HistoryStorage& storage) const;
  std::uint64_t chunk_count() const;
  // Removes the samples of the oldest chunk, of two or more.
  void drop_oldest_chunk(ChunkPool& pool);

  // For a writer that continues the work of one that died: completes a change.
  void complete(const HistoryContext& context, Interrupted& change);
  // Computes what is derived from the samples, which the dead writer may have left behind.
  void repair();
  // Counts the history as a holder of its chunks.
  void hold_chunks() const;

 private:
  static bool find_elsewhere(const View& samples, Stamp stamp, std::uint64_t& hint, Pair& pair);
  Insertion insert_behind(const HistoryContext& context, Stamp stamp, const Sample& sample);
  Insertion insert_fixed(const HistoryContext& context, const Sample& sample);
  void append(const HistoryContext& context, Stamp stamp, const Sample& sample);
  void put_at(const HistoryContext& context, std::size_t position, Stamp stamp, const Sample& sample);
  void extend(const HistoryContext& context);
  std::size_t next_length() const;
  void own_chunks(ChunkPool& pool, std::uint64_t first, std::uint64_t end);
  // Prunes by the newest stamp before the last insertion; returns the earliest stamp that is kept.
  Stamp prune(const HistoryContext& context, Stamp newest) {
    if (context.cache_length == kKeepAll) return kFirstStamp;
    const Stamp start = minus(newest, context.cache_length);
    if (first_.load(std::memory_order_relaxed) < start) drop_older_than(context.storage.pool, start);
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    if (end_.load(std::memory_order_relaxed) - begin >= kMaxSamples)
      drop_before(context.storage.pool, begin + Chunk::kSize);
    return start;
  }
  // Saturates: stamps may have any value.
  static Stamp minus(Stamp stamp, Stamp length) { return stamp < kFirstStamp + length ? kFirstStamp : stamp - length; }
  void drop_older_than(ChunkPool& pool, Stamp stamp);
  void drop_before(ChunkPool& pool, std::uint64_t begin);
  void drop_all(const HistoryStorage& storage);
  std::uint64_t room_end() const;
  Chunk* chunk_at(std::uint64_t index) const {
    return directory_.known()->chunk(index / Chunk::kSize).known(std::memory_order_relaxed);
  }
  void put(std::uint64_t index, Stamp stamp, const Sample& sample) {
    Chunk& chunk = *chunk_at(index);
    chunk.stamps[index % Chunk::kSize] = stamp;
    chunk.samples[index % Chunk::kSize].store(sample);
  }
  void shift_and_put(Interrupted* progress, std::uint64_t first, std::uint64_t last, std::uint64_t end, Stamp stamp,
                     const Sample& sample);
  void set_fixed(const Sample& sample);
  bool must_grow() const;
  void grow(const HistoryStorage& storage);

  RelativePointer<Directory> directory_;  // set before the first sample is; readers may still use earlier ones
  Atomic<std::uint64_t> begin_{0};        // samples are numbered since the start of the history
  Atomic<std::uint64_t> end_{0};
  std::uint64_t room_end_ = 0;  // the number of the first sample that the last chunk has no room for
  // The values of span(): of the samples from begin_ to end_, or of fewer during a change.
  Atomic<Stamp> first_{kLastStamp}, last_{kFirstStamp};
  RelaxedAtomic<FrameId> parent_{0};
  RelaxedAtomic<HistoryKind> kind_{HistoryKind::none};
  RelaxedAtomic<bool> one_parent_{true};
  bool mapped_ = false;  // the chunks do not belong to a pool
  SharedSample fixed_;   // the one sample of a static history
};

// The change of a history that is in progress, with what a writer needs that completes it after the death of its own
// writer. Its kind is set last, and reset at the end of the change.
struct Interrupted {
  enum class Kind : std::uint32_t { none, put, set_fixed, reset };

  Atomic<Kind> kind{Kind::none};
  RelativePointer<History> history;
  // Of `put`: the samples from `first` on, which end before `end`, move by one; those from `next` on are done.
  RelaxedAtomic<std::uint64_t> first, end;
  Atomic<std::uint64_t> next{0};
  RelaxedAtomic<Stamp> stamp;
  SharedSample sample;                  // of `put` and `set_fixed`
  RelaxedAtomic<HistoryKind> new_kind;  // of `reset`
};

}  // namespace coframe
