// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <thread>

namespace coframe {

// Pauses a thread that waits for a few instructions of another one, which may have been descheduled and then needs the
// processor. `attempt` counts the calls of one wait.
inline void back_off(int attempt) {
  if (attempt < 50) return;
  if (attempt < 500) return std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::microseconds(50));
}

}  // namespace coframe
