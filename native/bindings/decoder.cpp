// SPDX-License-Identifier: Apache-2.0
// How MessageCodec reads messages.
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>

#include "bindings/arguments.hpp"
#include "bindings/message_codec.hpp"
#include "bindings/slots.hpp"

namespace coframe::bindings {

// The bytes of a message while they are read. Those of ROS 1 have neither a header nor padding, and texts end without
// NUL.
class MessageInput {
 public:
  static constexpr std::size_t kHeaderSize = 4;

  static MessageInput cdr(std::span<const std::uint8_t> data) { return {data, kHeaderSize, ~std::size_t{0}}; }
  static MessageInput ros1(std::span<const std::uint8_t> data) { return {data, 0, 0}; }

  bool is_ros1() const { return alignment_mask_ == 0; }
  std::size_t remaining() const { return data_.size() - position_; }
  // Returns the next bytes; nullptr if there are fewer.
  const std::uint8_t* take(std::size_t size) {
    if (size > remaining()) return nullptr;
    const std::uint8_t* bytes = data_.data() + position_;
    position_ += size;
    return bytes;
  }
  // Skips padding. Returns whether there is as much.
  bool align(std::size_t size) { return take((kHeaderSize - position_) & (size - 1) & alignment_mask_) != nullptr; }
  template <class Number>
  bool read(Number& number) {
    const std::uint8_t* bytes = align(sizeof number) ? take(sizeof number) : nullptr;
    if (bytes == nullptr) return false;
    std::memcpy(&number, bytes, sizeof number);
    return true;
  }

 private:
  MessageInput(std::span<const std::uint8_t> data, std::size_t position, std::size_t alignment_mask)
      : data_(data), position_(position), alignment_mask_(alignment_mask) {}

