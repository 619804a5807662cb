// SPDX-License-Identifier: Apache-2.0
#include "kernels/levels.hpp"

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

namespace coframe {

namespace plain {
extern const Kernels table;
}

#ifdef COFRAME_X86_LEVELS
// Each level checks the features that CMakeLists.txt compiles it with.
namespace x86_64_v3 {
extern const Kernels table;
bool is_supported() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("avx2") &&
         __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
}  // namespace x86_64_v3

namespace x86_64_v4 {
extern const Kernels table;
bool is_supported() {
  return x86_64_v3::is_supported() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
}  // namespace x86_64_v4
#endif

std::vector<const Kernels*> all_kernels() {
  std::vector<const Kernels*> kernels{&plain::table};
#ifdef COFRAME_X86_LEVELS
  __builtin_cpu_init();
  if (x86_64_v3::is_supported()) kernels.push_back(&x86_64_v3::table);
  if (x86_64_v4::is_supported()) kernels.push_back(&x86_64_v4::table);
#endif
  return kernels;
}

namespace {

const Kernels& choose() {
  const std::vector<const Kernels*> kernels = all_kernels();
  const char* requested_level = std::getenv("COFRAME_CPU_LEVEL");
  if (!requested_level || !*requested_level) return *kernels.back();
  std::string names;
  for (const Kernels* each : kernels) {
    if (std::string_view(each->level) == requested_level) return *each;
    names += (names.empty() ? "" : ", ") + std::string(each->level);
  }
  throw std::runtime_error("COFRAME_CPU_LEVEL is " + std::string(requested_level) + ", but this processor has " +
                           names);
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& best_kernels = choose();
  return best_kernels;
}

}  // namespace coframe
