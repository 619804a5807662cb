// SPDX-License-Identifier: Apache-2.0
// The memory of a tree. Its parts are never freed one by one, because readers may still use them, but all at once.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace coframe {

class Memory {
 public:
  static constexpr std::size_t kAlignment = 64;  // the largest: a cache line

  Memory() = default;
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  virtual ~Memory() = default;

  // Throws std::bad_alloc if there is no room.
  virtual void* take(std::size_t size, std::size_t alignment) = 0;
  // Returns whether that many bytes can be taken.
  virtual bool has_room(std::size_t size) = 0;

  template <class T, class... Arguments>
  T* make(Arguments&&... arguments) {
    return new (take(sizeof(T), alignof(T))) T(std::forward<Arguments>(arguments)...);
  }
  template <class T>
  T* make_array(std::size_t count) {
    T* first = static_cast<T*>(take(count * sizeof(T), alignof(T)));
    for (std::size_t i = 0; i < count; ++i) new (first + i) T;
    return first;
  }
};

// Blocks on the heap of this process.
class HeapMemory final : public Memory {
 public:
  void* take(std::size_t size, std::size_t alignment) override {
    if (size > kBlock / 4) return add_block(size);
    std::size_t start = (used_ + alignment - 1) / alignment * alignment;
    if (!current_ || start + size > kBlock) {
      current_ = add_block(kBlock);
      start = 0;
    }
    used_ = start + size;
    return current_ + start;
  }
  bool has_room(std::size_t) override { return true; }

 private:
  static constexpr std::size_t kBlock = 4096;
  struct Free {
    void operator()(std::byte* block) const { ::operator delete(block, std::align_val_t{kAlignment}); }
  };

  std::byte* add_block(std::size_t size) {
    blocks_.emplace_back(static_cast<std::byte*>(::operator new(size, std::align_val_t{kAlignment})));
    return blocks_.back().get();
  }

  std::vector<std::unique_ptr<std::byte, Free>> blocks_;
  std::byte* current_ = nullptr;
  std::size_t used_ = 0;  // of the current block
};

}  // namespace coframe