  std::span<const std::uint8_t> data_;
  std::size_t position_;
  std::size_t alignment_mask_;
};

namespace {

template <class Number, class Make>
nb::object get(MessageInput& in, Make&& make) {
  Number number;
  if (!in.read(number)) return {};
  nb::object result = nb::steal(make(number));
  if (!result.is_valid()) throw nb::python_error();
  return result;
}

nb::object get_number(char code, MessageInput& in) {
  switch (code) {
    case '?': return get<std::uint8_t>(in, [](std::uint8_t value) { return PyBool_FromLong(value); });
    case 'b': return get<std::int8_t>(in, PyLong_FromLong);
    case 'B': return get<std::uint8_t>(in, PyLong_FromLong);
    case 'h': return get<std::int16_t>(in, PyLong_FromLong);
    case 'H': return get<std::uint16_t>(in, PyLong_FromLong);
    case 'i': return get<std::int32_t>(in, PyLong_FromLong);
    case 'I': return get<std::uint32_t>(in, PyLong_FromUnsignedLong);
    case 'q': return get<std::int64_t>(in, PyLong_FromLongLong);
    case 'Q': return get<std::uint64_t>(in, PyLong_FromUnsignedLongLong);
    case 'f': return get<float>(in, PyFloat_FromDouble);
    default: return get<double>(in, PyFloat_FromDouble);
  }
}

nb::object get_text(Py_ssize_t bound, MessageInput& in) {
  std::uint32_t size;
  if (!in.read(size)) return {};
  if (size == 0) return nb::str("");  // Some writers use length 0 for an empty string.
  const std::uint8_t* bytes = in.take(size);
  if (bytes == nullptr) return {};
  if (!in.is_ros1()) {
    --size;
    if (std::memchr(bytes, 0, size + std::size_t{1}) != bytes + size) return {};  // The only NUL must be the last byte.
  }
  nb::object text =
      nb::steal(PyUnicode_DecodeUTF8(reinterpret_cast<const char*>(bytes), static_cast<Py_ssize_t>(size), nullptr));
  if (!text.is_valid()) {
    PyErr_Clear();
    return {};
  }
  return bound > 0 && PyUnicode_GET_LENGTH(text.ptr()) > bound ? nb::object() : text;
}

std::size_t size_of(char code) {
  switch (code) {
    case 'b':
    case 'B': return 1;
    case 'h':
    case 'H': return 2;
    case 'i':
    case 'I':
    case 'f': return 4;
    default: return 8;
  }
}

// Returns the numbers as an array.array.
nb::object get_sequence(char code, std::size_t count, MessageInput& in) {
  static PyObject* const array = nb::object(nb::module_::import_("array").attr("array")).release().ptr();
  static PyObject* const frombytes = PyUnicode_InternFromString("frombytes");
  nb::object values = nb::steal(PyObject_CallFunction(array, "C", static_cast<int>(code)));
  if (!values.is_valid()) throw nb::python_error();
  if (count == 0) return values;  // An empty sequence has no padding.
  const std::size_t size = size_of(code);
  if (count > in.remaining() / size || !in.align(size)) return {};
  const std::uint8_t* bytes = in.take(count * size);
  if (bytes == nullptr) return {};
  const nb::object view = nb::steal(PyMemoryView_FromMemory(const_cast<char*>(reinterpret_cast<const char*>(bytes)),
                                                            static_cast<Py_ssize_t>(count * size), PyBUF_READ));
  if (!view.is_valid()) throw nb::python_error();
  const nb::object done = nb::steal(PyObject_CallMethodObjArgs(values.ptr(), frombytes, view.ptr(), nullptr));
  if (!done.is_valid()) throw nb::python_error();
  return values;
}

// Returns the numbers as a numpy.ndarray.
nb::object get_array(char code, std::size_t count, const nb::object& dtype, MessageInput& in) {
  static PyObject* const empty = nb::object(nb::module_::import_("numpy").attr("empty")).release().ptr();
  const std::size_t size = size_of(code);
  const std::uint8_t* bytes = in.align(size) ? in.take(count * size) : nullptr;
  if (bytes == nullptr) return {};
  nb::object values = nb::steal(PyObject_CallFunction(empty, "nO", static_cast<Py_ssize_t>(count), dtype.ptr()));
  if (!values.is_valid()) throw nb::python_error();
  const Memory memory(values, PyBUF_WRITABLE);
  std::memcpy(memory.data<void>(), bytes, count * size);
  return values;
}

}  // namespace

nb::object MessageCodec::decode(std::span<const std::uint8_t> data, std::size_t max_rest) const {
  const bool is_little_endian = data.size() >= MessageInput::kHeaderSize && data[0] == 0 && data[1] == 1;
  if (std::endian::native != std::endian::little || !is_little_endian) return nb::none();
  MessageInput in = MessageInput::cdr(data);
  nb::object message = get_message(in);
  return message.is_valid() && in.remaining() <= max_rest ? message : nb::none();
}

nb::object MessageCodec::decode_ros1(std::span<const std::uint8_t> data) const {
  if (std::endian::native != std::endian::little) return nb::none();
  MessageInput in = MessageInput::ros1(data);
  nb::object message = get_message(in);
  return message.is_valid() ? message : nb::none();
}

nb::object MessageCodec::get_message(MessageInput& in) const {
  if (in.is_ros1()) {
    if (in.take(ros1_prefix_) == nullptr) return {};
  } else if (fields_.empty() && in.take(1) == nullptr) {
    return {};
  }
  nb::object message = nb::steal(type_->tp_alloc(type_, 0));
  if (!message.is_valid()) throw nb::python_error();
  for (const Field& field : fields_) {
    nb::object value = get_field(field, in);
    if (!value.is_valid()) return {};
    slot_at(message.ptr(), field.slot) = value.release().ptr();
  }
  return message;
}

nb::object MessageCodec::get_field(const Field& field, MessageInput& in) {
  if (field.container == kSingle) return get_value(field, in);
  auto count = static_cast<std::uint32_t>(field.size);
  if (field.container == kSequence) {
    if (!in.read(count) || (field.size > 0 && count > field.size)) return {};
    if (field.is_numbers()) return get_sequence(field.code, count, in);
  } else if (field.is_numbers()) {
    return get_array(field.code, count, field.dtype, in);
  }
  if (count > in.remaining()) return {};  // Each value has at least one byte.
  nb::list values;
  for (std::uint32_t i = 0; i < count; ++i) {
    const nb::object value = get_value(field, in);
    if (!value.is_valid()) return {};
    values.append(value);
  }
  return values;
}

nb::object MessageCodec::get_value(const Field& field, MessageInput& in) {
  if (field.message) return field.message->get_message(in);
  return field.code == 0 ? get_text(field.text_bound, in) : get_number(field.code, in);
}

}  // namespace coframe::bindings
