// SPDX-License-Identifier: Apache-2.0
#include "core/event.hpp"

#include <chrono>

#ifdef __linux__
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <ctime>
#endif

namespace coframe {

#ifdef __linux__

// A condition variable continues to wait after a signal; a futex does not.

void Event::set() {
  if (set_.exchange(1) == 0) syscall(SYS_futex, &set_, FUTEX_WAKE_PRIVATE, 1, nullptr, nullptr, 0);
}

void Event::clear() { set_ = 0; }

bool Event::is_set() { return set_.load(std::memory_order_acquire) != 0; }

bool Event::wait(std::int64_t timeout_ns) {
  using clock = std::chrono::steady_clock;
  constexpr std::int64_t kSecond = 1'000'000'000;
  const auto end = clock::now() + std::chrono::nanoseconds(timeout_ns < 0 ? 0 : timeout_ns);
  for (;;) {
    if (set_.exchange(0) != 0) return true;
    std::timespec limit{};
    if (timeout_ns >= 0) {
      const std::int64_t remaining_ns =
          std::chrono::duration_cast<std::chrono::nanoseconds>(end - clock::now()).count();
      if (remaining_ns <= 0) return false;
      limit = {.tv_sec = remaining_ns / kSecond, .tv_nsec = remaining_ns % kSecond};
    }
    const long code = syscall(SYS_futex, &set_, FUTEX_WAIT_PRIVATE, 0, timeout_ns < 0 ? nullptr : &limit, nullptr, 0);
    if (code != 0 && errno == EINTR) return set_.exchange(0) != 0;
  }
}

#else

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

bool Event::is_set() {
  std::lock_guard lock(mutex_);
  return set_;
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

#endif

}  // namespace coframe
