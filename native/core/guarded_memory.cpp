// SPDX-License-Identifier: Apache-2.0
#include "core/guarded_memory.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#ifndef _WIN32
#include <signal.h>
#include <sys/mman.h>
#endif

#include "core/fork_guard.hpp"
#include "core/light_mutex.hpp"

namespace coframe {

// The signal handler takes the mutex as well. It runs where the memory is read, never where the mutex is held.
struct Guards {
  LightMutex mutex;
  std::vector<GuardedMemory*> all;

  // Returns whether a fault at that address was handled.
  bool handle(const void* address) {
    const ForkSafeLock lock(mutex);
    for (GuardedMemory* memory : all) {
      if (memory->contains(address)) return memory->lose();
    }
    return false;
  }
};

namespace {

Guards& guards = *new Guards;  // never destroyed: buffers may outlive static objects

#ifndef _WIN32

struct sigaction before;  // the handler of all other bus errors

void on_bus_error(int number, siginfo_t* info, void* context) {
  const bool is_fault = info->si_code > 0;  // not a signal that a process has sent
  if (is_fault && guards.handle(info->si_addr)) return;
  if (before.sa_flags & SA_SIGINFO) return before.sa_sigaction(number, info, context);
  if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN) return before.sa_handler(number);
  signal(number, SIG_DFL);
  raise(number);  // delivered when this handler returns
}

void install_handler() {
  static const bool installed = [] {
    struct sigaction action = {};
    action.sa_sigaction = on_bus_error;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK;
    sigemptyset(&action.sa_mask);
    return sigaction(SIGBUS, &action, &before) == 0;
  }();
  (void)installed;
}

#else

void install_handler() {}

#endif

}  // namespace

GuardedMemory::GuardedMemory(void* start, std::size_t size, LostMemory loss)
    : start_(start), size_(size), loss_(std::move(loss)) {
  install_handler();
  const ForkSafeLock lock(guards.mutex);
  guards.all.push_back(this);
}

GuardedMemory::~GuardedMemory() {
  const ForkSafeLock lock(guards.mutex);
  std::erase(guards.all, this);
}

void GuardedMemory::add(Revision& revision) {
  const ForkSafeLock lock(guards.mutex);
  revisions_.push_back(&revision);
  if (lost()) revision.invalidate();
}

void GuardedMemory::remove(Revision& revision) {
  const ForkSafeLock lock(guards.mutex);
  std::erase(revisions_, &revision);
}

bool GuardedMemory::contains(const void* address) const {
  const auto offset = reinterpret_cast<std::uintptr_t>(address) - reinterpret_cast<std::uintptr_t>(start_);
  return offset < size_;
}

// All of it is replaced, because what is left of a tree is of no use. What other threads read in the meantime is
// inconsistent, which they detect as during a change.
bool GuardedMemory::lose() {
  if (lost()) return true;  // another thread was faster
#ifndef _WIN32
  constexpr int kFlags = MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED;
  if (mmap(start_, size_, PROT_READ | PROT_WRITE, kFlags, -1, 0) == MAP_FAILED) return false;
#endif
  lost_.store(true, std::memory_order_release);
  for (Revision* revision : revisions_) revision->invalidate();
  return true;
}

}  // namespace coframe
