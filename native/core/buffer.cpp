// SPDX-License-Identifier: Apache-2.0
// The state of a buffer: cleared, restored, frozen, or a reader of shared data.
#include "core/buffer.hpp"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>
#include <utility>

#include "core/frozen.hpp"

namespace coframe {

void Buffer::clear() {
  {
    const std::lock_guard lock(writing_);
    if (refusal_.load() != 0) return;
    tree_.clear();
  }
  Inserted inserted;
  inserted.rewired = true;  // the next insertions may build another tree
  announce(&inserted, 1);
}

bool Buffer::remove_frame(std::string_view name) {
  Inserted inserted;
  {
    const std::lock_guard lock(writing_);
    const FrameId frame = tree_.find(name);
    if (frame == 0 || refusal_.load() != 0) return false;
    tree_.remove(frame);
    inserted.rewired = true;
  }
  announce(&inserted, 1);
  return true;
}

std::shared_ptr<Buffer> Buffer::snapshot() const {
  const std::lock_guard lock(writing_);
  return std::shared_ptr<Buffer>(new Buffer(tree_));
}

bool Buffer::follow(SharedTreeData shared) {
  {
    const std::lock_guard lock(writing_);
    if (refusal_.load() != 0 || tree_.frame_count() > 1) return false;
    refusal_.store(kShared);
    tree_.switch_to(std::move(shared));
    follower_.emplace(tree_, wait_queue_);
  }
  notify_of_other_data();
  return true;
}

void Buffer::stop_following() {
  {
    const std::lock_guard lock(writing_);
    if (!following()) return;
    follower_.reset();
    if (!tree_.become_private()) return;
    refusal_.store(0);
  }
  notify_of_other_data();
}

void Buffer::notify_of_other_data() {
  Inserted inserted;
  inserted.new_names = inserted.rewired = true;
  notify(&inserted, 1);
}

void Buffer::pause_reading(int attempt) {
  constexpr int kMaxAttempts = 40'000;  // two seconds
  if (attempt > kMaxAttempts)
    throw std::runtime_error("the shared buffer changes faster than this process can read it");
  std::this_thread::sleep_for(std::chrono::microseconds(50));
}

std::shared_ptr<Buffer> Buffer::restored(Stamp cache_length, std::span<const std::uint8_t> table,
                                         std::span<const std::uint8_t> chunks, std::shared_ptr<GuardedMemory> memory,
                                         const char*& reason) {
  auto buffer = std::make_shared<Buffer>(cache_length);
  reason = restore(buffer->tree_, table, chunks, std::move(memory));
  buffer->freeze();
  return reason ? nullptr : buffer;
}

}  // namespace coframe
