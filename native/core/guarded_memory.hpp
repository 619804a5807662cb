// SPDX-License-Identifier: Apache-2.0
// Files that are mapped into memory, and that another program may truncate. The system ends a process that reads behind
// the new end (SIGBUS). While its memory is guarded, it reads zeros instead, and the trees in the memory fail.
#pragma once

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/revision.hpp"

namespace coframe {

// A file was truncated.
struct LostMemory : std::runtime_error {
  enum class Kind { frozen, shared };

  LostMemory(Kind kind, const std::string& text) : std::runtime_error(text), kind(kind) {}
  const Kind kind;
};

// Guards a mapping for the lifetime of this object. Where the system does not allow that a mapped file is truncated, it
// does nothing.
class GuardedMemory {
 public:
  // `start` is the beginning of a page. `loss` is thrown by reads of the memory once it is lost.
  GuardedMemory(void* start, std::size_t size, LostMemory loss);
  GuardedMemory(const GuardedMemory&) = delete;
  GuardedMemory& operator=(const GuardedMemory&) = delete;
  ~GuardedMemory();

  // Once the memory is lost, the whole mapping contains zeros, and this process no longer shares it.
  bool lost() const { return lost_.load(std::memory_order_acquire); }
  void check() const {
    if (lost()) throw loss_;
  }
  // The readers of a tree detect the loss by its revision, which may be in the memory.
  void add(Revision& revision);
  void remove(Revision& revision);

 private:
  friend struct Guards;
  bool contains(const void* address) const;
  bool lose();

  void* const start_;
  const std::size_t size_;
  const LostMemory loss_;
  std::atomic<bool> lost_{false};
  std::vector<Revision*> revisions_;
};

}  // namespace coframe
