// SPDX-License-Identifier: Apache-2.0
// Insertions: single transforms, arrays, serialized messages.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include "bindings/bindings.hpp"
#include "bindings/buffer_parts.hpp"
#include "bindings/failure.hpp"
#include "bindings/fast_call.hpp"
#include "bindings/transform.hpp"

namespace coframe::bindings {

namespace {

// Returns (refusals, stored rows, first rejected row).
nb::tuple set_rows(BufferObject& self, std::string_view parent, std::string_view child, nb::handle stamps,
                   nb::handle poses, bool is_static, nb::handle authority) {
  const Memory times(stamps, PyBUF_C_CONTIGUOUS), places(poses, PyBUF_C_CONTIGUOUS);
  const std::size_t count = times.size() / sizeof(Stamp);
  const Track track{parent, child, count, times.data<const Stamp>(), rows_of(places, 7, count)};
  self.stop_sharing();
  const AuthorityId authority_id = self.authority(authority.ptr());
  std::size_t stored, bad_row;
  unsigned refusals;
  const auto run = [&] { refusals = self.core->insert_many(track, is_static, authority_id, stored, bad_row); };
  if (count > kLargeBatch) {
    const WithoutGil release;
    run();
  } else {
    run();
  }
  return nb::make_tuple(refusals, stored, bad_row);
}

PyObject* py_set_values(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<12> signature(
      "_set_values", {"parent", "child", "stamp", "x", "y", "z", "qx", "qy", "qz", "qw", "static", "authority"}, 12,
      12);
  PyObject* values[12];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = buffer_of(object);
    double v[7];
    for (int i = 0; i < 7; ++i) {
      v[i] = PyFloat_AsDouble(values[3 + i]);
      if (v[i] == -1.0 && PyErr_Occurred()) return nullptr;
    }
    const Stamp stamp = to_int64(values[2]);
    const bool is_static = is_true(values[10]);
    const TransformValues transform{{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
    return PyLong_FromUnsignedLong(self.insert([&] {
      const FrameId parent = self.frame(values[0]), child = self.frame(values[1]);
      const AuthorityId authority = self.authority(values[11]);
      const bool known = parent != 0 && child != 0 && parent != child;
      return known ? self.core->insert(parent, child, stamp, transform, is_static, authority)
                   : self.core->insert(text(values[0]), text(values[1]), stamp, transform, is_static, authority);
    }));
  });
}

// The usual case of coframe.Buffer.set(): two known frames, which equal the transform's own frames if it has any, and a
// stamp.
PyObject* py_set_plain(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<5> signature("_set_plain", {"parent", "child", "transform", "stamp", "static"}, 5, 5);
  PyObject* values[5];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = buffer_of(object);
    const FrameId parent = self.frames.known(values[0]), child = self.frames.known(values[1]);
    GivenTransform given;
    const auto is = [](PyObject* name, PyObject* wanted) { return name == Py_None || name == wanted; };
    const bool is_plain = parent != 0 && child != 0 && parent != child && values[4] == Py_False &&
                          read_transform(values[2], given) && is(given.target, values[0]) &&
                          is(given.source, values[1]) && !self.core->frozen();
    const bool has_time = values[3] == Py_None ? given.has_stamp : to_int64_if_exact(values[3], given.stamp);
    if (!is_plain || !has_time) return Py_NewRef(Py_None);
    const double *p = given.pose.p, *q = given.pose.q;
    const TransformValues transform{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
    return PyLong_FromUnsignedLong(
        self.insert([&] { return self.core->insert(parent, child, given.stamp, transform, false, 0); }));
  });
}

nb::list py_insert_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp, double x,
                         double y, double z, double qx, double qy, double qz, double qw, std::string_view authority) {
  nb::list lines;
  for (const LogLine& line : refusal_texts(refusals, parent, child, stamp, {{x, y, z}, {qx, qy, qz, qw}}, authority)) {
    lines.append(nb::make_tuple(line.is_error ? "error" : "warning", line.text));
  }
  return lines;
}

PyObject* py_ingest(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<3> signature("ingest", {"cdr", "static", "authority"}, 1, 1);
  PyObject* values[3];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&] {
    BufferObject& self = buffer_of(object);
    const bool is_static = is_true(values[1]);
    self.stop_sharing();
    const AuthorityId authority = values[2] ? self.authority(values[2]) : 0;
    const Memory bytes(values[0], PyBUF_SIMPLE);
    std::size_t stored;
    DecodeFailure failure;
    {
      const nb::ft_lock_guard lock(self.ingesting);
      failure =
          self.core->ingest(self.stream(is_static, authority), bytes.data<const std::uint8_t>(), bytes.size(), stored);
    }
    if (failure.reason) raise_decode_error(failure);
    return PyLong_FromSize_t(stored);
  });
}

}  // namespace

void add_frequent_insertions(nb::handle cls) {
  add_method(cls, "_set_values", &py_set_values,
             "_set_values($self, /, parent, child, stamp, x, y, z, qx, qy, qz, qw, static, authority)\n--\n\n"
             "Store a transform from numbers; return 0, or the reasons for rejection as bits (see insert_texts).");
  add_method(cls, "_set_plain", &py_set_plain,
             "_set_plain($self, /, parent, child, transform, stamp, static)\n--\n\n"
             "Do as _set_values() for a dynamic Transform between known frames; return None for any other case.");
  add_method(cls, "ingest", &py_ingest,
             "ingest($self, /, cdr, *, static=False, authority='no recorded authority')\n--\n\n"
             R"doc(Store the transforms of a serialized tf2_msgs/msg/TFMessage, all of them or none.

Args:
    cdr: The message as CDR bytes.
    static: Whether the transforms are static, as on /tf_static.
    authority: Name of the publisher, as reports show it.

Returns:
    The number of stored transforms.

Raises:
    DecodeError: The bytes are not a TFMessage; `statistics` counts such messages.)doc");
}

void define_insertions(nb::module_& module, nb::class_<BufferObject>& cls) {
  cls.def("_set_rows", &set_rows, nb::arg("parent"), nb::arg("child"), nb::arg("stamps"), nb::arg("poses"),
          nb::arg("static"), nb::arg("authority"));
  module.def("insert_texts", &py_insert_texts, nb::arg("refusals"), nb::arg("parent"), nb::arg("child"),
             nb::arg("stamp"), nb::arg("x"), nb::arg("y"), nb::arg("z"), nb::arg("qx"), nb::arg("qy"), nb::arg("qz"),
             nb::arg("qw"), nb::arg("authority"),
             "Return tf2's log lines for a transform that _set_values rejected: (level, text).");
}

}  // namespace coframe::bindings
