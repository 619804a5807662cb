// SPDX-License-Identifier: Apache-2.0
#include "core/history.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "kernels/kernels.hpp"

namespace coframe {

namespace {

// Compared by value: 0.0 equals -0.0.
bool same(const Sample& a, const Sample& b) {
  return a.parent == b.parent && std::equal(a.pose.q, a.pose.q + 4, b.pose.q) &&
         std::equal(a.pose.p, a.pose.p + 3, b.pose.p);
}

// Fills entries without a chunk.
Chunk* no_chunk() {
  static Chunk chunk;
  return &chunk;
}

// A publisher may send any number of different transforms with one stamp; comparing each with all others would take
// quadratic time.
constexpr std::size_t kMostCompared = 64;

// Returns whether one of the last samples at `stamp`, which end before index `end`, equals `sample`.
bool repeats(const History::View& samples, std::size_t end, Stamp stamp, const Sample& sample) {
  const std::size_t begin = end < kMostCompared ? 0 : end - kMostCompared;
  for (std::size_t i = end; i > begin && samples.time(i - 1) == stamp; --i) {
    if (same(samples.sample(i - 1), sample)) return true;
  }
  return false;
}

}  // namespace

Found History::View::find(Stamp stamp, Pair& found, std::uint64_t& next) const {
  const auto alone = [&](const SharedSample& sample) {
    found = {&sample, &sample, 0.0, 1.0};
    return Found::ok;
  };
  if (empty()) return Found::empty;
  next = end_ - 1;
  if (is_static()) return alone(*fixed_);
  const Stamp last = stamp_of(next);
  if (stamp == last || stamp == 0) return alone(sample_of(next));
  if (next == begin_) return Found::only_other;
  if (stamp > last) return Found::too_new;
  // Most lookups are near the newest sample.
  if (stamp_of(next - 1) >= stamp) {
    const Stamp first = stamp_of(begin_);
    if (stamp == first) return alone(sample_of(begin_));
    if (stamp < first) return Found::too_old;
    if (stamp_of(next - 1) > stamp) {
      const Search search(*this);
      const std::uint64_t guess = search.guess(stamp);
      prefetch_samples(guess + 1);
      next = search.next(stamp, guess);
    }
  }
  found = pair(next, stamp);
  return Found::ok;
}

Found History::View::at(Stamp stamp, Pose& pose, FrameId& parent) const {
  Pair pair;
  std::uint64_t next;
  const Found found = find(stamp, pair, next);
  if (found != Found::ok) return found;
  parent = pair.older->parent();
  if (pair.older == pair.newer) {
    pair.older->load(pose);
    return found;
  }
  Pose from, to;
  pair.older->load(from);
  pair.newer->load(to);
  interpolate(from, to, pair.part / pair.whole, pose);
  return found;
}

void History::View::copy(std::size_t first, char* stamps, char* samples) const {
  const std::size_t count = std::min(Chunk::kSize, size() - first);
  for (std::size_t i = 0; i < count; ++i) {
    const Stamp stamp = time(first + i);
    const SharedSample& sample = sample_of(begin_ + first + i);
    std::memcpy(stamps + i * sizeof stamp, &stamp, sizeof stamp);
    std::memcpy(samples + i * sizeof sample, sample.numbers(), sizeof sample);
  }
}

std::size_t History::View::first_after(Stamp stamp) const {
  if (empty()) return 0;
  if (stamp_of(end_ - 1) <= stamp) return size();
  if (stamp < stamp_of(begin_)) return 0;
  const Search search(*this);
  return static_cast<std::size_t>(search.first_after(stamp, search.guess(stamp)) - begin_);
}

History::Search::Search(const View& samples)
    : samples_(samples),
      first_(samples.stamp_of(samples.begin_)),
      last_(samples.stamp_of(samples.end_ - 1)),
      low_(samples.begin_),
      high_(samples.end_ - 1),
      per_nanosecond_(static_cast<double>(high_ - low_) / static_cast<double>(distance(first_, last_))) {}

std::uint64_t History::Search::first_after(Stamp stamp, std::uint64_t guess) const {
  std::uint64_t low = low_, high = high_;  // stamp_of(low) <= stamp < stamp_of(high)
  std::uint64_t step = 1;
  if (samples_.stamp_of(guess) <= stamp) {
    for (low = guess; high - low > step && samples_.stamp_of(low + step) <= stamp; step *= 2) low += step;
    high = std::min(low + step, high);
  } else {
    for (high = guess; high - low > step && samples_.stamp_of(high - step) > stamp; step *= 2) high -= step;
    low = high - low > step ? high - step : low;
  }
  while (high - low > 1) {
    const std::uint64_t middle = low + (high - low) / 2;
    (samples_.stamp_of(middle) <= stamp ? low : high) = middle;
  }
  return std::max(high, low_ + 1);
}

History::Directory::Directory(std::uint64_t size) : mask(size - 1), chunks(new std::atomic<Chunk*>[size]) {
  for (std::uint64_t i = 0; i < size; ++i) chunks[i].store(no_chunk(), std::memory_order_relaxed);
}

History::History() { grow(); }

History::~History() = default;

bool History::find_elsewhere(const View& samples, Stamp stamp, std::uint64_t& hint, Pair& pair) {
  if (!samples.surrounded(stamp, hint + 1, pair)) return samples.find(stamp, pair, hint) == Found::ok;
  ++hint;
  return true;
}

bool History::mentions(FrameId parent) const {
  const View samples = view();
  if (one_parent_) return !samples.empty() && samples.parent() == parent;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples.parent_at(i) == parent) return true;
  }
  return false;
}

