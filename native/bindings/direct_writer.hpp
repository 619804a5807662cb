// SPDX-License-Identifier: Apache-2.0
// Sends messages with one call from Python: the message is serialized slot by slot and passed to DDS.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "bindings/message_codec.hpp"
#include "core/event.hpp"
#include "wire/writer.hpp"

namespace coframe::bindings {

// Serializes and sends a message. Returns false if Python code has to serialize it.
bool publish_message(const Writer& writer, const MessageCodec& codec, nb::handle message);

// Returns a Python function that sends messages and returns whether it did. It leaves to Python code what the codec
// does not handle, and everything once `closed` is set or the writer is closed. `failure`, a Python function, returns
// the exception to raise for the text of an error of DDS. With `of_items`, the function takes the items of the
// message's only field, or a single item. `owner` is the Python object of the writer.
nb::object direct_function(nb::handle owner, const Writer& writer, std::shared_ptr<const MessageCodec> codec,
                           std::shared_ptr<Event> closed, nb::object failure, bool of_items);

}  // namespace coframe::bindings
