// SPDX-License-Identifier: Apache-2.0
// The class Buffer in Python: its construction, and changes of the whole buffer.
#include "bindings/buffer.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/string_view.h>

#include "bindings/bindings.hpp"
#include "bindings/buffer_parts.hpp"

namespace coframe::bindings {

namespace {

nb::bytes encode(const BufferObject& self, bool is_static) {
  const std::string message = self.core->encode(is_static);
  return nb::bytes(message.data(), message.size());
}

void add_frequent_methods(nb::handle cls) {
  add_frequent_lookups(cls);
  add_frequent_insertions(cls);
}

}  // namespace

void define_buffer(nb::module_& module) {
  using nb::arg;
  nb::class_<BufferObject> cls(module, "Buffer",
                               "The native buffer; coframe.Buffer is the public class derived from it.",
                               nb::is_weak_referenceable());
  cls.def(nb::init<Stamp, bool>(), arg("cache_ns"), arg("along_screws") = false)
      .def_prop_ro(
          "_along_screws", [](const BufferObject& self) { return self.core->along_screws(); },
          "Whether poses are interpolated along screws.")
      .def_prop_ro(
          "cache_ns", [](const BufferObject& self) { return self.core->cache_length(); },
          R"doc(Length of the cache for dynamic transforms in nanoseconds; negative if the buffer keeps everything.)doc")
      .def(
          "encode", &encode, nb::kw_only(), arg("static"),
          R"doc(Return the newest sample of every static, or of every dynamic, frame as the CDR bytes of one TFMessage.)doc")
      .def(
          "clear",
          [](BufferObject& self) {
            self.stop_sharing();
            self.core->clear();
          },
          R"doc(Remove all dynamic samples; frames stay known, and static transforms stay, as in tf2.)doc")
      .def(
          "remove_frame",
          [](BufferObject& self, std::string_view name) {
            self.stop_sharing();
            return self.core->remove_frame(name);
          },
          arg("name"), R"doc(Remove a frame with the edges to its parent and to its children, also static ones.

Returns:
    Whether the frame existed.)doc")
      .def(
          "freeze",
          [](BufferObject& self) {
            self.stop_sharing();
            self.core->freeze();
          },
          R"doc(Make the buffer read-only: from now on it stores nothing and removes nothing.)doc")
      .def_prop_ro(
          "frozen", [](const BufferObject& self) { return self.core->frozen(); },
          R"doc(Whether the buffer is read-only.)doc")
      .def(
          "_become_snapshot",
          [](BufferObject& self, const BufferObject& other, bool along_screws) {
            self.core = other.core->snapshot();
            self.core->set_along_screws(along_screws);
          },
          arg("other"), arg("along_screws"))
      .def("_stop_following", [](BufferObject& self) { self.core->stop_following(); })
      .def(
          "_on_local_change", [](BufferObject& self, nb::object call) { self.on_local_change = std::move(call); },
          any("call"))
      .def_prop_ro("_following", [](const BufferObject& self) { return self.core->following(); })
      .def_prop_ro("_changes", [](const BufferObject& self) { return self.core->changes(); });
  define_lookups(cls);
  define_many_lookups(cls);
  define_insertions(module, cls);
  define_state(cls);
  add_frequent_methods(cls);
  module.def(
      "register_buffer_class", [](nb::type_object_t<BufferObject> cls) { add_frequent_methods(cls); }, arg("cls"),
      "Add the most frequent methods to a subclass of Buffer as its own, because CPython calls methods of the "
      "object's own class faster.");
}

}  // namespace coframe::bindings