Insertion History::insert(const HistoryContext& context, Stamp stamp, const Sample& sample) {
  if (kind_ == HistoryKind::fixed) return insert_fixed(context, sample);
  const View before = view();
  if (!before.empty()) {
    const Stamp newest = before.newest();
    if (stamp < prune(context, newest)) return Insertion::refused_as_old;
    if (sample.parent != before.parent()) one_parent_ = false;
    if (stamp <= newest) return insert_behind(context, stamp, sample);
  }
  append(context, stamp, sample);
  return Insertion::appended;
}

// Not newer than the newest.
Insertion History::insert_behind(const HistoryContext& context, Stamp stamp, const Sample& sample) {
  const View samples = view();
  const std::size_t position = samples.first_after(stamp);
  if (repeats(samples, position, stamp, sample)) return Insertion::repeated;
  if (position == samples.size()) {
    append(context, stamp, sample);
    return Insertion::appended;
  }
  put_at(context, position, stamp, sample);
  return Insertion::put_before_newer;
}

Insertion History::insert_fixed(const HistoryContext& context, const Sample& sample) {
  if (!view().empty() && same(fixed_.load(), sample)) return Insertion::repeated;
  const Revision::Change change(context.revision);
  fixed_.store(sample);
  end_.store(begin_ + 1, std::memory_order_release);
  parent_ = sample.parent;
  first_.store(kFirstStamp, std::memory_order_release);
  last_.store(kLastStamp, std::memory_order_release);
  return Insertion::appended;
}

void History::reset(const HistoryContext& context, HistoryKind kind) {
  const Revision::Change change(context.revision);
  drop_all(context.pool);
  kind_ = kind;
}

void History::clear(const HistoryContext& context) {
  if (kind_ != HistoryKind::dynamic) return;
  const Revision::Change change(context.revision);
  drop_all(context.pool);
}

