// SPDX-License-Identifier: Apache-2.0
// The parts of the class Buffer in Python. Frequent methods are added to every subclass as its own, because CPython
// calls methods of the object's own class faster.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <optional>

#include "bindings/arguments.hpp"
#include "bindings/buffer.hpp"
#include "core/error.hpp"
#include "core/extrapolation.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

void define_lookups(nb::class_<BufferObject>& cls);
void define_many_lookups(nb::class_<BufferObject>& cls);
void define_insertions(nb::module_& module, nb::class_<BufferObject>& cls);
void define_state(nb::class_<BufferObject>& cls);
void add_frequent_lookups(nb::handle cls);
void add_frequent_insertions(nb::handle cls);

// Larger batches release the GIL; for smaller ones releasing it costs more than it gains.
constexpr std::size_t kLargeBatch = 20'000;

// Returns the numbers of an array with `count` rows; raises ValueError if it has another length.
double* rows_of(const Memory& memory, std::size_t columns, std::size_t count);

// Raises the exception of a failed lookup; returns a null object.
nb::object raise_for(BufferObject& self, Failure&& failure, nb::handle target, nb::handle source);

// Returns nothing if extrapolation is not requested.
std::optional<Extrapolation> extrapolation_of(nb::handle limit, bool hold);

}  // namespace coframe::bindings
