// SPDX-License-Identifier: Apache-2.0
// A mutex for short critical sections that are entered millions of times: one atomic operation to lock and one to
// unlock while there is no contention. Threads that must wait sleep.
#pragma once

#include <atomic>
#include <cstdint>

namespace coframe {

class LightMutex {
 public:
  LightMutex() = default;
  LightMutex(const LightMutex&) = delete;
  LightMutex& operator=(const LightMutex&) = delete;

  void lock() {
    std::uint32_t free = kFree;
    if (!state_.compare_exchange_strong(free, kHeld, std::memory_order_acquire)) wait();
  }

  // Also a full barrier: loads after it (memory_order_seq_cst) happen after the data of the critical section are
  // visible.
  void unlock() {
    if (state_.exchange(kFree, std::memory_order_seq_cst) == kWanted) state_.notify_one();
  }

 private:
  static constexpr std::uint32_t kFree = 0, kHeld = 1, kWanted = 2;  // kWanted: held, and a thread may be sleeping

  void wait() {
    while (state_.exchange(kWanted, std::memory_order_acquire) != kFree) {
      state_.wait(kWanted, std::memory_order_relaxed);
    }
  }

  std::atomic<std::uint32_t> state_{kFree};
};

}  // namespace coframe
