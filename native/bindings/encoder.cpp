// SPDX-License-Identifier: Apache-2.0
// How MessageCodec writes messages.
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "bindings/arguments.hpp"
#include "bindings/message_codec.hpp"
#include "bindings/slots.hpp"

namespace coframe::bindings {

namespace {

// Returns a class that holds numbers, for as long as the process lives.
PyTypeObject* type_of_numbers(const char* module, const char* name) {
  return reinterpret_cast<PyTypeObject*>(nb::object(nb::module_::import_(module).attr(name)).release().ptr());
}

template <class Integer>
bool put_integer(PyObject* value, Output& out) {
  std::int64_t number;
  if (!to_int64_if_exact(value, number) || !std::in_range<Integer>(number)) return false;
  out.put(static_cast<Integer>(number));
  return true;
}

bool put_uint64(PyObject* value, Output& out) {
  if (!PyLong_CheckExact(value)) return false;
  const unsigned long long number = PyLong_AsUnsignedLongLong(value);
  if (PyErr_Occurred()) {
    PyErr_Clear();
    return false;
  }
  out.put(static_cast<std::uint64_t>(number));
  return true;
}

bool put_float(PyObject* value, Output& out, bool is_double) {
  if (!PyFloat_CheckExact(value)) return false;
  const double number = PyFloat_AS_DOUBLE(value);
  if (is_double) {
    out.put(number);
    return true;
  }
  if (std::isnan(number) || (std::abs(number) > std::numeric_limits<float>::max() && !std::isinf(number))) return false;
  out.put(static_cast<float>(number));
  return true;
}

// `code` is that of Python's struct.
bool put_number(char code, PyObject* value, Output& out) {
  switch (code) {
    case '?':
      if (value != Py_True && value != Py_False) return false;
      out.put(static_cast<std::uint8_t>(value == Py_True));
      return true;
    case 'b': return put_integer<std::int8_t>(value, out);
    case 'B': return put_integer<std::uint8_t>(value, out);
    case 'h': return put_integer<std::int16_t>(value, out);
    case 'H': return put_integer<std::uint16_t>(value, out);
    case 'i': return put_integer<std::int32_t>(value, out);
    case 'I': return put_integer<std::uint32_t>(value, out);
    case 'q': return put_integer<std::int64_t>(value, out);
    case 'Q': return put_uint64(value, out);
    default: return put_float(value, out, code == 'd');
  }
}

bool put_length(std::size_t length, Output& out) {
  if (length > std::numeric_limits<std::uint32_t>::max() - 1) return false;
  out.put(static_cast<std::uint32_t>(length));
  return true;
}

bool put_text(PyObject* value, Py_ssize_t bound, Output& out) {
  if (!PyUnicode_CheckExact(value) || (bound > 0 && PyUnicode_GET_LENGTH(value) > bound)) return false;
  Py_ssize_t size;
  const char* text = PyUnicode_AsUTF8AndSize(value, &size);
  if (text == nullptr) {  // A lone surrogate.
    PyErr_Clear();
    return false;
  }
  const auto length = static_cast<std::size_t>(size);
  if (std::memchr(text, 0, length) != nullptr || !put_length(length + 1, out)) return false;
  out.append(text, length + 1);
  return true;
}

// Returns whether the numbers of a buffer have the type `code`: NumPy calls an int64 'l' where array.array says 'q'.
bool has_code(const Py_buffer& view, char code) {
  if (view.format == nullptr || std::strlen(view.format) != 1) return false;
  char found = view.format[0];
  if (found == 'l') found = view.itemsize == 8 ? 'q' : 'i';
  if (found == 'L') found = view.itemsize == 8 ? 'Q' : 'I';
  return found == code;
}

// Appends the numbers of an array.array or a numpy.ndarray. `size`: how many there must be; negative: any number, which
// is written first.
bool put_numbers(char code, PyObject* values, Py_ssize_t size, Py_ssize_t bound, Output& out) {
  static PyTypeObject* const sequence = type_of_numbers("array", "array");
  static PyTypeObject* const array = type_of_numbers("numpy", "ndarray");
  if (Py_TYPE(values) != (size < 0 ? sequence : array)) return false;
  Py_buffer view;
  if (PyObject_GetBuffer(values, &view, PyBUF_C_CONTIGUOUS | PyBUF_FORMAT) != 0) {
    PyErr_Clear();
    return false;
  }
  const Py_ssize_t count = view.itemsize > 0 ? view.len / view.itemsize : 0;
  const bool fits = has_code(view, code) && (size < 0 || count == size) && (bound <= 0 || count <= bound) &&
                    (size >= 0 || put_length(static_cast<std::size_t>(count), out));
  if (!fits || count == 0) {  // An empty sequence has no padding.
    PyBuffer_Release(&view);
    return fits;
  }
  out.align(static_cast<std::size_t>(view.itemsize));
  out.append(view);
  return true;
}

// Returns an item of a list or tuple; invalid if another thread has shortened the list.
nb::object item_of(PyObject* values, Py_ssize_t i) {
  if (PyTuple_CheckExact(values)) return nb::borrow(PyTuple_GET_ITEM(values, i));
#ifdef Py_GIL_DISABLED
  PyObject* item = PyList_GetItemRef(values, i);
  if (item == nullptr) PyErr_Clear();
  return nb::steal(item);
#else
  return i < PyList_GET_SIZE(values) ? nb::borrow(PyList_GET_ITEM(values, i)) : nb::object();
#endif
}

}  // namespace

nb::object MessageCodec::encode(nb::handle message) const {
  Output out;
  return put_message(message.ptr(), out) ? out.bytes() : nb::none();
}

bool MessageCodec::put_message(PyObject* message, Output& out) const {
  if (std::endian::native != std::endian::little || Py_TYPE(message) != type_) return false;
  if (fields_.empty()) out.put(std::uint8_t{0});  // C has no empty structures, so rosidl adds one byte.
  for (const Field& field : fields_) {
    const nb::object value = read_slot(message, field.slot);
    if (!value.is_valid() || !put_field(field, value.ptr(), out)) return false;
  }
  return true;
}

bool MessageCodec::put_items(PyObject* items, Output& out) const {
  if (std::endian::native != std::endian::little || fields_.size() != 1) return false;
  const Field& field = fields_[0];
  if (field.container != kSequence || !field.message) return false;
  if (Py_TYPE(items) != field.message->type_) return put_field(field, items, out);
  return put_length(1, out) && field.message->put_message(items, out);
}

bool MessageCodec::put_field(const Field& field, PyObject* value, Output& out) {
  if (field.container == kSingle) return put_value(field, value, out);
  const bool is_array = field.container == kArray;
  if (field.is_numbers()) {
    return put_numbers(field.code, value, is_array ? field.size : -1, is_array ? 0 : field.size, out);
  }
  if (!PyList_CheckExact(value) && !PyTuple_CheckExact(value)) return false;
  const Py_ssize_t count = PySequence_Fast_GET_SIZE(value);
  if (is_array ? count != field.size : field.size > 0 && count > field.size) return false;
  if (!is_array && !put_length(static_cast<std::size_t>(count), out)) return false;
  for (Py_ssize_t i = 0; i < count; ++i) {
    const nb::object item = item_of(value, i);
    if (!item.is_valid() || !put_value(field, item.ptr(), out)) return false;
  }
  return true;
}

bool MessageCodec::put_value(const Field& field, PyObject* value, Output& out) {
  if (field.message) return field.message->put_message(value, out);
  return field.code == 0 ? put_text(value, field.text_bound, out) : put_number(field.code, value, out);
}

}  // namespace coframe::bindings
