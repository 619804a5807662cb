// SPDX-License-Identifier: Apache-2.0
// The storage of samples: chunks of a few sizes that are not returned to the system while their pool exists. A reader
// that is too late reads old or wrong numbers, which it detects by the revision, but never foreign memory.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>
#include <vector>

#include "core/arena.hpp"
#include "core/atomic.hpp"
#include "core/memory.hpp"
#include "core/pose.hpp"
#include "core/relative_pointer.hpp"
#include "core/relaxed_atomic.hpp"

namespace coframe {

using FrameId = std::uint32_t;  // 0 is tf2's NO_PARENT
using Stamp = std::int64_t;     // nanoseconds; 0 requests the latest

// Seconds as tf2 computes them: its texts and rates contain the rounding of this sum.
inline double to_seconds(Stamp stamp) {
  constexpr Stamp second = 1'000'000'000;
  return static_cast<double>(stamp / second) + 1e-9 * static_cast<double>(stamp % second);
}

// Returns the distance of any two stamps.
inline std::uint64_t distance(Stamp a, Stamp b) {
  const auto first = static_cast<std::uint64_t>(a), second = static_cast<std::uint64_t>(b);
  return a < b ? second - first : first - second;
}

// Returns the signed difference; wraps around on overflow.
inline std::int64_t elapsed(Stamp from, Stamp to) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

// A pose and the parent frame that it is relative to.
struct Sample {
  Pose pose;
  FrameId parent = 0;
};

// A sample that may be read while it is written. It fills a cache line.
class alignas(64) SharedSample {
 public:
  // Loads directly into the destination: a temporary copy would cost more than the load.
  void load(Pose& pose) const {
    for (int i = 0; i < 4; ++i) pose.q[i] = numbers_[i];
    for (int i = 0; i < 3; ++i) pose.p[i] = numbers_[4 + i];
  }
  // The quaternion, the translation and the parent, for kernels that load all of them at once; kernels/lanes.hpp
  // explains why they may.
  const double* numbers() const { return reinterpret_cast<const double*>(this); }
  double* numbers() { return reinterpret_cast<double*>(this); }
  Sample load() const {
    Sample sample;
    load(sample.pose);
    sample.parent = parent();
    return sample;
  }
  void store(const Sample& sample) {
    for (int i = 0; i < 4; ++i) numbers_[i] = sample.pose.q[i];
    for (int i = 0; i < 3; ++i) numbers_[4 + i] = sample.pose.p[i];
    parent_.store(sample.parent, std::memory_order_release);
  }
  // A reader that sees the id of a frame also sees the frame.
  FrameId parent() const { return parent_.load(std::memory_order_acquire); }

 private:
  std::array<RelaxedAtomic<double>, 7> numbers_;
  Atomic<FrameId> parent_{0};
};
static_assert(sizeof(SharedSample) == 64);

// The layout in memory is also the layout in a frozen file.
struct Chunk {
  // Large enough that insertions rarely allocate.
  static constexpr std::size_t kSize = 256;

  std::array<RelaxedAtomic<Stamp>, kSize> stamps;
  std::array<SharedSample, kSize> samples;
};
static_assert(sizeof(Chunk) == Chunk::kSize * (sizeof(Stamp) + sizeof(SharedSample)));

// The numbers of samples that a chunk may have room for. The first chunk of a frame starts with the fewest and is
// replaced by the next longer one: large trees have many frames that move slowly or for a short time.
inline constexpr std::array<std::size_t, 3> kChunkLengths{12, 32, Chunk::kSize};

// What precedes a chunk that belongs to a pool. Of a chunk that is not full, only the first stamps and the first
// samples belong to it; other chunks may lie in between.
struct alignas(64) ChunkHeader {
  explicit ChunkHeader(std::size_t length) : length(static_cast<std::uint32_t>(length)) {}

  Atomic<std::uint32_t> holders{0};       // the history that contains the chunk and its snapshots
  const std::uint32_t length;             // one of kChunkLengths
  RelativePointer<ChunkHeader> previous;  // in a ChunkList

  Chunk* chunk() { return reinterpret_cast<Chunk*>(this + 1); }
  static ChunkHeader* of(Chunk* chunk) { return reinterpret_cast<ChunkHeader*>(chunk) - 1; }
  static constexpr std::size_t samples_start() { return sizeof(ChunkHeader) + offsetof(Chunk, samples); }
  static constexpr std::size_t bytes(std::size_t length) { return samples_start() + length * sizeof(SharedSample); }
  // Returns the smallest distance of chunks with that length of which no two overlap.
  static constexpr std::size_t distance(std::size_t length) {
    std::size_t distance = alignof(ChunkHeader);
    while (overlap(length, distance)) distance += alignof(ChunkHeader);
    return distance;
  }
  // Creates a chunk with its header at the start of `bytes(length)` bytes of memory.
  static ChunkHeader* create(void* memory, std::size_t length) {
    auto* header = new (memory) ChunkHeader(length);
    std::uninitialized_value_construct_n(reinterpret_cast<RelaxedAtomic<Stamp>*>(header + 1), length);
    auto* samples = static_cast<std::byte*>(memory) + samples_start();
    std::uninitialized_value_construct_n(reinterpret_cast<SharedSample*>(samples), length);
    return header;
  }

