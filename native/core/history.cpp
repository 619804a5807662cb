// SPDX-License-Identifier: Apache-2.0
#include "core/history.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/interpolation.hpp"
#include "core/screw.hpp"
#include "kernels/kernels.hpp"

namespace coframe {

namespace {

// Compared by value: 0.0 equals -0.0.
bool same(const Sample& a, const Sample& b) {
  return a.parent == b.parent && std::equal(a.pose.q, a.pose.q + 4, b.pose.q) &&
         std::equal(a.pose.p, a.pose.p + 3, b.pose.p);
}

// A publisher may send any number of different transforms with one stamp; comparing each with all others would take
// quadratic time.
constexpr std::size_t kMaxCompared = 64;

constexpr std::uint64_t kFirstDirectory = 2;

// Returns whether one of the last samples at `stamp`, which end before index `end`, equals `sample`.
bool repeats(const History::View& samples, std::size_t end, Stamp stamp, const Sample& sample) {
  const std::size_t begin = end < kMaxCompared ? 0 : end - kMaxCompared;
  for (std::size_t i = end; i > begin && samples.time(i - 1) == stamp; --i) {
    if (same(samples.sample(i - 1), sample)) return true;
  }
  return false;
}

void copy_samples(const Chunk& from, Chunk& to, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    to.stamps[i] = from.stamps[i].get();
    to.samples[i].store(from.samples[i].load());
  }
}

// The scope of a change that a successor can complete. Of a tree that is not shared there is no successor.
class RedoScope {
 public:
  template <class Prepare>
  RedoScope(Interrupted* entry, History& history, Interrupted::Kind kind, Prepare&& prepare) : entry_(entry) {
    if (!entry) return;
    prepare(*entry);
    entry->history.store(&history);
    entry->kind.store(kind, std::memory_order_release);
  }
  RedoScope(const RedoScope&) = delete;
  RedoScope& operator=(const RedoScope&) = delete;
  ~RedoScope() {
    if (entry_) entry_->kind.store(Interrupted::Kind::none, std::memory_order_release);
  }

