// SPDX-License-Identifier: Apache-2.0
// The samples of one frame in time order, searched and not walked. tf2's TimeCache and StaticCache. One thread writes,
// any number read without a lock: what they get is good if the tree's revision did not change meanwhile.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "core/chunks.hpp"
#include "core/pose.hpp"
#include "core/relaxed_atomic.hpp"
#include "core/revision.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

inline constexpr Stamp kKeepAll = -1;  // a cache length without end
inline constexpr Stamp kFirstStamp = std::numeric_limits<Stamp>::min(), kLastStamp = std::numeric_limits<Stamp>::max();

// What a sample's search came to.
enum class Found { ok, empty, only_other, too_new, too_old };

// What became of a sample that was to be stored.
enum class Insertion { appended, put_before_newer, repeated, refused_as_old };

// A frame without history is the root of a tree: nobody has told where it is.
enum class HistoryKind : std::uint8_t { none, dynamic, fixed };

// What all histories of a tree share.
struct HistoryContext {
  Stamp cache_length;
  ChunkPool& pool;
  Revision& revision;
};

// Asks for memory that is needed soon.
inline void prefetch(const void* address) {
#if defined(__GNUC__)
  __builtin_prefetch(address);
#else
  (void)address;
#endif
}

class History {
  // Chunk n of the history's life lies at n modulo the size.
  struct Directory {
    explicit Directory(std::uint64_t size);
    std::uint64_t mask;
    std::unique_ptr<std::atomic<Chunk*>[]> chunks;
  };

 public:
  class Search;

  // Two samples, and which part of the way from one to the other is meant: part / whole.
  struct Pair {
    const SharedSample *older, *newer;
    double part, whole;
  };

  // Two samples that follow each other, and their stamps.
  struct Interval {
    const SharedSample *older, *newer;
    Stamp start, end;
  };

  // What a reader sees: the samples that were there when it began. Appended ones do not show.
  class View {
   public:
    bool exists() const { return kind_ != HistoryKind::none; }
    bool is_static() const { return kind_ == HistoryKind::fixed; }
    bool empty() const { return end_ <= begin_; }
    std::size_t size() const { return empty() ? 0 : static_cast<std::size_t>(end_ - begin_); }

    Stamp time(std::size_t i) const { return stamp_of(begin_ + i); }
    Sample sample(std::size_t i) const { return sample_of(begin_ + i).load(); }
    FrameId parent_at(std::size_t i) const { return sample_of(begin_ + i).parent(); }
    // Stamps of both ends; 0 for a static or empty history, as tf2 has it.
    Stamp oldest() const { return is_static() || empty() ? 0 : time(0); }
    Stamp newest() const { return is_static() || empty() ? 0 : time(size() - 1); }
    // The frame the newest sample is told in; 0 when empty.
    FrameId parent() const { return empty() ? 0 : parent_at(size() - 1); }

    // The pose at `stamp` and the frame it is told in. No extrapolation, ever.
    Found at(Stamp stamp, Pose& pose, FrameId& parent) const;
    // The samples that at() makes its pose of; `next` is the number of the newer one.
    Found find(Stamp stamp, Pair& pair, std::uint64_t& next) const;
    // Whether the sample `next` and the one before are those, in the case of most look-ups: between the two of them, in
    // one chunk. False also for what is no number of a sample.
    bool surrounded(Stamp stamp, std::uint64_t next, Pair& pair) const {
      const std::size_t i = next % Chunk::kSize;
      if (i == 0 || next <= begin_ || next >= end_) return false;
      const Chunk& chunk = chunk_of(next);
      const Stamp start = chunk.stamps[i - 1], end = chunk.stamps[i];
      const auto whole = static_cast<std::int64_t>(distance(start, end));
      if (start >= stamp || stamp >= end || whole < 0) return false;
      pair = {&chunk.samples[i - 1], &chunk.samples[i], static_cast<double>(stamp - start), static_cast<double>(whole)};
      return true;
    }
    // A chunk's worth of stamps and samples from that index on, without what is beyond the last one; not for a static
    // history.
    void copy(std::size_t first, char* stamps, char* samples) const;
    // Index of the first sample newer than `stamp`; size() if there is none.
    std::size_t first_after(Stamp stamp) const;

