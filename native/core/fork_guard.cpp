// SPDX-License-Identifier: Apache-2.0
#include "core/fork_guard.hpp"

#ifndef _WIN32

#include <pthread.h>

#include <atomic>
#include <chrono>
#include <cstdint>

#include "core/back_off.hpp"

namespace coframe {

namespace {

// Scopes last microseconds; one that reads from a suspended process lasts two seconds. A fork by a thread without the
// interpreter lock could wait forever, so it continues after this time: almost all such children call exec()
// immediately.
constexpr auto kMaxWait = std::chrono::seconds(5);

// The number of threads that are in a scope, plus kFork for each fork in progress.
constexpr std::uint32_t kFork = 1 << 16;
std::atomic<std::uint32_t> state{0};
thread_local std::uint32_t depth = 0;  // the number of scopes that this thread is in

std::uint32_t this_thread() { return depth > 0 ? 1 : 0; }

void before_fork() {
  state.fetch_add(kFork);
  const auto deadline = std::chrono::steady_clock::now() + kMaxWait;
  for (int turn = 0; state.load() % kFork > this_thread(); ++turn) {
    back_off(turn);
    if (turn % 64 == 63 && std::chrono::steady_clock::now() > deadline) return;
  }
}

void after_fork_in_parent() { state.fetch_sub(kFork); }

void after_fork_in_child() { state.store(this_thread()); }

[[maybe_unused]] const int registered = pthread_atfork(before_fork, after_fork_in_parent, after_fork_in_child);

}  // namespace

ForkSafeScope::ForkSafeScope() {
  if (depth++ > 0) return;
  for (int turn = 0;;) {
    if (state.fetch_add(1) < kFork) return;
    state.fetch_sub(1);
    while (state.load() >= kFork) back_off(turn++);
  }
}

ForkSafeScope::~ForkSafeScope() {
  if (--depth == 0) state.fetch_sub(1);
}

}  // namespace coframe

#endif
