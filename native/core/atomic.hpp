// SPDX-License-Identifier: Apache-2.0
// The atomic type of everything that readers and a writer share. tests/native/explore replaces this file to run the
// core under every order of their steps.
#pragma once

#include <atomic>

namespace coframe {

template <class T>
using Atomic = std::atomic<T>;

}  // namespace coframe
