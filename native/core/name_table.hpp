// SPDX-License-Identifier: Apache-2.0
// A hash table from names to numbers. One thread adds, any number of threads look up without a lock. The names
// themselves are stored elsewhere.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

namespace coframe {

class NameTable {
 public:
  static constexpr std::uint32_t kNone = 0xffffffff;

  NameTable() { grow(64); }
  NameTable(const NameTable&) = delete;
  NameTable& operator=(const NameTable&) = delete;

  // `name_of` returns the name of a number.
  template <class NameOf>
  std::uint32_t find(std::string_view name, NameOf&& name_of) const {
    const std::uint32_t hash = hash_of(name);
    const Slots& slots = *current_.load(std::memory_order_acquire);
    for (std::uint32_t i = hash;; ++i) {
      const Entry entry = slots.entries[i & slots.mask].load(std::memory_order_acquire);
      if (entry == kFree) return kNone;
      if (entry >> 32 == hash && name_of(number_of(entry)) == name) return number_of(entry);
    }
  }

  // Adds a name that is not in the table yet. name_of(number) must already return it.
  void add(std::string_view name, std::uint32_t number) {
    const Slots* slots = current_.load(std::memory_order_relaxed);
    if (++count_ * 2 > slots->mask) slots = grow((slots->mask + 1) * 2);
    put(*slots, static_cast<Entry>(hash_of(name)) << 32 | (number + 1));
  }

 private:
  using Entry = std::uint64_t;  // hash, and number + 1
  static constexpr Entry kFree = 0;

  struct Slots {
    explicit Slots(std::uint32_t size) : mask(size - 1), entries(new std::atomic<Entry>[size] {}) {}
    std::uint32_t mask;
    std::unique_ptr<std::atomic<Entry>[]> entries;
  };

  static std::uint32_t hash_of(std::string_view name) {
    return static_cast<std::uint32_t>(std::hash<std::string_view>{}(name) * 0x9e3779b97f4a7c15u >> 32);
  }
  static std::uint32_t number_of(Entry entry) { return static_cast<std::uint32_t>(entry) - 1; }

  static void put(const Slots& slots, Entry entry) {
    auto i = static_cast<std::uint32_t>(entry >> 32);
    while (slots.entries[i & slots.mask].load(std::memory_order_relaxed) != kFree) ++i;
    slots.entries[i & slots.mask].store(entry, std::memory_order_release);
  }

  const Slots* grow(std::uint32_t size) {
    auto larger = std::make_unique<Slots>(size);
    if (const Slots* smaller = current_.load(std::memory_order_relaxed)) {
      for (std::uint32_t i = 0; i <= smaller->mask; ++i) {
        const Entry entry = smaller->entries[i].load(std::memory_order_relaxed);
        if (entry != kFree) put(*larger, entry);
      }
    }
    slots_.push_back(std::move(larger));  // readers may still use the smaller tables, which are kept
    current_.store(slots_.back().get(), std::memory_order_release);
    return slots_.back().get();
  }

  std::vector<std::unique_ptr<Slots>> slots_;
  std::atomic<const Slots*> current_{nullptr};
  std::uint32_t count_ = 0;
};

}  // namespace coframe
