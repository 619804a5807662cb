// What one writer has sent, as Python sees it.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>

#include "core/lag.hpp"
#include "core/renaming.hpp"

namespace coframe::bindings {

// (handle, messages, heard at, typical lag or None, examples of names: with a slash, with the prefix, without it)
nanobind::tuple heard_tuple(std::uint64_t writer, std::uint64_t messages, std::int64_t heard_at, const Lag& lag,
                            const NameOddities& odd);

}  // namespace coframe::bindings
