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
bool is_here() {
  return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt") && __builtin_cpu_supports("avx2") &&
         __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
}  // namespace x86_64_v3

namespace x86_64_v4 {
extern const Kernels table;
bool is_here() {
  return x86_64_v3::is_here() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}
}  // namespace x86_64_v4
#endif

std::vector<const Kernels*> all_kernels() {
  std::vector<const Kernels*> all{&plain::table};
#ifdef COFRAME_X86_LEVELS
  __builtin_cpu_init();
  if (x86_64_v3::is_here()) all.push_back(&x86_64_v3::table);
  if (x86_64_v4::is_here()) all.push_back(&x86_64_v4::table);
#endif
  return all;
}

namespace {

const Kernels& choose() {
  const std::vector<const Kernels*> all = all_kernels();
  const char* wanted = std::getenv("COFRAME_CPU_LEVEL");
  if (!wanted || !*wanted) return *all.back();
  std::string names;
  for (const Kernels* each : all) {
    if (std::string_view(each->level) == wanted) return *each;
    names += (names.empty() ? "" : ", ") + std::string(each->level);
  }
  throw std::runtime_error("COFRAME_CPU_LEVEL is " + std::string(wanted) + ", but this processor has " + names);
}

}  // namespace

const Kernels& kernels() {
  static const Kernels& chosen = choose();
  return chosen;
}

}  // namespace coframe
