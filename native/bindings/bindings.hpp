// SPDX-License-Identifier: Apache-2.0
// Shared by all binding files: one `define_*` function per topic, and waiting that reacts to Ctrl-C.
#pragma once

#include <nanobind/nanobind.h>

#include <algorithm>
#include <chrono>
#include <cstdint>

#include "bindings/gil.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

void define_transform(nb::module_& module);
void define_arguments(nb::module_& module);
void define_buffer(nb::module_& module);
void define_waiting(nb::module_& module);
void define_messages(nb::module_& module);
void define_poses(nb::module_& module);
void define_relay(nb::module_& module);
void define_frozen(nb::module_& module);
void define_failure(nb::module_& module);
void define_message_codec(nb::module_& module);
void define_event(nb::module_& module);
void define_lie(nb::module_& module);
void define_robots(nb::module_& module);
void define_sensors(nb::module_& module);
void define_shared(nb::module_& module);
void define_bags(nb::module_& module);
void define_wire(nb::module_& module);
void define_middleware(nb::module_& module);

// An argument that may be None, because the functions themselves report what a frame name or a stamp must be.
inline auto any(const char* name) { return nb::arg(name).none(); }

// Python runs signal handlers only between waits, so the main thread splits long waits into slices of this length.
inline constexpr std::int64_t kSignalSliceNs = 50'000'000;

// Calls `wait(slice_ns)` without the GIL until it returns true or `timeout_ns` (negative: no limit) has passed. Raises
// the exception of a signal handler, KeyboardInterrupt above all. The caller must hold the GIL.
template <class Wait>
bool wait_with_signals(std::int64_t timeout_ns, Wait&& wait, std::int64_t main_slice_ns = kSignalSliceNs) {
  using clock = std::chrono::steady_clock;
  constexpr std::int64_t kLong = 3'600'000'000'000;
  const auto start = clock::now();
  const auto left = [&]() -> std::int64_t {
    if (timeout_ns < 0) return kLong;
    const auto elapsed = std::chrono::duration_cast<std::chrono::nanoseconds>(clock::now() - start).count();
    return std::clamp<std::int64_t>(timeout_ns - elapsed, 0, kLong);
  };
  // Only the main thread runs signal handlers; other threads need not take the GIL in between.
  const std::int64_t longest = is_main_thread() ? main_slice_ns : kLong;
  for (;;) {
    bool done;
    {
      WithoutGil release;
      done = wait(std::min(longest, left()));
    }
    if (PyErr_CheckSignals() != 0) throw nb::python_error();
    // `wait` may also return early without success: only the clock decides when the time is over.
    if (done || left() == 0) return done;
  }
}

}  // namespace coframe::bindings
