// SPDX-License-Identifier: Apache-2.0
#include "core/arena.hpp"

#include <array>
#include <cstdint>
#include <mutex>
#include <new>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace coframe {

namespace {

// The large arenas that were freed last, kept for reuse: the system takes longer to clear a large page than the caller
// takes to fill it.
struct SpareArenas {
  std::mutex mutex;
  std::array<std::byte*, 4> arenas;
  std::size_t count = 0;
};

SpareArenas& spare_arenas() {
  static SpareArenas& spare_arenas = *new SpareArenas;  // never destroyed: buffers may outlive static objects
  return spare_arenas;
}

std::byte* allocate(std::size_t size, std::size_t alignment) {
  return static_cast<std::byte*>(::operator new(size, std::align_val_t{alignment}));
}

// Mapped directly where the system allows it: the heap would keep what it cuts off before and after an aligned block,
// up to half as much memory again.
#if __has_include(<sys/mman.h>)
std::byte* map_large() {
  void* mapping = mmap(nullptr, 2 * Arena::kLarge, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapping == MAP_FAILED) throw std::bad_alloc();
  auto* start = static_cast<std::byte*>(mapping);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(start) % Arena::kLarge;
  if (before > 0) munmap(start, before);
  munmap(start + before + Arena::kLarge, Arena::kLarge - before);
#if defined(MADV_HUGEPAGE)
  madvise(start + before, Arena::kLarge, MADV_HUGEPAGE);  // a failure only costs speed
#endif
  return start + before;
}
void unmap_large(std::byte* data) { munmap(data, Arena::kLarge); }
#else
std::byte* map_large() { return allocate(Arena::kLarge, Arena::kLarge); }
void unmap_large(std::byte* data) { ::operator delete(data, std::align_val_t{Arena::kLarge}); }
#endif

std::byte* allocate_large() {
  SpareArenas& spares = spare_arenas();
  const std::lock_guard lock(spares.mutex);
  return spares.count > 0 ? spares.arenas[--spares.count] : map_large();
}

void free_large(std::byte* data) {
  SpareArenas& spares = spare_arenas();
  const std::lock_guard lock(spares.mutex);
  if (spares.count < spares.arenas.size()) {
    spares.arenas[spares.count++] = data;
  } else {
    unmap_large(data);
  }
}

}  // namespace

Arena::Arena(std::size_t size)
    : is_large_(size == kLarge), data_(is_large_ ? allocate_large() : allocate(size, kAlignment)) {}

Arena::~Arena() {
  if (is_large_) {
    free_large(data_);
  } else {
    ::operator delete(data_, std::align_val_t{kAlignment});
  }
}

}  // namespace coframe
