// SPDX-License-Identifier: Apache-2.0
// Changes take microseconds. A reader that finds one in progress waits for its end, but only for a limited time: the
// writer may be suspended.
#pragma once

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <utility>

namespace coframe {

// A change did not end in time; the text says whose.
struct UnfinishedChange : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// How long the reads of this thread wait for the end of a change, during a scope.
class ChangeTimeout {
 public:
  static constexpr std::int64_t kMax = 2'000'000'000;  // nanoseconds; also outside of such scopes

  // `timeout_ns` is how long the caller of the read is willing to wait; 0 means that it did not say.
  explicit ChangeTimeout(std::int64_t timeout_ns)
      : before_(std::exchange(current_, timeout_ns > 0 ? std::min(timeout_ns, kMax) : kMax)) {}
  ~ChangeTimeout() { current_ = before_; }
  ChangeTimeout(const ChangeTimeout&) = delete;
  ChangeTimeout& operator=(const ChangeTimeout&) = delete;

  static std::int64_t current() { return current_; }

 private:
  static inline thread_local std::int64_t current_ = kMax;
  const std::int64_t before_;
};

}  // namespace coframe
