// SPDX-License-Identifier: Apache-2.0
// The usual period of a publisher: the median interval between the arrivals of its last messages.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace coframe {

class ArrivalPeriod {
 public:
  static constexpr std::size_t kSamples = 15;

  // `now`: the time of arrival in nanoseconds of a monotonic clock, above 0.
  void add(std::int64_t now) {
    if (last_ != 0) intervals_[count_++ % kSamples] = now - last_;
    last_ = now;
  }
  // In nanoseconds; 0 with fewer than two messages.
  std::int64_t median() const {
    if (count_ == 0) return 0;
    auto sorted = intervals_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kSamples));
    const auto middle = sorted.begin() + (end - sorted.begin()) / 2;
    std::nth_element(sorted.begin(), middle, end);
    return *middle;
  }

 private:
  std::array<std::int64_t, kSamples> intervals_{};
  std::size_t count_ = 0;
  std::int64_t last_ = 0;
};

}  // namespace coframe
