// SPDX-License-Identifier: Apache-2.0
#include "kernels/level.hpp"

namespace coframe::COFRAME_LEVEL {

extern const Kernels table;
const Kernels table{
    COFRAME_LEVEL_NAME,
#define COFRAME_KERNEL(result, name, parameters) &name,
#include "kernels/entries.inc"
#undef COFRAME_KERNEL
};

}  // namespace coframe::COFRAME_LEVEL
