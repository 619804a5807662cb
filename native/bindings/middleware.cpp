// SPDX-License-Identifier: Apache-2.0
// The table of functions for the native modules of other middlewares.
#include "coframe/middleware.h"

#include <vector>

#include "bindings/bindings.hpp"
#include "bindings/fast_call.hpp"
#include "bindings/message_codec.hpp"
#include "core/cdr.hpp"
#include "core/event.hpp"
#include "wire/transform_store.hpp"

namespace coframe::bindings {
namespace {

template <class Native>
void* native_of(PyObject* object) {
  void* native = nullptr;
  guarded([&]() -> PyObject* {
    native = &nb::cast<Native&>(nb::handle(object));
    return nullptr;
  });
  return native;
}

void set_event(void* event) { static_cast<Event*>(event)->set(); }

int is_event_set(void* event) { return static_cast<Event*>(event)->is_set(); }

// If memory runs out, a message is lost.
void add_to_store(void* store, std::uint64_t writer, const std::uint8_t* message, std::size_t size) {
  try {
    TransformStore::Ingest(*static_cast<TransformStore*>(store)).add(writer, {message, size});
  } catch (...) {
  }
}

PyObject* decode(void* codec, const std::uint8_t* message, std::size_t size) {
  return guarded(
      [&]() -> PyObject* { return static_cast<const MessageCodec*>(codec)->decode({message, size}).release().ptr(); });
}

int encode(void* codec, PyObject* message, int of_items, coframe_send send, void* context) {
  int sent = -1;
  guarded([&]() -> PyObject* {
    Output out;
    const auto& native = *static_cast<const MessageCodec*>(codec);
    if (!(of_items ? native.put_items(message, out) : native.put_message(message, out))) {
      sent = 0;
      return nullptr;
    }
    std::vector<coframe_part> parts;
    out.for_each_part([&](const void* data, std::size_t size) { parts.push_back({data, size}); });
    sent = send(context, parts.data(), parts.size(), out.size()) == 0 ? 1 : -1;
    return nullptr;
  });
  return sent;
}

int is_tf_message(const std::uint8_t* message, std::size_t size) {
  return check_tf_message(message, size).reason == nullptr;
}

void* leave() { return leave_python(); }

void enter(void* thread) { enter_python(static_cast<PyThreadState*>(thread)); }

const coframe_middleware table{.version = COFRAME_MIDDLEWARE_VERSION,
                               .event = &native_of<Event>,
                               .set_event = &set_event,
                               .is_event_set = &is_event_set,
                               .store = &native_of<TransformStore>,
                               .add_to_store = &add_to_store,
                               .codec = &native_of<MessageCodec>,
                               .decode = &decode,
                               .encode = &encode,
                               .is_tf_message = &is_tf_message,
                               .leave_python = &leave,
                               .enter_python = &enter};

}  // namespace

void define_middleware(nb::module_& module) {
  module.attr("middleware") = nb::capsule(&table, COFRAME_MIDDLEWARE_CAPSULE);
}

}  // namespace coframe::bindings
