// SPDX-License-Identifier: Apache-2.0
// Transform trees that several processes share.
#include "shared/segment.hpp"

#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <memory>
#include <string>
#include <utility>

#include "bindings/bindings.hpp"
#include "bindings/buffer.hpp"

namespace coframe::bindings {

void define_shared(nb::module_& module) {
  using nb::arg;
  using ReleaseGil = nb::call_guard<WithoutGil>;
  nb::exception<SegmentError>(module, "SegmentError", PyExc_OSError);
  nb::class_<Segment>(module, "Segment", "A transform tree in memory that the processes of one user share.")
      .def_static(
          "open",
          [](const std::string& folder, const std::string& name, Stamp cache_ns) {
            return Segment::open(folder, name, cache_ns);
          },
          arg("folder"), arg("name"), arg("cache_ns"), ReleaseGil(),
          "Open a tree, or create it; raise SegmentError if sharing is not possible here.")
      .def(
          "follow",
          [](Segment& self, BufferObject& buffer, const std::string& authority) {
            SharedTreeData tree = self.reader();
            tree.authority = authority;
            return buffer.core->follow(std::move(tree));
          },
          arg("buffer"), arg("authority") = "",
          "Let an empty buffer read the tree from now on; return False if it is not empty. With an authority, that is "
          "the source of all transforms.")
      .def("try_to_write", &Segment::try_to_write, "Become the writer if there is none; return whether it is.")
      .def(
          "write",
          [](Segment& self, BufferObject& buffer) {
            try {
              buffer.core = std::make_shared<Buffer>(self.writer());
            } catch (const std::bad_alloc&) {
              throw SegmentError("the shared memory is full: " + self.shortage());
            }
          },
          arg("buffer"), "Let a new buffer write the tree, after try_to_write() has succeeded.")
      .def_prop_ro("writer_process", &Segment::writer_process, "The process that writes, or wrote last.")
      .def(
          "wait_for_vacancy",
          [](Segment& self, std::int64_t timeout_ns) {
            const WithoutGil release;
            self.wait_for_vacancy(timeout_ns);
          },
          arg("timeout_ns"), "Wait until there may be no writer, an interrupt, or the timeout (negative: no limit).")
      .def("interrupt", &Segment::interrupt, "End the wait of another thread.")
      .def_prop_ro("outdated", &Segment::outdated,
                   "Whether the tree contains static transforms that are no longer published.")
      .def_prop_ro("used", &Segment::used, "Bytes in use.")
      .def_prop_ro("lost", &Segment::lost, "Whether another program has truncated the memory.")
      .def_prop_ro("shortage", &Segment::shortage, "Why the tree could not grow; empty if it could.")
      .def("close", &Segment::close, ReleaseGil(), "Stop writing, and no longer keep the tree.");
}

}  // namespace coframe::bindings
