#include "core/slab.hpp"

#include <new>

#if __has_include(<sys/mman.h>)
#include <sys/mman.h>
#endif

namespace coframe {

Slab::Slab(std::size_t size)
    : alignment_(size == kLarge ? kLarge : 64),
      data_(static_cast<std::byte*>(::operator new(size, std::align_val_t{alignment_}))) {
#if defined(MADV_HUGEPAGE)
  if (size == kLarge) madvise(data_, size, MADV_HUGEPAGE);  // without, it is only slower
#endif
}

Slab::~Slab() { ::operator delete(data_, std::align_val_t{alignment_}); }

}  // namespace coframe