 private:
  static constexpr bool overlap(std::size_t length, std::size_t distance) {
    const std::size_t head = sizeof(ChunkHeader) + length * sizeof(Stamp), end = bytes(length);
    if (distance < head || distance < length * sizeof(SharedSample)) return true;
    for (std::size_t start = distance; start < end; start += distance) {
      if (start + head > samples_start()) return true;
    }
    return false;
  }
};
static_assert(ChunkHeader::bytes(Chunk::kSize) == sizeof(ChunkHeader) + sizeof(Chunk));
static_assert(ChunkHeader::distance(kChunkLengths.front()) < 1024);
static_assert(std::is_trivially_destructible_v<ChunkHeader> && std::is_trivially_destructible_v<Chunk>);

// All chunks of a shared tree, so that the next writer finds those that no history contains.
using ChunkList = RelativePointer<ChunkHeader>;

class ChunkPool {
 public:
  ChunkPool() = default;
  // Takes the chunks from `memory`, which may have no room for another one.
  ChunkPool(Memory& memory, ChunkList& all) : memory_(&memory), all_(&all) {}

  // Returns whether take() will return a chunk.
  bool has_room(std::size_t length) {
    if (!memory_) return true;
    const std::lock_guard lock(mutex_);
    return !supply(length).free.empty() || memory_->has_room(kReserve + ChunkHeader::bytes(length));
  }

  // Returns a chunk with one holder. The caller must announce the change to readers (Revision::Change), which may still
  // be reading the chunk as part of another history. Throws std::bad_alloc if there is no room.
  Chunk* take(std::size_t length) {
    const std::lock_guard lock(mutex_);
    auto& free = supply(length).free;
    ChunkHeader* header = free.empty() ? create_chunk(length) : free.back();
    if (!free.empty()) free.pop_back();
    header->holders.store(1, std::memory_order_relaxed);
    return header->chunk();
  }

  void release(Chunk* chunk) {
    ChunkHeader* header = ChunkHeader::of(chunk);
    if (header->holders.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    const std::lock_guard lock(mutex_);
    supply(header->length).free.push_back(header);
  }

  // For a pool with a list: sets which chunks are free, after `mark` has counted the holders of all others.
  template <class Mark>
  void rebuild(Mark&& mark) {
    const std::lock_guard lock(mutex_);
    for (Supply& each : supplies_) each.free.clear();
    for (ChunkHeader* chunk = all_->load(); chunk; chunk = chunk->previous.load()) chunk->holders.store(0);
    mark();
    for (ChunkHeader* chunk = all_->load(); chunk; chunk = chunk->previous.load()) {
      if (chunk->holders.load() == 0) supply(chunk->length).free.push_back(chunk);
    }
  }

 private:
  // The chunks of one length.
  struct Supply {
    std::vector<ChunkHeader*> free;
    std::vector<std::unique_ptr<Arena>> arenas;
    std::size_t count = 0;                // number of chunks
    std::size_t used = 0, last_size = 0;  // of the last arena
  };

  // Small buffers take little memory; large ones use large pages.
  static constexpr std::size_t kFewChunks = 16;
  // Chunks leave this much of a limited memory for the names and the directories of new frames.
  static constexpr std::size_t kReserve = 4 << 20;

  Supply& supply(std::size_t length) {
    const auto found = std::find(kChunkLengths.begin(), kChunkLengths.end(), length);
    return supplies_[static_cast<std::size_t>(found - kChunkLengths.begin())];
  }

  ChunkHeader* create_chunk(std::size_t length) {
    const std::size_t bytes = ChunkHeader::bytes(length);
    if (memory_) {
      auto* chunk = ChunkHeader::create(memory_->take(bytes, alignof(ChunkHeader)), length);
      chunk->previous.store(all_->load());
      all_->store(chunk);
      return chunk;
    }
    Supply& chunks = supply(length);
    const std::size_t distance = ChunkHeader::distance(length), rest = bytes - distance;
    if (chunks.used == chunks.last_size) {
      const std::size_t large_arena_count = (Arena::kLarge - rest) / distance;
      const std::size_t size =
          chunks.count < kFewChunks ? std::max<std::size_t>(3 * chunks.count, 1) : large_arena_count;
      chunks.arenas.push_back(
          std::make_unique<Arena>(size == large_arena_count ? Arena::kLarge : size * distance + rest));
      chunks.last_size = size;
      chunks.used = 0;
    }
    ++chunks.count;
    return ChunkHeader::create(chunks.arenas.back()->data() + chunks.used++ * distance, length);
  }

  Memory* memory_ = nullptr;  // if set, the chunks are in it and in this list
  ChunkList* all_ = nullptr;
  std::mutex mutex_;  // snapshots may be destroyed in any thread
  std::array<Supply, kChunkLengths.size()> supplies_;
};

}  // namespace coframe
