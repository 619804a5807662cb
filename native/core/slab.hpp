// A piece of memory for many things of one kind, freed as a whole.
#pragma once

#include <cstddef>

namespace coframe {

class Slab {
 public:
  // As large as a large page of the processor.
  static constexpr std::size_t kLarge = std::size_t{2} << 20;

  // Aligned to a cache line; where kLarge is asked for to a large page, which the system is asked to use: filling that is
  // many times faster than page by page. Not initialised.
  explicit Slab(std::size_t size);
  Slab(const Slab&) = delete;
  Slab& operator=(const Slab&) = delete;
  ~Slab();

  std::byte* data() const { return data_; }

 private:
  std::size_t alignment_;
  std::byte* data_;
};

}  // namespace coframe
