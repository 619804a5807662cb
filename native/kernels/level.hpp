// SPDX-License-Identifier: Apache-2.0
// Declares the kernels of one processor level. Each source file of the kernels is compiled once per level, with the
// namespace COFRAME_LEVEL and the name COFRAME_LEVEL_NAME; without these macros, as level `plain`, for the processor
// that the compiler targets by default. entries.inc lists all kernels.
//
// Kernels are either plain loops over short arrays, which compilers vectorise, or use Lanes. Products and sums may be
// contracted (-ffp-contract=fast) if the processor has fused multiply-add: results of levels then differ in the last
// bits. Kernels may use nothing from other headers except plain data and libm: the linker keeps one copy of an inline
// function for the whole program, and that copy could contain instructions that not every processor has. For the same
// reason, everything in the headers of the kernels is in an anonymous namespace and always inlined, and the definition
// of the interpolation, core/interpolation.inc, is included inside that namespace.
#pragma once

#include "kernels/kernels.hpp"

#ifndef COFRAME_LEVEL
#define COFRAME_LEVEL plain
#define COFRAME_LEVEL_NAME "plain"
#endif

#if defined(__GNUC__)
#define COFRAME_INLINE [[gnu::always_inline]] inline  // a call inside a loop would prevent vectorisation
#else
#define COFRAME_INLINE inline
#endif

// Defined when compiling with ThreadSanitizer; see lanes.hpp.
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
