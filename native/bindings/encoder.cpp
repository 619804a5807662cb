// SPDX-License-Identifier: Apache-2.0
// Serialises message objects to CDR slot by slot. A value that is not in its usual form (an instance of a subclass, an
// int in a field of floats, a text that contains NUL) is left to Python code, which also reports all errors.
#include <nanobind/nanobind.h>
#include <nanobind/stl/shared_ptr.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/slots.hpp"

namespace coframe::bindings {

namespace {

constexpr std::size_t kHeaderSize = 4;
constexpr char kLittleEndianHeader[kHeaderSize] = {0, 1, 0, 0};
// An encoder keeps memory of up to this size for the next message of its thread.
constexpr std::size_t kMostKept = 1 << 20;
// Arrays of this size and more are copied only once, to the result.
constexpr std::size_t kLarge = 1 << 14;

// Returns a class that holds numbers, for as long as the process lives.
PyTypeObject* type_of_numbers(const char* module, const char* name) {
  return reinterpret_cast<PyTypeObject*>(nb::object(nb::module_::import_(module).attr(name)).release().ptr());
}

// The CDR bytes of a message while they are written.
class Output {
 public:
  Output() : bytes_(memory()) { bytes_.assign(kLittleEndianHeader, kLittleEndianHeader + kHeaderSize); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    for (Array& array : arrays_) PyBuffer_Release(&array.view);
    if (bytes_.capacity() > kMostKept) std::vector<char>().swap(bytes_);
  }

  void append(const void* data, std::size_t size) {
    const char* begin = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  // Appends the memory of an array and releases it, now or at the end.
  void append(Py_buffer& view) {
    const auto size = static_cast<std::size_t>(view.len);
    if (size >= kLarge) {
      arrays_.push_back({bytes_.size(), view});
      in_arrays_ += size;
      return;
    }
    append(view.buf, size);
    PyBuffer_Release(&view);
  }
  void align(std::size_t size) {
    const std::size_t position = bytes_.size() + in_arrays_ - kHeaderSize;
    bytes_.resize(bytes_.size() + (-position & (size - 1)));
  }
  template <class Number>
  void put(Number number) {
    align(sizeof number);
    append(&number, sizeof number);
  }

  nb::object bytes() const {
    nb::object result =
        nb::steal(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(bytes_.size() + in_arrays_)));
    if (!result.is_valid()) throw nb::python_error();
    char* end = PyBytes_AS_STRING(result.ptr());
    const auto copy = [&end](const void* data, std::size_t size) {
      std::memcpy(end, data, size);
      end += size;
    };
    std::size_t copied = 0;
    for (const Array& array : arrays_) {
      copy(bytes_.data() + copied, array.after - copied);
      copy(array.view.buf, static_cast<std::size_t>(array.view.len));
      copied = array.after;
    }
    copy(bytes_.data() + copied, bytes_.size() - copied);
    return result;
  }

 private:
  struct Array {
    std::size_t after;  // how many of the other bytes come before it
    Py_buffer view;
  };

  static std::vector<char>& memory() {
    thread_local std::vector<char> bytes;
    return bytes;
  }

  std::vector<char>& bytes_;  // all except the large arrays
  std::vector<Array> arrays_;
  std::size_t in_arrays_ = 0;
};

template <class Integer>
bool put_integer(PyObject* value, Output& out) {
  std::int64_t number;
  if (!quick_int64(value, number) || !std::in_range<Integer>(number)) return false;
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

class Encoder {
 public:
  Encoder(nb::type_object cls, nb::list fields) : type_(reinterpret_cast<PyTypeObject*>(cls.ptr())), cls_(cls) {
    for (nb::handle field : fields) fields_.push_back(make_field(cls, nb::cast<nb::tuple>(field)));
  }

  // Returns None if Python code has to serialise the message.
  nb::object encode(nb::handle message) const {
    Output out;
    if (std::endian::native != std::endian::little || !put_message(message.ptr(), out)) return nb::none();
    return out.bytes();
  }

 private:
  enum Container : char { kSingle, kArray, kSequence };
  struct Field {
    Py_ssize_t slot;
    char code;  // of a number; 0: a text or a message
    Container container;
    Py_ssize_t size;                         // of an array, or the most values of a sequence; 0: no limit
    Py_ssize_t text_bound;                   // the most characters of a text; 0: no limit
    std::shared_ptr<const Encoder> message;  // null: a text or a number
  };

  static Field make_field(nb::handle cls, const nb::tuple& description) {
    Field field{.slot = slot_offset(cls, nb::cast<const char*>(description[0])),
                .code = 0,
                .container = static_cast<Container>(nb::cast<int>(description[2])),
                .size = nb::cast<Py_ssize_t>(description[3]),
                .text_bound = nb::cast<Py_ssize_t>(description[4]),
                .message = nullptr};
    if (!nb::isinstance<nb::str>(description[1])) {
      field.message = nb::cast<std::shared_ptr<const Encoder>>(description[1]);
    } else {
      field.code = nb::cast<const char*>(description[1])[0];
    }
    return field;
  }

  bool put_message(PyObject* message, Output& out) const {
    if (Py_TYPE(message) != type_) return false;
    if (fields_.empty()) out.put(std::uint8_t{0});  // C has no empty structures, so rosidl adds one byte.
    for (const Field& field : fields_) {
      const nb::object value = read_slot(message, field.slot);
      if (!value.is_valid() || !put_field(field, value.ptr(), out)) return false;
    }
    return true;
  }

  static bool put_field(const Field& field, PyObject* value, Output& out) {
    if (field.container == kSingle) return put_value(field, value, out);
    const bool is_array = field.container == kArray;
    if (field.code != 0 && field.code != '?') {
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

  static bool put_value(const Field& field, PyObject* value, Output& out) {
    if (field.message) return field.message->put_message(value, out);
    return field.code == 0 ? put_text(value, field.text_bound, out) : put_number(field.code, value, out);
  }

  PyTypeObject* type_;
  nb::object cls_;  // keeps the type
  std::vector<Field> fields_;
};

}  // namespace

void define_encoder(nb::module_& module) {
  nb::class_<Encoder>(module, "Encoder", "Serializes the messages of a class to CDR.")
      .def(nb::init<nb::type_object, nb::list>(), nb::arg("cls"), nb::arg("fields"),
           "Each field is a tuple (slot, item, container, size, text_bound). The item is the struct code of a number, "
           "an empty text for texts, or the Encoder of a message. The container is 0 for a single item, 1 for an array "
           "of `size` items, 2 for a sequence of at most `size`. 0 is no limit.")
      .def("encode", &Encoder::encode, nb::arg("message"),
           "Return the CDR of a message, or None if Python code has to serialize it.");
}

}  // namespace coframe::bindings
