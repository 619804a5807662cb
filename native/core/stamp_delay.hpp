// SPDX-License-Identifier: Apache-2.0
// How far a publisher's stamps are behind the receiver's clock: the lower quartile of its last messages. Transport only
// ever adds delay, so the minimum would be the best estimate, but single stamps may be wildly wrong.
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
  // Returns whether there are enough messages for an estimate.
  bool known() const { return count_ >= kSamples; }
  // Returns the typical delay in nanoseconds; negative if the stamps are ahead. Requires at least one message.
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