    // For many look-ups at once; samples by their number in the history's life, as Search tells them.
    void prefetch_stamp(std::uint64_t number) const { prefetch(&chunk_of(number).stamps[number % Chunk::kSize]); }
    void prefetch_samples(std::uint64_t next) const {
      prefetch(&chunk_of(next - 1).samples[(next - 1) % Chunk::kSize]);
      prefetch(&chunk_of(next).samples[next % Chunk::kSize]);
    }
    // So many from that one on.
    void prefetch_from(std::uint64_t number, std::uint64_t count) const {
      for (const std::uint64_t end = std::min(number + count, end_); number < end; ++number) {
        prefetch(&chunk_of(number).samples[number % Chunk::kSize]);
      }
    }
    // The two samples between which the pose at `stamp` lies, one of them where it holds alone; `stamp` lies between
    // the sample `next` and the one before. At the stamp of a sample there is nothing between: the newest holds, or
    // else the last one of that stamp, and at the oldest stamp the first one. A change of the parent is not
    // interpolated over: the older sample holds (tf2's findClosest).
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
    // By their number in the history's life.
    const Chunk& chunk_of(std::uint64_t number) const {
      return *directory_->chunks[number / Chunk::kSize & directory_->mask].load(std::memory_order_acquire);
    }
    Stamp stamp_of(std::uint64_t number) const { return chunk_of(number).stamps[number % Chunk::kSize]; }
    const SharedSample& sample_of(std::uint64_t number) const {
      return is_static() ? *fixed_ : chunk_of(number).samples[number % Chunk::kSize];
    }
    const Directory* directory_;
    const SharedSample* fixed_;
    std::uint64_t begin_, end_;
    HistoryKind kind_;
  };

  // Where in a dynamic history of at least two samples a stamp lies.
  class Search {
   public:
    explicit Search(const View& samples);

    bool covers(Stamp stamp) const { return stamp >= first_ && stamp <= last_; }
    // Rates are nearly constant, so a straight line through both ends lands close. For any stamp: a sample.
    std::uint64_t guess(Stamp stamp) const {
      if (stamp <= first_) return low_;
      // Numbers that are being changed may be in no order: whatever comes out must be a sample.
      const double offset = static_cast<double>(distance(first_, stamp)) * per_nanosecond_;
      const auto most = static_cast<double>(high_ - low_);
      return low_ + static_cast<std::uint64_t>(offset < most ? offset : most);
    }
    // The first sample newer than a stamp that covers() allows and that is not the newest: doubling steps from the
    // guess find it.
    std::uint64_t first_after(Stamp stamp, std::uint64_t guess) const;
    // The newer one of the two samples that View::between() wants for a stamp that covers() allows.
    std::uint64_t next(Stamp stamp, std::uint64_t guess) const {
      if (stamp == last_) return high_;
      if (stamp == first_) return low_ + 1;
      // Mostly it lies right behind the guess.
      const bool is_next = samples_.stamp_of(guess) <= stamp && stamp < samples_.stamp_of(std::min(guess + 1, high_));
      return is_next ? guess + 1 : first_after(stamp, guess);
    }
    // The sample before that one, and that one.
    Interval interval(std::uint64_t next) const {
      const Chunk &before = samples_.chunk_of(next - 1), &chunk = samples_.chunk_of(next);
      const std::size_t i = (next - 1) % Chunk::kSize, j = next % Chunk::kSize;
      return {&before.samples[i], &chunk.samples[j], before.stamps[i], chunk.stamps[j]};
    }
    bool is_newest(Stamp stamp) const { return stamp == last_; }
    // For a stamp that it does not allow.
    std::uint64_t any() const { return low_ + 1; }

   private:
    const View& samples_;
    Stamp first_, last_;
    std::uint64_t low_, high_;  // the oldest and the newest
    double per_nanosecond_;     // samples
  };

  History();
  History(const History&) = delete;
  History& operator=(const History&) = delete;
  ~History();

  // The beginning before the end: samples that are dropped in between still stand where they were.
  View view() const {
    View view;
    view.kind_ = kind_;
    view.fixed_ = &fixed_;
    view.begin_ = begin_.load(std::memory_order_acquire);
    view.end_ = end_.load(std::memory_order_acquire);
    view.directory_ = directory_.load(std::memory_order_acquire);
    return view;
  }
  // From which stamp to which there are samples, and the frame that the newest is told in: without a look at the
  // samples themselves. A static history reaches from the first of all stamps to the last, an empty one from the last
  // to the first.
  struct Span {
    Stamp first, last;
    FrameId parent;
  };
  // The last stamp before the parent: who sees a newer sample sees the frame that it is told in.
  Span span() const {
    Span span;
    span.last = last_.load(std::memory_order_acquire);
    span.first = first_.load(std::memory_order_acquire);
    span.parent = parent_;
    return span;
  }
  // True while every sample has the same parent: paths through this history may then be remembered.
  bool one_parent() const { return one_parent_; }

  // Where on its way the pose at `stamp` lies, if it is told in `parent`; false where View::at() has to say why not.
  // `hint` is of the caller's last query: the next one is mostly about a time close by.
  bool place(Stamp stamp, FrameId parent, std::uint64_t& hint, Link& link) const {
    const View samples = view();
    Pair pair;
    if (!samples.surrounded(stamp, hint, pair) && !find_elsewhere(samples, stamp, hint, pair)) return false;
    if (pair.older->parent() != parent || pair.newer->parent() != parent) return false;
    link.older = pair.older->numbers();
    link.newer = pair.newer->numbers();
    link.share = pair.part / pair.whole;
    return true;
  }
  // Whether a sample is told in that frame.
  bool mentions(FrameId parent) const;

