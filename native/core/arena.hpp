// SPDX-License-Identifier: Apache-2.0
// A piece of memory for many things of one kind, freed as a whole.
#pragma once

#include <cstddef>

namespace coframe {

class Arena {
 public:
  static constexpr std::size_t kAlignment = 64;                // a cache line
  static constexpr std::size_t kLarge = std::size_t{2} << 20;  // a large page

  // Not initialised. For kLarge the system is asked to use a large page: filling that is many times faster than page by
  // page.
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
