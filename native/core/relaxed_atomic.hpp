// SPDX-License-Identifier: Apache-2.0
// A value that one thread writes while others read it: each read gets one of the values written, in no order that the
// code around it does not give.
#pragma once

#include <atomic>

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
  // Not an atomic step: for the one thread that writes.
  void add(T value) { set(get() + value); }

 private:
  std::atomic<T> value_{};
};

}  // namespace coframe
