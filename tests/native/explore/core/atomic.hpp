// SPDX-License-Identifier: Apache-2.0
// Replaces native/core/atomic.hpp in explore.cpp: before every access, another thread of the explorer may run.
#pragma once

#include <atomic>

namespace coframe {

// Set while threads are explored.
inline void (*before_access)() = nullptr;

template <class T>
class Atomic {
 public:
  Atomic() = default;
  Atomic(T value) : value_(value) {}
  Atomic(const Atomic&) = delete;

  T load(std::memory_order = std::memory_order_seq_cst) const {
    if (before_access) before_access();
    return value_;
  }
  void store(T value, std::memory_order = std::memory_order_seq_cst) {
    if (before_access) before_access();
    value_ = value;
  }
  operator T() const { return load(); }
  Atomic& operator=(T value) {
    store(value);
    return *this;
  }
  T fetch_add(T more, std::memory_order = std::memory_order_seq_cst) {
    if (before_access) before_access();
    const T before = value_;
    value_ = before + more;
    return before;
  }
  T fetch_sub(T less, std::memory_order order = std::memory_order_seq_cst) { return fetch_add(T{} - less, order); }

 private:
  T value_{};
};

}  // namespace coframe
