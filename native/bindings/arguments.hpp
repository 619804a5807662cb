// SPDX-License-Identifier: Apache-2.0
// Conversion of Python arguments: names, stamps, durations, queries.
#pragma once

#include <nanobind/nanobind.h>

#if PY_VERSION_HEX < 0x030B0000
#include <longintrepr.h>
#endif

#include <string_view>
#include <vector>

#include "bindings/buffer.hpp"
#include "coframe/endpoint_values.hpp"
#include "core/query.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Returns the C++ object; raises a type_error for other objects and if __init__ was not called.
BufferObject& buffer_of(nb::handle object);

// Reads an exact int that fits. Returns false for everything else, without an exception. A stamp has three digits of
// CPython's int, and CPython's own conversion would take as long as the lookup itself.
inline bool to_int64_if_exact(PyObject* number, std::int64_t& value) {
  if (!PyLong_CheckExact(number)) return false;
#if PyLong_SHIFT == 30 && PY_VERSION_HEX < 0x030E0000
  const auto* object = reinterpret_cast<const PyLongObject*>(number);
#if PY_VERSION_HEX >= 0x030C0000
  const std::size_t count = object->long_value.lv_tag >> 3;
  const bool is_negative = (object->long_value.lv_tag & 3) == 2;
  const auto* digits = object->long_value.ob_digit;
#else
  const Py_ssize_t size = Py_SIZE(object);
  const bool is_negative = size < 0;
  const std::size_t count = static_cast<std::size_t>(is_negative ? -size : size);
  const auto* digits = object->ob_digit;
#endif
  if (count <= 3 && (count < 3 || digits[2] < 8)) {
    std::uint64_t magnitude = count > 0 ? digits[0] : 0;
    if (count > 1) magnitude |= static_cast<std::uint64_t>(digits[1]) << 30;
    if (count > 2) magnitude |= static_cast<std::uint64_t>(digits[2]) << 60;
    value = is_negative ? -static_cast<std::int64_t>(magnitude) : static_cast<std::int64_t>(magnitude);
    return true;
  }
#endif
  int overflow;
  value = PyLong_AsLongLongAndOverflow(number, &overflow);
  return overflow == 0;
}

// Converts to nanoseconds: int directly, None as 0, everything else with coframe.time.
std::int64_t to_int64(nb::handle number);
Stamp to_stamp(nb::handle stamp);
std::int64_t to_duration(nb::handle duration);

// Returns the truth value; false for nullptr, an omitted argument.
bool is_true(PyObject* object);

// The names in the query are valid as long as their objects.
LookupQuery query_of(BufferObject& buffer, nb::handle target, nb::handle source, nb::handle stamp);
LookupQuery full_query_of(BufferObject& buffer, nb::handle target, nb::handle target_stamp, nb::handle source,
                          nb::handle source_stamp, nb::handle fixed);

using values::array_bytes;

// An object with the buffer protocol, locked while its memory is used.
class Memory {
 public:
  Memory(nb::handle object, int flags) {
    if (PyObject_GetBuffer(object.ptr(), &view_, flags) != 0) throw nb::python_error();
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() { PyBuffer_Release(&view_); }

  template <class T>
  T* data() const {
    return static_cast<T*>(view_.buf);
  }
  std::size_t size() const { return static_cast<std::size_t>(view_.len); }

 private:
  Py_buffer view_;
};

}  // namespace coframe::bindings
