// SPDX-License-Identifier: Apache-2.0
#include "core/event.hpp"

#include <nanobind/stl/optional.h>

#include <memory>
#include <optional>

#include "bindings/bindings.hpp"

namespace coframe::bindings {

void define_event(nb::module_& module) {
  nb::class_<Event>(module, "Event",
                    "A flag that DDS threads and Python set and that one thread waits for without the GIL.")
      .def(nb::init<>())
      .def("set", &Event::set, "Set the flag and wake the waiting thread.")
      .def("clear", &Event::clear, "Clear the flag.")
      .def(
          "wait",
          [](Event& event, std::optional<std::int64_t> timeout_ns) {
            // A signal that arrives immediately before the wait does not end it, so it is divided nevertheless.
            constexpr std::int64_t kSlice = Event::kEndsAtSignals ? 500'000'000 : kSignalSliceNs;
            return wait_with_signals(
                timeout_ns.value_or(-1), [&](std::int64_t slice) { return event.wait(slice); }, kSlice);
          },
          nb::arg("timeout_ns") = nb::none(),
          "Wait until the flag is set and clear it (True), or until timeout_ns has passed (False); None: no limit.");
}

}  // namespace coframe::bindings
