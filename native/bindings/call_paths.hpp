// SPDX-License-Identifier: Apache-2.0
// The path caches of a Python buffer.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>

#include "bindings/identity_cache.hpp"
#include "core/paths.hpp"

namespace coframe::bindings {

// With the GIL, one cache that it guards. Without it, each thread begins its search for a free cache at another one, so
// threads that look up at the same time rarely share the memory of a cache.
class CallPaths {
 public:
  // Calls `use` with a cache that no other thread uses. Returns false if all of them are in use: the lookup then walks
  // through the tree.
  template <class Use>
  bool with(Use&& use) {
    if constexpr (!kFreeThreaded) {
      return use(caches_[0].paths);
    } else {
      const std::size_t first = thread_number();
      for (std::size_t i = 0; i < kCaches; ++i) {
        const PathLease lease(caches_[(first + i) % kCaches].paths);
        if (PathCache* paths = lease.get()) return use(*paths);
      }
      return false;
    }
  }

 private:
  static constexpr std::size_t kCaches = kFreeThreaded ? 16 : 1;
  struct alignas(kFreeThreaded ? 64 : alignof(PathCache)) Cache {  // one cache line each
    PathCache paths;
  };

  static std::size_t thread_number() {
    static std::atomic<std::size_t> next = 0;
    thread_local const std::size_t number = next.fetch_add(1, std::memory_order_relaxed);
    return number;
  }

  std::array<Cache, kCaches> caches_;
};

}  // namespace coframe::bindings
