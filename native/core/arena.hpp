// SPDX-License-Identifier: Apache-2.0
// A block of memory for many objects of one kind that is freed as a whole.
#pragma once

#include <cstddef>

namespace coframe {

class Arena {
 public:
  static constexpr std::size_t kAlignment = 64;                // a cache line
  static constexpr std::size_t kLarge = std::size_t{2} << 20;  // a large page

  // The memory is not initialized. A block of kLarge bytes is requested as one large page, which is filled many times
  // faster than small pages.
  explicit Arena(std::size_t size);
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  ~Arena();

  std::byte* data() const { return data_; }

 private:
  bool is_large_;
  std::byte* data_;
};

}  // namespace coframe
