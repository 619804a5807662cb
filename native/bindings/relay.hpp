// What one writer has sent, as Python sees it.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>

#include "core/stamp_delay.hpp"
#include "core/renaming.hpp"

namespace coframe::bindings {

// (handle, messages, heard at, typical lag or None, examples of names: with a slash, with the prefix, without it)
nanobind::tuple writer_tuple(std::uint64_t writer, std::uint64_t messages, std::int64_t received_at, const StampDelay& delay,
                            const NameProblems& name_problems);

}  // namespace coframe::bindings
