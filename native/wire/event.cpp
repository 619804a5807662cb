// SPDX-License-Identifier: Apache-2.0
#include "wire/event.hpp"

#include <chrono>

namespace coframe {

void Event::set() {
  {
    std::lock_guard lock(mutex_);
    set_ = true;
  }
  condition_.notify_one();
}

void Event::clear() {
  std::lock_guard lock(mutex_);
  set_ = false;
}

bool Event::wait(std::int64_t timeout_ns) {
  std::unique_lock lock(mutex_);
  auto is_set = [this] { return set_; };
  if (timeout_ns < 0) {
    condition_.wait(lock, is_set);
  } else if (!condition_.wait_for(lock, std::chrono::nanoseconds(timeout_ns), is_set)) {
    return false;
  }
  set_ = false;
  return true;
}

}  // namespace coframe
