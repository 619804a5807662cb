// SPDX-License-Identifier: Apache-2.0
// What is compiled once for each level of the processor, as COFRAME_LEVEL, with the name COFRAME_LEVEL_NAME: without
// both for the least that the compiler is asked for, as `plain`. A family of kernels a file; entries.inc lists them
// all.
//
// Either plain loops over short arrays, which compilers turn into vector instructions, or Lanes. Products and sums may
// be contracted (-ffp-contract=fast), where the processor can do both at once: results of levels then differ in the
// last bits. And nothing here may come from a header but plain data and libm: of an inline function the linker keeps
// one copy for the whole program, and it could be this one, with instructions that not every processor has. What
// headers of kernels define has no name outside of the file and is always inlined.
#pragma once

#include "kernels/kernels.hpp"

#ifndef COFRAME_LEVEL
#define COFRAME_LEVEL plain
#define COFRAME_LEVEL_NAME "plain"
#endif

#if defined(__GNUC__)
#define COFRAME_INLINE \
  [[gnu::always_inline]] inline  // a call in a loop would keep it from becoming vector instructions
#else
#define COFRAME_INLINE inline
#endif

// ThreadSanitizer watches: see lanes.hpp.
#if defined(__SANITIZE_THREAD__)
#define COFRAME_CHECKS_THREADS
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define COFRAME_CHECKS_THREADS
#endif
#endif

namespace coframe::COFRAME_LEVEL {

#define COFRAME_KERNEL(result, name, parameters) result name parameters;
#include "kernels/entries.inc"
#undef COFRAME_KERNEL

}  // namespace coframe::COFRAME_LEVEL
