// SPDX-License-Identifier: Apache-2.0
// A hash table from names to numbers. One thread adds, any number of threads look up without a lock. The names
// themselves are stored elsewhere.
#pragma once

#include <cstdint>
#include <cstring>
#include <functional>
#include <string_view>

#include "core/memory.hpp"
#include "core/relative_pointer.hpp"

namespace coframe {

// A name in the memory of a tree.
class Name {
 public:
  // Set once, before readers see it.
  void set(Memory& memory, std::string_view name) {
    char* text = static_cast<char*>(memory.take(name.size() + 1, 1));
    std::memcpy(text, name.data(), name.size());
    text[name.size()] = '\0';
    size_ = static_cast<std::uint32_t>(name.size());
    text_.store(text);
  }
  std::string_view view() const {
    const char* text = text_.load();
    return text ? std::string_view(text, size_) : std::string_view();
  }
  operator std::string_view() const { return view(); }

 private:
  RelativePointer<const char> text_;
  std::uint32_t size_ = 0;
};

class NameTable {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  NameTable() = default;
  NameTable(const NameTable&) = delete;
  NameTable& operator=(const NameTable&) = delete;

  // `name_of` returns the name of a number.
  template <class NameOf>
  std::uint32_t find(std::string_view name, NameOf&& name_of) const {
    const std::uint32_t hash = hash_of(name);
    const Slots* slots = current_.load();
    if (!slots) return kNone;
    for (std::uint32_t i = hash;; ++i) {
      const Entry entry = slots->entries()[i & slots->mask].load(std::memory_order_acquire);
      if (entry == kFree) return kNone;
      if (entry >> 32 == hash && name_of(number_of(entry)) == name) return number_of(entry);
    }
  }

  // Adds a name that is not in the table yet. name_of(number) must already return it.
  void add(Memory& memory, std::string_view name, std::uint32_t number) {
    Slots* slots = current_.load(std::memory_order_relaxed);
    if (!slots) slots = grow(memory, kFirstSize);
    if (++count_ * 2 > slots->mask) slots = grow(memory, (slots->mask + 1) * 2);
    put(*slots, static_cast<Entry>(hash_of(name)) << 32 | (number + 1));
  }

  // Identifies the hash function: processes that share a table must use the same one.
  static std::uint32_t hash_of(std::string_view name) {
    return static_cast<std::uint32_t>(std::hash<std::string_view>{}(name) * 0x9e3779b97f4a7c15u >> 32);
  }

 private:
  using Entry = std::uint64_t;  // hash, and number + 1
  static constexpr Entry kFree = 0;
  static constexpr std::uint32_t kFirstSize = 64;

  struct Slots {
    std::uint32_t mask;
    // The entries follow.
    Atomic<Entry>* entries() { return reinterpret_cast<Atomic<Entry>*>(this + 1); }
    const Atomic<Entry>* entries() const { return reinterpret_cast<const Atomic<Entry>*>(this + 1); }
    std::uint32_t padding = 0;
  };

  static std::uint32_t number_of(Entry entry) { return static_cast<std::uint32_t>(entry) - 1; }

  static void put(Slots& slots, Entry entry) {
    auto i = static_cast<std::uint32_t>(entry >> 32);
    while (slots.entries()[i & slots.mask].load(std::memory_order_relaxed) != kFree) ++i;
    slots.entries()[i & slots.mask].store(entry, std::memory_order_release);
  }

  Slots* grow(Memory& memory, std::uint32_t size) {
    void* place = memory.take(sizeof(Slots) + size * sizeof(Atomic<Entry>), alignof(Atomic<Entry>));
    auto* larger = new (place) Slots{size - 1};
    for (std::uint32_t i = 0; i < size; ++i) new (&larger->entries()[i]) Atomic<Entry>(kFree);
    if (const Slots* smaller = current_.load(std::memory_order_relaxed)) {
      for (std::uint32_t i = 0; i <= smaller->mask; ++i) {
        const Entry entry = smaller->entries()[i].load(std::memory_order_relaxed);
        if (entry != kFree) put(*larger, entry);
      }
    }
    current_.store(larger);  // readers may still use the smaller one
    return larger;
  }

  RelativePointer<Slots> current_;
  std::uint32_t count_ = 0;
};

}  // namespace coframe
