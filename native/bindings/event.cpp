// SPDX-License-Identifier: Apache-2.0
#include "wire/event.hpp"

#include <nanobind/stl/optional.h>

#include <memory>
#include <optional>

#include "bindings/bindings.hpp"

namespace coframe::bindings {

void define_event(nb::module_& module) {
  nb::class_<Event>(module, "Event",
                    "A flag that DDS threads and Python set, and one thread waits for without the GIL.")
      .def(nb::init<>())
      .def("set", &Event::set, "Sets the flag and wakes the waiting thread.")
      .def("clear", &Event::clear, "Takes the flag back.")
      .def(
          "wait",
          [](Event& event, std::optional<std::int64_t> timeout_ns) {
            return wait_with_signals(timeout_ns.value_or(-1), [&](std::int64_t slice) { return event.wait(slice); });
          },
          nb::arg("timeout_ns") = nb::none(),
          "Waits until set (True, and cleared) or for timeout_ns nanoseconds (False); None waits for ever.");
}

}  // namespace coframe::bindings
