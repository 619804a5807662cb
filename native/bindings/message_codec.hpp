// SPDX-License-Identifier: Apache-2.0
// Reads the messages of a class from CDR or from the bytes of ROS 1, and writes them as CDR, slot by slot. What it does
// not handle (an instance of a subclass, an int in a field of floats, a text that contains NUL, damaged bytes) is left
// to Python code, which also reports errors.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "bindings/cdr_output.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

class MessageInput;

class MessageCodec {
 public:
  // The fields are those that `define_message_codec` describes. `ros1_prefix` is how many bytes a message of ROS 1 has
  // before them.
  MessageCodec(nb::type_object cls, nb::list fields, std::size_t ros1_prefix);

  // Returns the CDR of a message; None if Python code has to serialize it.
  nb::object encode(nb::handle message) const;
  // Returns the message in CDR bytes; None if Python code has to read it, or if more than `max_rest` bytes follow it.
  nb::object decode(std::span<const std::uint8_t> data, std::size_t max_rest = SIZE_MAX) const;
  // Returns a message of ROS 1; None if Python code has to read it.
  nb::object decode_ros1(std::span<const std::uint8_t> data) const;

  // Writes a message. Returns false if Python code has to serialize it.
  bool put_message(PyObject* message, Output& out) const;
  // The same for a message whose only field is a sequence of messages, which are in a list or tuple, or is one message.
  bool put_items(PyObject* items, Output& out) const;

 private:
  enum Container : char { kSingle, kArray, kSequence };
  struct Field {
    Py_ssize_t slot;
    char code;  // of a number, as in Python's struct; 0: a text or a message
    Container container;
    Py_ssize_t size;                              // of an array, or the most values of a sequence; 0: no limit
    Py_ssize_t text_bound;                        // the most characters of a text; 0: no limit
    std::shared_ptr<const MessageCodec> message;  // null: a text or a number
    nb::object dtype;                             // of an array of numbers

    // Whether the values are an array.array or a numpy.ndarray. Otherwise, they are a list.
    bool is_numbers() const { return container != kSingle && code != 0 && code != '?'; }
  };

  static Field make_field(nb::handle cls, const nb::tuple& description);
  static bool put_field(const Field& field, PyObject* value, Output& out);
  static bool put_value(const Field& field, PyObject* value, Output& out);
  // These return an invalid object if Python code has to read the message.
  nb::object get_message(MessageInput& in) const;
  static nb::object get_field(const Field& field, MessageInput& in);
  static nb::object get_value(const Field& field, MessageInput& in);

  PyTypeObject* type_;
  nb::object cls_;  // keeps the type
  std::vector<Field> fields_;
  std::size_t ros1_prefix_;
};

}  // namespace coframe::bindings
