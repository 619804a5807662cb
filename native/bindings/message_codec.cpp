// SPDX-License-Identifier: Apache-2.0
#include "bindings/message_codec.hpp"

#include <nanobind/stl/shared_ptr.h>

#include <string>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/slots.hpp"

namespace coframe::bindings {

MessageCodec::MessageCodec(nb::type_object cls, nb::list fields, std::size_t ros1_prefix)
    : type_(reinterpret_cast<PyTypeObject*>(cls.ptr())), cls_(cls), ros1_prefix_(ros1_prefix) {
  for (nb::handle field : fields) fields_.push_back(make_field(cls, nb::cast<nb::tuple>(field)));
}

MessageCodec::Field MessageCodec::make_field(nb::handle cls, const nb::tuple& description) {
  Field field{.slot = slot_offset(cls, nb::cast<const char*>(description[0])),
              .code = 0,
              .container = static_cast<Container>(nb::cast<int>(description[2])),
              .size = nb::cast<Py_ssize_t>(description[3]),
              .text_bound = nb::cast<Py_ssize_t>(description[4]),
              .message = nullptr,
              .dtype = {}};
  if (nb::isinstance<nb::str>(description[1])) {
    field.code = nb::cast<const char*>(description[1])[0];
  } else {
    field.message = nb::cast<std::shared_ptr<const MessageCodec>>(description[1]);
  }
  if (field.is_numbers() && field.container == kArray) field.dtype = description[5];
  return field;
}

void define_message_codec(nb::module_& module) {
  nb::class_<MessageCodec>(module, "MessageCodec", "Reads and writes the messages of a class.")
      .def(nb::init<nb::type_object, nb::list, std::size_t>(), nb::arg("cls"), nb::arg("fields"),
           nb::arg("ros1_prefix") = 0,
           "Each field is a tuple (slot, item, container, size, text_bound, dtype). The item is the struct code of a "
           "number, an empty string for strings, or the MessageCodec of a message. The container is 0 for a single "
           "item, "
           "1 for an array of `size` items, 2 for a sequence of at most `size`. 0 is no limit. `dtype` is that of an "
           "array of numbers. `ros1_prefix` is how many bytes a message of ROS 1 has before its fields.")
      .def("encode", &MessageCodec::encode, nb::arg("message"),
           "Return the CDR of a message, or None if Python code has to serialize it.")
      .def(
          "decode",
          [](const MessageCodec& self, nb::handle data, std::size_t max_rest) {
            const Memory memory(data, PyBUF_SIMPLE);
            return self.decode({memory.data<const std::uint8_t>(), memory.size()}, max_rest);
          },
          nb::arg("data"), nb::arg("max_rest") = SIZE_MAX,
          "Return the message in CDR bytes, or None if Python code has to read it, or if more than `max_rest` bytes "
          "follow it.")
      .def(
          "decode_ros1",
          [](const MessageCodec& self, nb::handle data) {
            const Memory memory(data, PyBUF_SIMPLE);
            return self.decode_ros1({memory.data<const std::uint8_t>(), memory.size()});
          },
          nb::arg("data"), "Return the message in bytes of ROS 1, or None if Python code has to read it.");
}

}  // namespace coframe::bindings