  // The rest is for the one writer.

  // Stores a sample as tf2 does: prunes by the newest stamp before this one, refuses what is older than the cache
  // length, takes an exact repetition silently, puts equal stamps behind each other. Not for HistoryKind::none.
  Insertion insert(const HistoryContext& context, Stamp stamp, const Sample& sample);
  // insert() of a sample that is newer than all and told in the same frame as they, where nothing has to grow: the
  // usual case. False: nothing was done.
  bool append_newer(const HistoryContext& context, Stamp stamp, const Sample& sample) {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    const std::size_t i = end % Chunk::kSize;  // 0 also where there are no samples yet
    if (kind_ != HistoryKind::dynamic || !one_parent_ || i == 0) return false;
    const Stamp newest = last_.load(std::memory_order_relaxed);
    if (stamp <= newest || parent_ != sample.parent) return false;
    prune(context, newest);
    Chunk& chunk = *chunk_at(end);
    chunk.stamps[i] = stamp;
    chunk.samples[i].store(sample);
    end_.store(end + 1, std::memory_order_release);
    last_.store(stamp, std::memory_order_release);
    return true;
  }
  // Stores rows of 7, x, y, z, qx, qy, qz, qw, that can be normalised, as long as each is newer than the one before and
  // the newest; returns how many.
  std::size_t append_run(const HistoryContext& context, const Stamp* stamps, const double* rows, std::size_t count,
                         FrameId parent);
  // Starts anew as another kind.
  void reset(const HistoryContext& context, HistoryKind kind);
  // Forgets all samples of a dynamic history; a static one stays.
  void clear(const HistoryContext& context);
  // Becomes what `other` is at this moment; the chunks are shared.
  void share(const History& other);
  // Becomes one whose samples somebody else holds and nobody changes: chunks in a row, all full but for the last.
  void map(const Chunk* chunks, std::uint64_t samples, bool one_parent, const Span& span);
  void release(ChunkPool& pool);

 private:
  static bool find_elsewhere(const View& samples, Stamp stamp, std::uint64_t& hint, Pair& pair);
  Insertion insert_behind(const HistoryContext& context, Stamp stamp, const Sample& sample);
  Insertion insert_fixed(const HistoryContext& context, const Sample& sample);
  void append(const HistoryContext& context, Stamp stamp, const Sample& sample);
  void put_at(const HistoryContext& context, std::size_t position, Stamp stamp, const Sample& sample);
  void add_chunk(const HistoryContext& context);
  void own_chunks(ChunkPool& pool, std::uint64_t first, std::uint64_t end);
  // By the newest stamp there was before the last insertion; returns the earliest stamp that is kept.
  Stamp prune(const HistoryContext& context, Stamp newest) {
    if (context.cache_length == kKeepAll) return kFirstStamp;
    const Stamp start = minus(newest, context.cache_length);
    if (first_.load(std::memory_order_relaxed) < start) drop_older_than(context.pool, start);
    return start;
  }
  // Saturating: stamps may come from anywhere.
  static Stamp minus(Stamp stamp, Stamp length) { return stamp < kFirstStamp + length ? kFirstStamp : stamp - length; }
  void drop_older_than(ChunkPool& pool, Stamp stamp);
  void drop_all(ChunkPool& pool);
  PooledChunk* pooled_chunk_at(std::uint64_t index) const { return static_cast<PooledChunk*>(chunk_at(index)); }
  Chunk* chunk_at(std::uint64_t index) const {
    const Directory& directory = *directory_;
    return directory.chunks[index / Chunk::kSize & directory.mask].load(std::memory_order_relaxed);
  }
  void put(std::uint64_t index, Stamp stamp, const Sample& sample);
  void grow();

  std::atomic<const Directory*> directory_{nullptr};
  std::atomic<std::uint64_t> begin_{0};  // samples are numbered through the history's life
  std::atomic<std::uint64_t> end_{0};
  // What reach() tells: of the samples from begin_ to end_, or of fewer while they change.
  std::atomic<Stamp> first_{kLastStamp}, last_{kFirstStamp};
  RelaxedAtomic<FrameId> parent_{0};
  RelaxedAtomic<HistoryKind> kind_{HistoryKind::none};
  RelaxedAtomic<bool> one_parent_{true};
  bool mapped_ = false;                                  // the chunks are of no pool
  SharedSample fixed_;                                   // the one sample of a static history
  std::vector<std::unique_ptr<Directory>> directories_;  // the last is in use; readers may still be in the others
};

}  // namespace coframe
