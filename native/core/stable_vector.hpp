// SPDX-License-Identifier: Apache-2.0
// A vector that only grows and whose elements never move. One thread appends, any number of threads read without a
// lock.
#pragma once

#include <array>
#include <bit>
#include <cstddef>

#include "core/memory.hpp"
#include "core/relative_pointer.hpp"

namespace coframe {

template <class T>
class StableVector {
 public:
  StableVector() = default;
  StableVector(const StableVector&) = delete;
  StableVector& operator=(const StableVector&) = delete;

  std::size_t size() const { return size_.load(std::memory_order_acquire); }

  // For an index below a size() that was read earlier.
  T& operator[](std::size_t index) { return at(index); }
  const T& operator[](std::size_t index) const { return at(index); }

  // For any index: nullptr if nothing was ever appended there.
  T* find(std::size_t index) const {
    const std::size_t number = segment_of(index);
    if (number >= kSegments) return nullptr;
    T* segment = segments_[number].load();
    return segment ? segment + (index - first_of(number)) : nullptr;
  }

  // Appends an element; `prepare` fills it before readers see it.
  template <class Prepare>
  std::size_t append(Memory& memory, Prepare&& prepare) {
    const std::size_t index = size_.load(std::memory_order_relaxed);
    const std::size_t number = segment_of(index);
    if (!segments_[number].load(std::memory_order_relaxed)) {
      segments_[number].store(memory.make_array<T>(kFirst << number));
    }
    prepare((*this)[index]);
    size_.store(index + 1, std::memory_order_release);
    return index;
  }

 private:
  static constexpr std::size_t kFirst = 32;  // elements of the first segment; each further segment is twice as large
  static constexpr std::size_t kSegments = 27;

  T& at(std::size_t index) const {
    const std::size_t number = segment_of(index);
    return segments_[number].known()[index - first_of(number)];
  }
  static std::size_t segment_of(std::size_t index) { return std::bit_width(index / kFirst + 1) - 1; }
  static std::size_t first_of(std::size_t segment) { return kFirst * ((std::size_t{1} << segment) - 1); }

  std::array<RelativePointer<T>, kSegments> segments_{};
  Atomic<std::size_t> size_{0};
};

}  // namespace coframe