void History::share(const History& other) {
  const View samples = other.view();
  kind_ = other.kind_.get();
  one_parent_ = other.one_parent_.get();
  mapped_ = other.mapped_;
  fixed_.store(other.fixed_.load());
  begin_ = samples.begin_;
  end_ = samples.end_;
  first_ = other.first_.load();
  last_ = other.last_.load();
  parent_ = other.parent_.get();
  if (samples.empty() || samples.is_static()) return;
  auto copy = std::make_unique<Directory>(samples.directory_->mask + 1);
  for (std::uint64_t n = samples.begin_ / Chunk::kSize; n <= (samples.end_ - 1) / Chunk::kSize; ++n) {
    Chunk* chunk = other.chunk_at(n * Chunk::kSize);
    if (!mapped_) static_cast<PooledChunk*>(chunk)->holders.fetch_add(1, std::memory_order_relaxed);
    copy->chunks[n & copy->mask].store(chunk, std::memory_order_relaxed);
  }
  directories_.push_back(std::move(copy));
  directory_ = directories_.back().get();
}

void History::map(const Chunk* chunks, std::uint64_t samples, bool one_parent, const Span& span) {
  const std::uint64_t count = (samples + Chunk::kSize - 1) / Chunk::kSize;
  auto directory = std::make_unique<Directory>(std::bit_ceil(std::max<std::uint64_t>(count, 1)));
  // Mapped chunks are never written: their tree is frozen.
  auto* first = const_cast<Chunk*>(chunks);
  for (std::uint64_t n = 0; n < count; ++n) directory->chunks[n].store(first + n, std::memory_order_relaxed);
  directories_.push_back(std::move(directory));
  directory_ = directories_.back().get();
  kind_ = HistoryKind::dynamic;
  one_parent_ = one_parent;
  mapped_ = true;
  end_ = samples;
  first_ = span.first;
  last_ = span.last;
  parent_ = span.parent;
}

void History::release(ChunkPool& pool) { drop_all(pool); }

void History::append(const HistoryContext& context, Stamp stamp, const Sample& sample) {
  const std::uint64_t index = end_;
  if (index % Chunk::kSize == 0) add_chunk(context);
  put(index, stamp, sample);
  parent_ = sample.parent;
  if (index == begin_) first_.store(stamp, std::memory_order_release);
  end_.store(index + 1, std::memory_order_release);
  last_.store(stamp, std::memory_order_release);
}

// Chunk by chunk.
std::size_t History::append_run(const HistoryContext& context, const Stamp* stamps, const double* rows,
                                std::size_t count, FrameId parent) {
  Stamp newest = last_;
  std::size_t stored = 0;
  while (stored < count && stamps[stored] > newest) {
    const std::uint64_t start = end_;
    if (start % Chunk::kSize == 0) add_chunk(context);
    Chunk& chunk = *chunk_at(start);
    const std::size_t first = start % Chunk::kSize, most = std::min(count - stored, Chunk::kSize - first);
    std::size_t run = 0;
    Stamp before = newest;
    do {
      chunk.stamps[first + run] = stamps[stored + run];
      before = newest;
      newest = stamps[stored + run++];
    } while (run < most && stamps[stored + run] > newest);
    std::atomic_thread_fence(std::memory_order_release);  // a reader of the parent's id finds the frame
    kernels().store_samples(rows + 7 * stored, run, parent, chunk.samples[first].numbers());
    stored += run;
    end_.store(start + run, std::memory_order_release);
    last_.store(newest, std::memory_order_release);
    prune(context, before);
  }
  return stored;
}

// All samples from the position on move by one; this is rare and usually affects few.
void History::put_at(const HistoryContext& context, std::size_t position, Stamp stamp, const Sample& sample) {
  const std::uint64_t first = begin_ + position;
  std::uint64_t last = end_;
  if (last % Chunk::kSize == 0) add_chunk(context);
  const Revision::Change change(context.revision);
  own_chunks(context.pool, first, last + 1);
  for (; last > first; --last) {
    const Chunk& from = *chunk_at(last - 1);
    const std::size_t i = (last - 1) % Chunk::kSize;
    put(last, from.stamps[i], from.samples[i].load());
  }
  put(first, stamp, sample);
  if (position == 0) first_.store(stamp, std::memory_order_release);
  end_.store(end_ + 1, std::memory_order_release);
}

