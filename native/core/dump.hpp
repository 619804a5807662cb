// SPDX-License-Identifier: Apache-2.0
// The tree as text, in the formats of tf2's tools.
#pragma once

#include <string>

#include "core/tree.hpp"

namespace coframe {

std::string frames_as_string(const Tree& tree);
std::string frames_as_yaml(const Tree& tree);
// With `now` 0, ages and the legend are omitted.
std::string frames_as_dot(const Tree& tree, Stamp now);

// Samples per second as tf2 computes it: n over the span, which is at least 100 microseconds.
double average_rate(const History::View& history);

}  // namespace coframe
