// SPDX-License-Identifier: Apache-2.0
// fork() copies only the thread that calls it. What other threads are doing at that moment stays half done in the
// child: their locks stay locked, and their changes never end.
//
// A thread that holds the interpreter lock needs nothing, because the thread that forks holds it. Every other thread is
// in a ForkSafeScope while it holds a lock of the core or changes what other threads read. fork() waits for the end of
// all scopes, and no new one begins before it has returned. So a child finds every lock free and every change complete,
// without an order of the locks, and without a list of the objects that have one.
//
// A scope begins before its thread takes its first lock, and it is short. In it, a thread waits neither for the
// interpreter lock nor for an event: fork() waits with the interpreter lock held.
#pragma once

#include <mutex>

namespace coframe {

// May be nested. Where processes cannot be forked, it does nothing.
class ForkSafeScope {
 public:
#ifdef _WIN32
  ForkSafeScope() {}
#else
  ForkSafeScope();
  ~ForkSafeScope();
#endif
  ForkSafeScope(const ForkSafeScope&) = delete;
  ForkSafeScope& operator=(const ForkSafeScope&) = delete;
};

// A locked mutex in such a scope.
template <class Mutex>
class ForkSafeLock {
 public:
  explicit ForkSafeLock(Mutex& mutex) : lock_(mutex) {}

 private:
  const ForkSafeScope scope_;  // begins first, ends last
  const std::lock_guard<Mutex> lock_;
};

}  // namespace coframe
