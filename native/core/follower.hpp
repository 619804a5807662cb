// SPDX-License-Identifier: Apache-2.0
// Notifies the waiters of a buffer that reads shared data. Its thread exists while there are waiters.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <vector>

#include "core/tree.hpp"
#include "core/wait_queue.hpp"

namespace coframe {

class ChangeFollower {
 public:
  ChangeFollower(const Tree& tree, WaitQueue& queue);
  ChangeFollower(const ChangeFollower&) = delete;
  ChangeFollower& operator=(const ChangeFollower&) = delete;
  ~ChangeFollower();

 private:
  void ensure_running();
  void run();
  // Remembers the state of the tree, so that only later changes are notified of.
  void remember();
  void notify();

  const Tree& tree_;
  WaitQueue& queue_;
  std::atomic<bool> stopped_{false};
  std::mutex mutex_;
  std::condition_variable ended_;
  bool running_ = false;      // guarded by mutex_
  std::int64_t process_ = 0;  // that has started the thread: a forked child does not have it
  // What has been seen of the tree.
  std::uint64_t changes_ = 0, version_ = 0;
  std::vector<std::uint64_t> stored_;  // by frame
};

}  // namespace coframe
