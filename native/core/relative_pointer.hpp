// SPDX-License-Identifier: Apache-2.0
// A pointer that is stored as the distance from itself. Memory that contains both ends is therefore valid at every
// address, and processes can map it where they have room. One thread writes it while others read it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/atomic.hpp"

namespace coframe {

template <class T>
class RelativePointer {
 public:
  RelativePointer() = default;
  RelativePointer(const RelativePointer&) = delete;
  RelativePointer& operator=(const RelativePointer&) = delete;

  // Returns nullptr if nothing was stored.
  T* load(std::memory_order order = std::memory_order_acquire) const {
    const std::ptrdiff_t distance = distance_.load(order);
    return distance == 0 ? nullptr : at(distance);
  }
  // For a pointer that is known to be set.
  T* known(std::memory_order order = std::memory_order_acquire) const { return at(distance_.load(order)); }
  void store(T* target, std::memory_order order = std::memory_order_release) {
    const auto distance = reinterpret_cast<std::uintptr_t>(target) - reinterpret_cast<std::uintptr_t>(this);
    distance_.store(target ? static_cast<std::ptrdiff_t>(distance) : 0, order);
  }

 private:
  T* at(std::ptrdiff_t distance) const {
    return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(this) + static_cast<std::uintptr_t>(distance));
  }

  Atomic<std::ptrdiff_t> distance_{0};
};

}  // namespace coframe
