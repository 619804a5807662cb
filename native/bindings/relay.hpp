// SPDX-License-Identifier: Apache-2.0
// The statistics of one writer as a Python tuple.
#pragma once

#include <nanobind/nanobind.h>

#include <cstdint>

#include "core/arrival_period.hpp"
#include "core/renaming.hpp"
#include "core/stamp_delay.hpp"

namespace coframe::bindings {

// (handle, messages, time of the last one, period, typical delay or None, examples of names: with a leading slash, with
// the prefix, without it)
nanobind::tuple writer_tuple(std::uint64_t writer, std::uint64_t messages, std::int64_t received_at,
                             const ArrivalPeriod& period, const StampDelay& delay, const NameProblems& name_problems);

}  // namespace coframe::bindings