 private:
  Interrupted* entry_;
};

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

Found History::View::at(Stamp stamp, Pose& pose, FrameId& parent, bool along_screw) const {
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
  const double fraction = pair.part / pair.whole;
  if (along_screw) {
    pose = along_screw_motion(from, to, fraction);
  } else {
    interpolate(from, to, fraction, pose);
  }
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

History::Directory* History::Directory::create(const HistoryStorage& storage, std::uint64_t size) {
  auto* directory = new (storage.memory.take(bytes(size), alignof(RelativePointer<Chunk>))) Directory{size - 1};
  for (std::uint64_t i = 0; i < size; ++i) {
    new (&directory->chunk(i)) RelativePointer<Chunk>;
    directory->chunk(i).store(storage.nothing, std::memory_order_relaxed);
  }
  return directory;
}

bool History::find_elsewhere(const View& samples, Stamp stamp, std::uint64_t& hint, Pair& pair) {
  if (!samples.bracket_in_chunk(stamp, hint + 1, pair)) return samples.find(stamp, pair, hint) == Found::ok;
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
  const RedoScope redo(context.storage.interrupted, *this, Interrupted::Kind::set_fixed,
                       [&](Interrupted& entry) { entry.sample.store(sample); });
  set_fixed(sample);
  return Insertion::appended;
}

void History::set_fixed(const Sample& sample) {
  fixed_.store(sample);
  end_.store(begin_ + 1, std::memory_order_release);
  parent_ = sample.parent;
  first_.store(kFirstStamp, std::memory_order_release);
  last_.store(kLastStamp, std::memory_order_release);
}

void History::reset(const HistoryContext& context, HistoryKind kind) {
  const Revision::Change change(context.revision);
  const RedoScope redo(context.storage.interrupted, *this, Interrupted::Kind::reset,
                       [&](Interrupted& entry) { entry.new_kind = kind; });
  drop_all(context.storage);
  kind_ = kind;
}

void History::clear(const HistoryContext& context) {
  if (kind_ == HistoryKind::dynamic) reset(context, HistoryKind::dynamic);
}

// Every case can be repeated from the beginning.
void History::complete(const HistoryContext& context, Interrupted& change) {
  switch (change.kind.load()) {
    case Interrupted::Kind::none: break;
    case Interrupted::Kind::put:
      shift_and_put(&change, change.first, change.next, change.end, change.stamp, change.sample.load());
      break;
    case Interrupted::Kind::set_fixed: set_fixed(change.sample.load()); break;
    case Interrupted::Kind::reset:
      drop_all(context.storage);
      kind_ = change.new_kind.get();
      break;
  }
}

void History::repair() {
  const View samples = view();
  room_end_ = room_end();
  if (kind_ != HistoryKind::dynamic) return;
  first_.store(samples.empty() ? kLastStamp : samples.time(0));
  last_.store(samples.empty() ? kFirstStamp : samples.newest());
  if (!samples.empty()) parent_ = samples.parent();
  for (std::size_t i = 1; one_parent_ && i < samples.size(); ++i) {
    if (samples.parent_at(i) != samples.parent_at(0)) one_parent_ = false;
  }
}

void History::hold_chunks() const {
  const View samples = view();
  if (samples.empty() || samples.is_static()) return;
  for (std::uint64_t n = samples.begin_ / Chunk::kSize; n <= (samples.end_ - 1) / Chunk::kSize; ++n) {
    ChunkHeader::of(chunk_at(n * Chunk::kSize))->holders.store(1);
  }
}

bool History::has_room(const HistoryStorage& storage) const {
  if (kind_ == HistoryKind::dynamic && end_ != room_end_) return true;
  if (!storage.pool.has_room(next_length())) return false;
  const std::uint64_t size = directory_.load() ? 2 * (directory_.known()->mask + 1) : kFirstDirectory;
  return !must_grow() || storage.memory.has_room(Directory::bytes(size) + Memory::kAlignment);
}

std::uint64_t History::chunk_count() const {
  const View samples = view();
  if (samples.empty() || samples.is_static()) return 0;
  return (samples.end_ - 1) / Chunk::kSize - samples.begin_ / Chunk::kSize + 1;
}

void History::drop_oldest_chunk(ChunkPool& pool) { drop_before(pool, (begin_ / Chunk::kSize + 1) * Chunk::kSize); }

void History::copy(const HistoryContext& context, const History& other, std::size_t max_samples) {
  const View samples = other.view();
  kind_ = samples.kind_;
  if (samples.empty()) return;
  if (samples.is_static()) return set_fixed(samples.sample(0));
  const std::size_t size = samples.size();
  for (std::size_t i = size - std::min(size, max_samples); i < size; ++i)
    append(context, samples.time(i), samples.sample(i));
  one_parent_ = other.one_parent_.get();
}

void History::share(const HistoryStorage& storage, const History& other) {
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
  Directory* copy = Directory::create(storage, samples.directory_->mask + 1);
  for (std::uint64_t n = samples.begin_ / Chunk::kSize; n <= (samples.end_ - 1) / Chunk::kSize; ++n) {
    Chunk* chunk = other.chunk_at(n * Chunk::kSize);
    if (!mapped_) ChunkHeader::of(chunk)->holders.fetch_add(1, std::memory_order_relaxed);
    copy->chunk(n).store(chunk, std::memory_order_relaxed);
  }
  directory_.store(copy);
}

void History::map(const HistoryStorage& storage, const Chunk* chunks, std::uint64_t samples, bool one_parent,
                  const Span& span) {
  const std::uint64_t count = (samples + Chunk::kSize - 1) / Chunk::kSize;
  Directory* directory = Directory::create(storage, std::bit_ceil(std::max<std::uint64_t>(count, 1)));
  // Mapped chunks are never written: their tree is frozen.
  auto* first = const_cast<Chunk*>(chunks);
  for (std::uint64_t n = 0; n < count; ++n) directory->chunk(n).store(first + n, std::memory_order_relaxed);
  directory_.store(directory);
  kind_ = HistoryKind::dynamic;
  one_parent_ = one_parent;
  mapped_ = true;
  end_ = samples;
  first_ = span.first;
  last_ = span.last;
  parent_ = span.parent;
}

void History::release(const HistoryStorage& storage) { drop_all(storage); }

void History::append(const HistoryContext& context, Stamp stamp, const Sample& sample) {
  const std::uint64_t index = end_;
  if (index == room_end_) extend(context);
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
    if (start == room_end_) extend(context);
    Chunk& chunk = *chunk_at(start);
    const std::size_t first = start % Chunk::kSize, most = std::min<std::size_t>(count - stored, room_end_ - start);
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
  const std::uint64_t first = begin_ + position, end = end_;
  if (end == room_end_) extend(context);
  const Revision::Change change(context.revision);
  own_chunks(context.storage.pool, first, end + 1);
  Interrupted* progress = context.storage.interrupted;
  const RedoScope redo(progress, *this, Interrupted::Kind::put, [&](Interrupted& entry) {
    entry.first = first;
    entry.end = end;
    entry.next.store(end, std::memory_order_release);
    entry.stamp = stamp;
    entry.sample.store(sample);
  });
  shift_and_put(progress, first, end, end, stamp, sample);
}

// With `progress`, the change can be continued after any step: a sample is intact until the next one is done.
void History::shift_and_put(Interrupted* progress, std::uint64_t first, std::uint64_t last, std::uint64_t end,
                            Stamp stamp, const Sample& sample) {
  for (; last > first; --last) {
    if (progress) progress->next.store(last, std::memory_order_release);
    const Chunk& from = *chunk_at(last - 1);
    const std::size_t i = (last - 1) % Chunk::kSize;
    put(last, from.stamps[i], from.samples[i].load());
  }
  if (progress) progress->next.store(first, std::memory_order_release);
  put(first, stamp, sample);
  if (first == begin_) first_.store(stamp, std::memory_order_release);
  end_.store(end + 1, std::memory_order_release);
}

bool History::must_grow() const {
  const Directory* directory = directory_.load(std::memory_order_relaxed);
  return !directory || end_ / Chunk::kSize - begin_ / Chunk::kSize > directory->mask;
}

// The first chunk of a frame starts short. Later ones do not: a reader that is too late never sees a short one where it
// expects a full one.
std::size_t History::next_length() const {
  const auto next_longer = std::upper_bound(kChunkLengths.begin(), kChunkLengths.end(), end_.load());
  return next_longer == kChunkLengths.end() ? Chunk::kSize : *next_longer;
}

// Adds a chunk, or replaces a short one by a longer one.
void History::extend(const HistoryContext& context) {
  const Revision::Change change(context.revision);
  if (must_grow()) grow(context.storage);
  Chunk* chunk = context.storage.pool.take(next_length());
  RelativePointer<Chunk>& entry = directory_.known()->chunk(end_ / Chunk::kSize);
  if (const std::size_t count = end_ % Chunk::kSize; count != 0) {
    Chunk* old_chunk = entry.known();
    copy_samples(*old_chunk, *chunk, count);
    entry.store(chunk);
    context.storage.pool.release(old_chunk);
  } else {
    entry.store(chunk);
  }
  room_end_ = end_ / Chunk::kSize * Chunk::kSize + ChunkHeader::of(chunk)->length;
}

// Copies chunks that are shared with a snapshot before they change.
void History::own_chunks(ChunkPool& pool, std::uint64_t first, std::uint64_t end) {
  for (std::uint64_t n = first / Chunk::kSize; n <= (end - 1) / Chunk::kSize; ++n) {
    Chunk* shared_chunk = chunk_at(n * Chunk::kSize);
    const ChunkHeader& header = *ChunkHeader::of(shared_chunk);
    if (header.holders.load(std::memory_order_acquire) == 1) continue;
    Chunk* own_chunk = pool.take(header.length);
    copy_samples(*shared_chunk, *own_chunk, header.length);
    directory_.known()->chunk(n).store(own_chunk);
    pool.release(shared_chunk);
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
    pool.release(chunk_at(n * Chunk::kSize));
  }
}

// The next sample starts a new chunk.
void History::drop_all(const HistoryStorage& storage) {
  const std::uint64_t end = end_;
  if (kind_ == HistoryKind::dynamic && end > begin_ && !mapped_) {
    for (std::uint64_t n = begin_ / Chunk::kSize; n <= (end - 1) / Chunk::kSize; ++n) {
      Chunk* chunk = chunk_at(n * Chunk::kSize);
      if (chunk == storage.nothing) continue;  // dropped by a writer that died
      directory_.known()->chunk(n).store(storage.nothing);
      storage.pool.release(chunk);
    }
  }
  const std::uint64_t next = (end + Chunk::kSize - 1) / Chunk::kSize * Chunk::kSize;
  room_end_ = next;
  begin_.store(next, std::memory_order_release);
  end_.store(next, std::memory_order_release);
  first_.store(kLastStamp, std::memory_order_release);
  last_.store(kFirstStamp, std::memory_order_release);
  one_parent_ = true;
}

// After the death of a writer.
std::uint64_t History::room_end() const {
  const std::uint64_t end = end_, filled = end % Chunk::kSize;
  if (kind_ != HistoryKind::dynamic || filled == 0) return end;
  return end - filled + ChunkHeader::of(chunk_at(end))->length;
}

void History::grow(const HistoryStorage& storage) {
  const Directory* old = directory_.load();
  Directory* larger = Directory::create(storage, old ? 2 * (old->mask + 1) : kFirstDirectory);
  if (old) {
    for (std::uint64_t n = begin_ / Chunk::kSize, i = 0; i <= old->mask; ++n, ++i) {
      larger->chunk(n).store(old->chunk(n).known(), std::memory_order_relaxed);
    }
  }
  directory_.store(larger);
}

}  // namespace coframe
