// SPDX-License-Identifier: Apache-2.0
// An atomic value with relaxed memory order: one thread writes it while others read it, and each read returns one of
// the values written, with no ordering relative to the surrounding code.
#pragma once

#include "core/atomic.hpp"

namespace coframe {

template <class T>
class RelaxedAtomic {
 public:
  RelaxedAtomic() = default;
  explicit RelaxedAtomic(T value) : value_(value) {}

  T get() const { return value_.load(std::memory_order_relaxed); }
  operator T() const { return get(); }
  void set(T value) { value_.store(value, std::memory_order_relaxed); }
  RelaxedAtomic& operator=(T value) {
    set(value);
    return *this;
  }
  // Not a single atomic operation: for the only writer.
  void add(T value) { set(get() + value); }

 private:
  Atomic<T> value_{};
};

}  // namespace coframe
