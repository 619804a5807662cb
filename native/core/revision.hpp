// SPDX-License-Identifier: Apache-2.0
// A sequence lock: readers detect that what they read changed in the meantime. They take no lock, so no reader ever
// blocks a writer.
#pragma once

#include <cstdint>

#include "core/atomic.hpp"

namespace coframe {

class Revision {
 public:
  // Returns an odd number while a change is in progress. What is read after an even one is consistent if unchanged()
  // returns true afterwards.
  std::uint64_t number() const { return number_.load(std::memory_order_acquire); }
  bool unchanged(std::uint64_t since) const {
    std::atomic_thread_fence(std::memory_order_acquire);
    return number_.load(std::memory_order_relaxed) == since;
  }

  // The scope in which the only writer changes what readers may be reading. Must not be nested.
  class Change {
   public:
    explicit Change(Revision& revision) : revision_(revision) {
      revision_.raise(std::memory_order_relaxed);
      std::atomic_thread_fence(std::memory_order_release);
    }
    Change(const Change&) = delete;
    Change& operator=(const Change&) = delete;
    ~Change() { revision_.raise(std::memory_order_release); }

   private:
    Revision& revision_;
  };

  // For a writer that continues the work of one that died: ends the change that was in progress.
  void complete() {
    if (number() % 2 != 0) raise(std::memory_order_release);
  }
  // No read is consistent from now on, because the data are lost.
  void invalidate() { number_.store(number() | 1, std::memory_order_release); }
  // Before there are readers: starts at an even number that no other revision is likely to have.
  void start_at(std::uint64_t number) { number_.store(number & ~std::uint64_t{1}, std::memory_order_relaxed); }

 private:
  void raise(std::memory_order order) { number_.store(number_.load(std::memory_order_relaxed) + 1, order); }

  Atomic<std::uint64_t> number_{0};  // an odd number while a change is in progress
};

}  // namespace coframe
