// SPDX-License-Identifier: Apache-2.0
// Where samples lie: blocks of a fixed size, never given back to the system while their pool lives, so that a reader
// who comes too late reads old or wrong numbers, which its revision tells it, and never foreign memory.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <new>
#include <type_traits>
#include <vector>

#include "core/arena.hpp"
#include "core/pose.hpp"
#include "core/relaxed_atomic.hpp"

namespace coframe {

using FrameId = std::uint32_t;  // 0 is tf2's NO_PARENT
using Stamp = std::int64_t;     // nanoseconds; 0 asks for the latest

// How far apart two stamps are, whatever they are.
inline std::uint64_t distance(Stamp a, Stamp b) {
  const auto first = static_cast<std::uint64_t>(a), second = static_cast<std::uint64_t>(b);
  return a < b ? second - first : first - second;
}

// From one to the other; wraps around where it is too far for a number.
inline std::int64_t elapsed(Stamp from, Stamp to) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

// A pose and the frame it is told in.
struct Sample {
  Pose pose;
  FrameId parent = 0;
};

// A sample that readers may read while it is written: a cache line.
class alignas(64) SharedSample {
 public:
  // Straight to where it is needed: a copy on the way costs more than the rest.
  void load(Pose& pose) const {
    for (int i = 0; i < 4; ++i) pose.q[i] = numbers_[i];
    for (int i = 0; i < 3; ++i) pose.p[i] = numbers_[4 + i];
  }
  // For kernels, which take it whole: see kernels/lanes.hpp for why they may. q, p, and the parent.
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
  // Who reads a frame's number finds the frame.
  FrameId parent() const { return parent_.load(std::memory_order_acquire); }

 private:
  std::array<RelaxedAtomic<double>, 7> numbers_;
  std::atomic<FrameId> parent_{0};
};
static_assert(sizeof(SharedSample) == 64);

// As it lies in memory it also lies in a frozen file.
struct Chunk {
  // Large enough that inserting seldom needs a new one, small enough for a tree of a thousand frames.
  static constexpr std::size_t kSize = 256;

  std::array<RelaxedAtomic<Stamp>, kSize> stamps;
  std::array<SharedSample, kSize> samples;
};
static_assert(sizeof(Chunk) == Chunk::kSize * (sizeof(Stamp) + sizeof(SharedSample)));

struct PooledChunk : Chunk {
  std::atomic<std::uint32_t> holders{0};  // histories it is part of: one, and its snapshots
};

class ChunkPool {
 public:
  // Held once. The caller must tell readers (Revision::Change): they may still be reading it as part of another
  // history.
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

 private:
  // A few samples take little memory, many are in large pages.
  static constexpr std::size_t kFew = 16, kMany = Arena::kLarge / sizeof(PooledChunk);

  PooledChunk* fresh() {
    if (used_ == last_size_) {
      const std::size_t size = count_ < kFew ? std::max<std::size_t>(3 * count_, 1) : kMany;
      arenas_.push_back(std::make_unique<Arena>(size == kMany ? Arena::kLarge : size * sizeof(PooledChunk)));
      last_size_ = size;
      used_ = 0;
    }
    ++count_;
    return new (arenas_.back()->data() + used_++ * sizeof(PooledChunk)) PooledChunk;
  }

  std::mutex mutex_;  // a snapshot may end in any thread
  std::vector<std::unique_ptr<Arena>> arenas_;
  std::size_t count_ = 0;                 // of all chunks
  std::size_t used_ = 0, last_size_ = 0;  // of the last slab
  std::vector<PooledChunk*> free_;
};
static_assert(std::is_trivially_destructible_v<PooledChunk>);

}  // namespace coframe