void History::add_chunk(const HistoryContext& context) {
  const std::uint64_t number = end_ / Chunk::kSize;
  const Revision::Change change(context.revision);
  if (number - begin_ / Chunk::kSize > directory_.load()->mask) grow();
  const Directory& directory = *directory_;
  directory.chunks[number & directory.mask].store(context.pool.take(), std::memory_order_release);
}

// Copies chunks that are shared with a snapshot before they change.
void History::own_chunks(ChunkPool& pool, std::uint64_t first, std::uint64_t end) {
  for (std::uint64_t n = first / Chunk::kSize; n <= (end - 1) / Chunk::kSize; ++n) {
    PooledChunk* shared = pooled_chunk_at(n * Chunk::kSize);
    if (shared->holders.load(std::memory_order_acquire) == 1) continue;
    Chunk* own = pool.take();
    for (std::size_t i = 0; i < Chunk::kSize; ++i) {
      own->stamps[i] = shared->stamps[i].get();
      own->samples[i].store(shared->samples[i].load());
    }
    const Directory& directory = *directory_;
    directory.chunks[n & directory.mask].store(own, std::memory_order_release);
    pool.release(shared);
  }
}

void History::drop_older_than(ChunkPool& pool, Stamp stamp) {
  const std::uint64_t first = begin_.load(std::memory_order_relaxed), end = end_.load(std::memory_order_relaxed);
  std::uint64_t begin = first;
  while (begin + 1 < end && chunk_at(begin)->stamps[begin % Chunk::kSize] < stamp) ++begin;
  if (begin != first) drop_before(pool, begin);
}

void History::drop_before(ChunkPool& pool, std::uint64_t begin) {
  const std::uint64_t first = begin_.load(std::memory_order_relaxed);
  first_.store(chunk_at(begin)->stamps[begin % Chunk::kSize], std::memory_order_release);
  begin_.store(begin, std::memory_order_release);
  for (std::uint64_t n = first / Chunk::kSize; n < begin / Chunk::kSize; ++n) {
    pool.release(pooled_chunk_at(n * Chunk::kSize));
  }
}

// The next sample starts a new chunk.
void History::drop_all(ChunkPool& pool) {
  const std::uint64_t end = end_;
  if (kind_ == HistoryKind::dynamic && end > begin_ && !mapped_) {
    for (std::uint64_t n = begin_ / Chunk::kSize; n <= (end - 1) / Chunk::kSize; ++n) {
      pool.release(pooled_chunk_at(n * Chunk::kSize));
    }
  }
  const std::uint64_t next = (end + Chunk::kSize - 1) / Chunk::kSize * Chunk::kSize;
  begin_.store(next, std::memory_order_release);
  end_.store(next, std::memory_order_release);
  first_.store(kLastStamp, std::memory_order_release);
  last_.store(kFirstStamp, std::memory_order_release);
  one_parent_ = true;
}

void History::put(std::uint64_t index, Stamp stamp, const Sample& sample) {
  Chunk& chunk = *chunk_at(index);
  chunk.stamps[index % Chunk::kSize] = stamp;
  chunk.samples[index % Chunk::kSize].store(sample);
}

void History::grow() {
  const Directory* old = directory_;
  auto larger = std::make_unique<Directory>(old ? 2 * (old->mask + 1) : 2);
  if (old) {
    for (std::uint64_t n = begin_ / Chunk::kSize, i = 0; i <= old->mask; ++n, ++i) {
      larger->chunks[n & larger->mask].store(old->chunks[n & old->mask].load(), std::memory_order_relaxed);
    }
  }
  directories_.push_back(std::move(larger));
  directory_.store(directories_.back().get(), std::memory_order_release);
}

}  // namespace coframe
