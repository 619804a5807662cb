// SPDX-License-Identifier: Apache-2.0
#include "bindings/direct_writer.hpp"

#include <utility>
#include <vector>

#include "bindings/fast_call.hpp"
#include "bindings/gil.hpp"

namespace coframe::bindings {

namespace {

struct DirectWriter {
  nb::object owner;
  const Writer* writer;
  std::shared_ptr<const MessageCodec> codec;
  std::shared_ptr<Event> closed;
  nb::object failure;
  bool of_items;
};

void send(const Writer& writer, const Output& out) {
  if (const auto whole = out.whole(); whole.data() != nullptr) {  // Most messages are in one part.
    WithoutGil release;
    writer.write(whole.data(), whole.size());
    return;
  }
  std::vector<dds::IoVector> parts;
  out.for_each_part([&](const void* data, std::size_t size) { parts.push_back(dds::io_vector(data, size)); });
  WithoutGil release;
  writer.write(parts, out.size());
}

PyObject* publish(PyObject* self, PyObject* message) {
  const auto& direct = *static_cast<const DirectWriter*>(PyCapsule_GetPointer(self, nullptr));
  return guarded([&]() -> PyObject* {
    if (direct.closed->is_set() || direct.writer->closed()) Py_RETURN_FALSE;
    Output out;
    if (!(direct.of_items ? direct.codec->put_items(message, out) : direct.codec->put_message(message, out))) {
      Py_RETURN_FALSE;
    }
    try {
      send(*direct.writer, out);
    } catch (const dds::Error& error) {
      if (direct.writer->closed()) Py_RETURN_FALSE;  // by another thread in the meantime
      const nb::object exception = direct.failure(error.what());
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
      return nullptr;
    }
    Py_RETURN_TRUE;
  });
}

PyMethodDef definition{"publish", &publish, METH_O, "Send a message; return False if Python code has to send it."};

}  // namespace

bool publish_message(const Writer& writer, const MessageCodec& codec, nb::handle message) {
  Output out;
  if (!codec.put_message(message.ptr(), out)) return false;
  send(writer, out);
  return true;
}

nb::object direct_function(nb::handle owner, const Writer& writer, std::shared_ptr<const MessageCodec> codec,
                           std::shared_ptr<Event> closed, nb::object failure, bool of_items) {
  auto direct = std::make_unique<DirectWriter>(DirectWriter{.owner = nb::borrow(owner),
                                                            .writer = &writer,
                                                            .codec = std::move(codec),
                                                            .closed = std::move(closed),
                                                            .failure = std::move(failure),
                                                            .of_items = of_items});
  const nb::object capsule = nb::steal(PyCapsule_New(direct.get(), nullptr, [](PyObject* self) {
    delete static_cast<DirectWriter*>(PyCapsule_GetPointer(self, nullptr));
  }));
  if (!capsule.is_valid()) throw nb::python_error();
  direct.release();
  nb::object function = nb::steal(PyCFunction_New(&definition, capsule.ptr()));
  if (!function.is_valid()) throw nb::python_error();
  return function;
}

}  // namespace coframe::bindings
