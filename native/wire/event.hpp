// SPDX-License-Identifier: Apache-2.0
// A flag that threads wait for: set by DDS threads and by Python, consumed by one waiter at a time.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace coframe {

class Event {
 public:
  void set();
  void clear();
  // Waits until the event is set or `timeout_ns` has passed (negative: no limit). If it was set, clears it and returns
  // true.
  bool wait(std::int64_t timeout_ns);

 private:
  std::mutex mutex_;
  std::condition_variable condition_;
  bool set_ = false;
};

}  // namespace coframe
