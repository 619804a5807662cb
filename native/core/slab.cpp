#include "core/slab.hpp"

#include <array>
#include <mutex>
#include <new>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace coframe {

namespace {

// Large slabs that were freed last, for the next who want one: the system takes longer to clear them than we to fill
// them.
struct Spare {
  std::mutex mutex;
  std::array<std::byte*, 4> slabs;
  std::size_t count = 0;
};

Spare& spare() {
  static Spare& spare = *new Spare;  // for buffers that outlive everything else, too
  return spare;
}

std::byte* allocate(std::size_t size, std::size_t alignment) {
  return static_cast<std::byte*>(::operator new(size, std::align_val_t{alignment}));
}

std::byte* allocate_large() {
  Spare& kept = spare();
  const std::lock_guard lock(kept.mutex);
  if (kept.count > 0) return kept.slabs[--kept.count];
  std::byte* data = allocate(Slab::kLarge, Slab::kLarge);
#if defined(MADV_HUGEPAGE)
  madvise(data, Slab::kLarge, MADV_HUGEPAGE);  // where that fails, it is only slower
#endif
  return data;
}

void free_large(std::byte* data) {
  Spare& kept = spare();
  const std::lock_guard lock(kept.mutex);
  if (kept.count < kept.slabs.size()) {
    kept.slabs[kept.count++] = data;
  } else {
    ::operator delete(data, std::align_val_t{Slab::kLarge});
  }
}

}  // namespace

Slab::Slab(std::size_t size)
    : is_large_(size == kLarge), data_(is_large_ ? allocate_large() : allocate(size, kAlignment)) {}

Slab::~Slab() {
  if (is_large_) {
    free_large(data_);
  } else {
    ::operator delete(data_, std::align_val_t{kAlignment});
  }
}

}  // namespace coframe
