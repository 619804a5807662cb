// SPDX-License-Identifier: Apache-2.0
// The processor levels that the kernels are compiled for.
#pragma once

#include <vector>

#include "kernels/kernels.hpp"

namespace coframe {

// The kernels of every level that this build contains and this processor supports, the fastest last.
std::vector<const Kernels*> all_kernels();

}  // namespace coframe
