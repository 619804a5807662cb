// SPDX-License-Identifier: Apache-2.0
// Compares the static transforms of shared data with those that publishers still publish. A buffer keeps static
// transforms forever, but a new subscription receives only the last message of each publisher that still exists.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "core/buffer.hpp"

namespace coframe {

class PublishedStatics {
 public:
  using Writer = std::uint64_t;  // a number that the wire gives each writer

  // The static transforms that `buffer` contains already count as published until settle() is called, unless they are
  // outdated: their publishers may still exist.
  explicit PublishedStatics(std::shared_ptr<Buffer> buffer);

  // A message has arrived, which replaces the earlier ones of its writer.
  void receive(Writer writer, std::span<const Inserted> message);
  void leave(Writer writer);
  void settle();

 private:
  void compare();

  const std::shared_ptr<Buffer> buffer_;
  std::unordered_map<Writer, std::vector<FrameId>> last_messages_;
  std::vector<FrameId> inherited_;
};

}  // namespace coframe
