// SPDX-License-Identifier: Apache-2.0
// The storage of samples: chunks of a fixed size that are not returned to the system while their pool exists. A reader
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
  // Large enough that insertions rarely allocate, small enough for a tree of a thousand frames.
  static constexpr std::size_t kSize = 256;

  std::array<RelaxedAtomic<Stamp>, kSize> stamps;
  std::array<SharedSample, kSize> samples;
};
static_assert(sizeof(Chunk) == Chunk::kSize * (sizeof(Stamp) + sizeof(SharedSample)));

struct PooledChunk : Chunk {
  Atomic<std::uint32_t> holders{0};       // the history that contains the chunk and its snapshots
  RelativePointer<PooledChunk> previous;  // in a ChunkList
};

// All chunks of a shared tree, so that the next writer finds those that no history contains.
using ChunkList = RelativePointer<PooledChunk>;

class ChunkPool {
 public:
  ChunkPool() = default;
  // Takes the chunks from `memory`, which may have no room for another one.
  ChunkPool(Memory& memory, ChunkList& all) : memory_(&memory), all_(&all) {}

  // Returns whether take() will return a chunk.
  bool has_room() {
    if (!memory_) return true;
    const std::lock_guard lock(mutex_);
    return !free_.empty() || memory_->has_room(kReserve + sizeof(PooledChunk));
  }

  // Returns a chunk with one holder. The caller must announce the change to readers (Revision::Change), which may still
  // be reading the chunk as part of another history. Throws std::bad_alloc if there is no room.
  PooledChunk* take() {
    const std::lock_guard lock(mutex_);
    PooledChunk* chunk = free_.empty() ? fresh() : free_.back();
    if (!free_.empty()) free_.pop_back();
    chunk->holders.store(1, std::memory_order_relaxed);
    return chunk;
  }

  void release(PooledChunk* chunk) {
    if (chunk->holders.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
    const std::lock_guard lock(mutex_);
    free_.push_back(chunk);
  }

  // For a pool with a list: sets which chunks are free, after `mark` has counted the holders of all others.
  template <class Mark>
  void rebuild(Mark&& mark) {
    const std::lock_guard lock(mutex_);
    free_.clear();
    for (PooledChunk* chunk = all_->load(); chunk; chunk = chunk->previous.load()) chunk->holders.store(0);
    mark();
    for (PooledChunk* chunk = all_->load(); chunk; chunk = chunk->previous.load()) {
      if (chunk->holders.load() == 0) free_.push_back(chunk);
    }
  }

 private:
  // Small buffers take little memory; large ones use large pages.
  static constexpr std::size_t kFew = 16, kMany = Arena::kLarge / sizeof(PooledChunk);
  // Chunks leave this much of a limited memory for the names and the directories of new frames.
  static constexpr std::size_t kReserve = 4 << 20;

  PooledChunk* fresh() {
    if (memory_) {
      auto* chunk = memory_->make<PooledChunk>();
      chunk->previous.store(all_->load());
      all_->store(chunk);
      return chunk;
    }
    if (used_ == last_size_) {
      const std::size_t size = count_ < kFew ? std::max<std::size_t>(3 * count_, 1) : kMany;
      arenas_.push_back(std::make_unique<Arena>(size == kMany ? Arena::kLarge : size * sizeof(PooledChunk)));
      last_size_ = size;
      used_ = 0;
    }
    ++count_;
    return new (arenas_.back()->data() + used_++ * sizeof(PooledChunk)) PooledChunk;
  }

  Memory* memory_ = nullptr;  // if set, the chunks are in it and in this list
  ChunkList* all_ = nullptr;
  std::mutex mutex_;  // snapshots may be destroyed in any thread
  std::vector<std::unique_ptr<Arena>> arenas_;
  std::size_t count_ = 0;                 // number of chunks
  std::size_t used_ = 0, last_size_ = 0;  // of the last arena
  std::vector<PooledChunk*> free_;
};
static_assert(std::is_trivially_destructible_v<PooledChunk>);

}  // namespace coframe
