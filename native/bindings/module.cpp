// SPDX-License-Identifier: Apache-2.0
// The private module coframe._core. The public API is the Python package around it.
#include "bindings/bindings.hpp"

NB_MODULE(_core, module) {
  using namespace coframe::bindings;
  nb::set_leak_warnings(false);  // threads that are alive at exit keep their objects
  guard_exit();
  module.doc() = "The native core of coframe. Private: use `import coframe`.";
  define_transform(module);
  define_failure(module);
  define_arguments(module);
  define_buffer(module);
  define_waiting(module);
  define_messages(module);
  define_poses(module);
  define_relay(module);
  define_frozen(module);
  define_message_codec(module);
  define_event(module);
  define_lie(module);
  define_robots(module);
  define_sensors(module);
  define_shared(module);
  define_bags(module);
  define_wire(module);
  define_middleware(module);
}
