// SPDX-License-Identifier: Apache-2.0
#include "bindings/arguments.hpp"

#include <cstdint>

#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

nb::handle time_module;  // coframe.time converts what is neither int nor None

// Most programs use the same few literals as durations. Never destroyed: Python ends earlier.
auto& known_durations = *new IdentityCache<std::int64_t, 64>;

std::int64_t converted(const char* function, nb::handle given) {
  const CallingPython call;
  return to_int64(time_module.attr(function)(given));
}

// Whether coframe.time.duration_ns refuses the int: 2 is two nanoseconds, but its caller means two seconds.
bool is_meant_as_seconds(std::int64_t nanoseconds) { return nanoseconds > 0 && nanoseconds < 100'000; }

}  // namespace

BufferObject& buffer_of(nb::handle object) {
  if (!nb::inst_ready(object)) throw nb::type_error("the buffer was not initialized: __init__ was not called");
  return *nb::inst_ptr<BufferObject>(object);
}

std::string_view text(nb::handle name) {
  if (!PyUnicode_Check(name.ptr())) {
    PyErr_Format(PyExc_TypeError, "a frame name must be str, not %s", Py_TYPE(name.ptr())->tp_name);
    throw nb::python_error();
  }
  Py_ssize_t size;
  const char* data = PyUnicode_AsUTF8AndSize(name.ptr(), &size);
  if (!data) throw nb::python_error();
  return {data, static_cast<std::size_t>(size)};
}

std::int64_t to_int64(nb::handle number) {
  std::int64_t quick;
  if (to_int64_if_exact(number.ptr(), quick)) return quick;
  int overflow;
  const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0) {
    PyErr_Format(PyExc_OverflowError, "%R does not fit into 64-bit nanoseconds, which range from 1677 to 2262",
                 number.ptr());
  }
  if (PyErr_Occurred()) throw nb::python_error();
  return value;
}

Stamp to_stamp(nb::handle stamp) {
  if (stamp.is_none()) return 0;
  if (PyLong_CheckExact(stamp.ptr())) return to_int64(stamp);
  return converted("stamp_ns", stamp);
}

std::int64_t to_duration(nb::handle duration) {
  if (duration.is_none()) return 0;
  std::int64_t nanoseconds;
  if (to_int64_if_exact(duration.ptr(), nanoseconds) && !is_meant_as_seconds(nanoseconds)) return nanoseconds;
  if (PyUnicode_CheckExact(duration.ptr())) {
    return known_durations.find(duration.ptr(), [](PyObject* text) { return converted("duration_ns", text); });
  }
  return converted("duration_ns", duration);
}

bool is_true(PyObject* object) {
  const int is_true = object ? PyObject_IsTrue(object) : 0;
  if (is_true < 0) throw nb::python_error();
  return is_true != 0;
}

LookupQuery query_of(BufferObject& buffer, nb::handle target, nb::handle source, nb::handle stamp) {
  LookupQuery query;
  query.target_id = buffer.frame(target.ptr());
  query.source_id = buffer.frame(source.ptr());
  query.target = text(target);
  query.source = text(source);
  query.stamp = to_stamp(stamp);
  return query;
}

LookupQuery full_query_of(BufferObject& buffer, nb::handle target, nb::handle target_stamp, nb::handle source,
                          nb::handle source_stamp, nb::handle fixed) {
  LookupQuery query = query_of(buffer, target, source, target_stamp);
  query.time_travel = true;
  query.fixed_id = buffer.frame(fixed.ptr());
  query.fixed = text(fixed);
  query.source_stamp = to_stamp(source_stamp);
  return query;
}

void define_arguments(nb::module_& module) {
  module.def(
      "register_time", [](nb::object time) { time_module = time.release(); }, nb::arg("time"),
      "Register the module that converts stamps and durations other than int.");
}

}  // namespace coframe::bindings
