// SPDX-License-Identifier: Apache-2.0
// The readers of a topic, on all participants: whether all of them can read messages in shared blocks.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <string>
#include <string_view>

#include "shared_blocks.hpp"

namespace coframe::fastdds {

using Handle = std::uint64_t;  // identifies an endpoint in this process

// What a reader adds to its user data if it can read blocks: the pair `coframe_blocks=NAMESPACE,DEPTH;`.
inline std::string blocks_entry(std::uint32_t depth) {
  return "coframe_blocks=" + block_namespace() + "," + std::to_string(depth) + ";";
}

class TopicReaders {
 public:
  // While it exists, no reader is added, so that every reader of the messages that are sent is known.
  struct Sharing {
    std::shared_lock<std::shared_mutex> lock;
    std::size_t readers;  // at most these receive the message
    std::size_t depth;    // the largest history of a reader
  };

  // Returns nothing if messages must be sent as they are, because a reader needs that.
  std::optional<Sharing> share() const {
    std::shared_lock lock(mutex_);
    if (depths_.empty() || others_ > 0) return std::nullopt;
    return Sharing{std::move(lock), depths_.size(), depth_};
  }

  // Called before the reader can receive messages.
  void add(Handle reader, std::string_view user_data) {
    const std::optional<std::uint32_t> depth = depth_in(user_data);
    const std::unique_lock lock(mutex_);
    depths_.insert_or_assign(reader, depth);
    count();
  }

  // Returns whether no reader remains.
  bool remove(Handle reader) {
    const std::unique_lock lock(mutex_);
    depths_.erase(reader);
    count();
    return depths_.empty();
  }

 private:
  static std::optional<std::uint32_t> depth_in(std::string_view user_data) {
    const std::string& name = block_namespace();
    if (name.empty()) return std::nullopt;
    const std::string begin = "coframe_blocks=" + name + ",";
    const std::size_t found = user_data.find(begin);
    if (found == std::string_view::npos) return std::nullopt;
    std::uint32_t depth = 0;
    const char* number = user_data.data() + found + begin.size();
    const char* end = user_data.data() + user_data.size();
    if (std::from_chars(number, end, depth).ec != std::errc()) return std::nullopt;
    return depth;
  }

  void count() {
    others_ = depth_ = 0;
    for (const auto& [reader, depth] : depths_) {
      others_ += depth ? 0 : 1;
      depth_ = std::max<std::size_t>(depth_, depth.value_or(0));
    }
  }

  mutable std::shared_mutex mutex_;                        // protects the members below
  std::map<Handle, std::optional<std::uint32_t>> depths_;  // nothing: the reader cannot read blocks
  std::size_t others_ = 0, depth_ = 0;
};

}  // namespace coframe::fastdds
