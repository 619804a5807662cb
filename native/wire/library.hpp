// SPDX-License-Identifier: Apache-2.0
// The loaded DDS library, for the files of this folder that must not fail after a fork.
#pragma once

#include "wire/dds.hpp"

namespace coframe::dds {

extern Functions loaded;  // null pointers before load()

}  // namespace coframe::dds
