// SPDX-License-Identifier: Apache-2.0
// How far a source's stamps are behind the clock of whoever receives them: the lower quartile of the last messages. The
// way only ever adds to it, which the least would show best, were it not for single stamps that are wild.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace coframe {

class StampDelay {
 public:
  static constexpr std::size_t kSamples = 15;

  void add(std::int64_t nanoseconds) {
    last_[count_ % kSamples] = nanoseconds;
    ++count_;
  }
  // Whether there are enough to tell.
  bool known() const { return count_ >= kSamples; }
  // Negative: the stamps are ahead. Of those that are there, one at least.
  std::int64_t typical() const {
    auto sorted = last_;
    const auto end = sorted.begin() + static_cast<std::ptrdiff_t>(std::min(count_, kSamples));
    const auto quartile = sorted.begin() + (end - sorted.begin()) / 4;
    std::nth_element(sorted.begin(), quartile, end);
    return *quartile;
  }

 private:
  std::array<std::int64_t, kSamples> last_{};
  std::size_t count_ = 0;
};

}  // namespace coframe
