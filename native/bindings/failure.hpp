// SPDX-License-Identifier: Apache-2.0
// A failed lookup as Python sees it: facts, and tf2's text when it is read.
#pragma once

#include <nanobind/nanobind.h>

#include <memory>

#include "core/buffer.hpp"
#include "core/error.hpp"
#include "core/guarded_memory.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// The tf2 function whose text is used.
enum class Tf2Function { lookup, can_transform, latest_common_time };

struct FailureObject {
  Failure failure;
  std::shared_ptr<Buffer> buffer;
  nb::object target, source;  // the requested names
  Tf2Function function = Tf2Function::lookup;
};

std::string text_of(const FailureObject& failure);

// Sets the registered exception of the failure's code, for the caller to return immediately: a C++ throw would cost
// more than the lookup.
nb::object raise_failure(FailureObject&& failure);
[[noreturn]] void raise_decode_error(const DecodeFailure& failure);
// Sets the exceptions for UnfinishedChange and LostMemory.
void set_unfinished_change(const char* text);
void set_lost_memory(const LostMemory& error);

}  // namespace coframe::bindings
