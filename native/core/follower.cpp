// SPDX-License-Identifier: Apache-2.0
#include "core/follower.hpp"

#include <thread>

#include "core/fork_guard.hpp"

#ifndef _WIN32  // macOS does not define __unix__
#include <unistd.h>
#endif

namespace coframe {

namespace {

constexpr std::int64_t kMaxPause = 1'000'000'000;

std::int64_t current_process() {
#ifndef _WIN32
  return getpid();
#else
  return 0;
#endif
}

}  // namespace

ChangeFollower::ChangeFollower(const Tree& tree, WaitQueue& queue) : tree_(tree), queue_(queue) {
  queue_.on_add([this] { ensure_running(); });
}

ChangeFollower::~ChangeFollower() {
  queue_.on_add(nullptr);
  stopped_.store(true);
  std::unique_lock lock(mutex_);
  if (!running_ || process_ != current_process()) return;
  tree_.access()->wake();
  ended_.wait(lock, [this] { return !running_; });
}

void ChangeFollower::ensure_running() {
  const std::lock_guard lock(mutex_);
  if (stopped_ || (running_ && process_ == current_process())) return;
  remember();
  std::thread([this] { run(); }).detach();
  running_ = true;
  process_ = current_process();
}

void ChangeFollower::run() {
  for (;;) {
    try {
      tree_.access()->wait_for_change(changes_, kMaxPause);
      if (!stopped_) {
        const ForkSafeScope scope;
        notify();
      }
    } catch (...) {  // the writer is suspended: the next change is handled later
    }
    const ForkSafeLock lock(mutex_);
    if (!stopped_ && !queue_.empty()) continue;
    running_ = false;
    ended_.notify_all();
    return;
  }
}

void ChangeFollower::remember() {
  changes_ = tree_.changes().load();
  version_ = tree_.version();
  stored_.resize(tree_.frame_count());
  for (FrameId id = 0; id < stored_.size(); ++id) stored_[id] = tree_.frame(id).counts.stored;
}

// The number of changes is read first: later ones lead to another call.
void ChangeFollower::notify() {
  changes_ = tree_.changes().load();
  Inserted inserted;
  const std::uint64_t version = tree_.version();
  const std::size_t frames = tree_.frame_count();
  if (version != version_ || frames != stored_.size()) {
    version_ = version;
    inserted.new_names = inserted.rewired = true;
    queue_.notify(inserted);
  }
  stored_.resize(frames);
  for (FrameId id = 0; id < frames; ++id) {
    const std::uint64_t stored = tree_.frame(id).counts.stored;
    if (stored == stored_[id]) continue;
    stored_[id] = stored;
    Inserted inserted_frame;
    inserted_frame.child = id;
    queue_.notify(inserted_frame);
  }
}

}  // namespace coframe
