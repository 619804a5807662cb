// SPDX-License-Identifier: Apache-2.0
#include "wire/published_statics.hpp"

#include <unordered_set>
#include <utility>

namespace coframe {
namespace {

// Further writers count as gone: not every wire reports the end of every publisher.
constexpr std::size_t kMaxWriters = 1024;

}  // namespace

PublishedStatics::PublishedStatics(std::shared_ptr<Buffer> buffer) : buffer_(std::move(buffer)) {
  if (!buffer_->outdated()) inherited_ = buffer_->static_frames();
}

void PublishedStatics::receive(Writer writer, std::span<const Inserted> message) {
  std::vector<FrameId> frames;
  for (const Inserted& inserted : message) {
    if (inserted.child != 0) frames.push_back(inserted.child);
  }
  const auto known = last_messages_.find(writer);
  if (known != last_messages_.end()) {
    if (known->second == frames) return;
    known->second = std::move(frames);
  } else if (last_messages_.size() < kMaxWriters) {
    last_messages_.emplace(writer, std::move(frames));
  }
  compare();
}

void PublishedStatics::leave(Writer writer) {
  if (last_messages_.erase(writer) > 0) compare();
}

void PublishedStatics::settle() {
  inherited_.clear();
  compare();
}

void PublishedStatics::compare() {
  std::unordered_set<FrameId> published(inherited_.begin(), inherited_.end());
  for (const auto& [writer, frames] : last_messages_) published.insert(frames.begin(), frames.end());
  bool outdated = false;
  for (const FrameId frame : buffer_->static_frames()) outdated |= !published.contains(frame);
  buffer_->set_outdated(outdated);
}

}  // namespace coframe
