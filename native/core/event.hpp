// SPDX-License-Identifier: Apache-2.0
// A flag that threads wait for: set by DDS threads and by Python, consumed by one waiter at a time. On Linux it has no
// lock, so a forked child can use an event that other threads of its parent use.
#pragma once

#include <cstdint>

#ifdef __linux__
#include <atomic>
#else
#include <condition_variable>
#include <mutex>
#endif

namespace coframe {

class Event {
 public:
  // Whether a signal ends `wait` early, so that Python need not look for signals periodically.
#ifdef __linux__
  static constexpr bool kEndsAtSignals = true;
#else
  static constexpr bool kEndsAtSignals = false;
#endif

  void set();
  void clear();
  bool is_set();
  // Waits until the event is set or `timeout_ns` has passed (negative: no limit). If it was set, clears it and returns
  // true. Returns false after the timeout or a signal.
  bool wait(std::int64_t timeout_ns);

 private:
#ifdef __linux__
  std::atomic<std::uint32_t> set_ = 0;
#else
  std::mutex mutex_;
  std::condition_variable condition_;
  bool set_ = false;
#endif
};

}  // namespace coframe
