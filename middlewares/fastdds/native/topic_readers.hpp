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
    bool has_own;         // Fast DDS may call readers of this process while a message is sent
  };

  // Returns nothing if messages must be sent as they are, because a reader needs that.
  std::optional<Sharing> share() const {
    std::shared_lock lock(mutex_);
    if (readers_.empty() || others_ > 0) return std::nullopt;
    return Sharing{std::move(lock), readers_.size(), depth_, has_own_};
  }

  // Called before the reader can receive messages. `is_own`: it is in this process.
  void add(Handle reader, std::string_view user_data, bool is_own) {
    const std::optional<std::uint32_t> depth = depth_in(user_data);
    const std::unique_lock lock(mutex_);
    readers_.insert_or_assign(reader, Entry{depth, is_own});
    count();
  }

  // Returns whether no reader remains.
  bool remove(Handle reader) {
    const std::unique_lock lock(mutex_);
    readers_.erase(reader);
    count();
    return readers_.empty();
  }

 private:
  struct Entry {
    std::optional<std::uint32_t> depth;  // nothing: the reader cannot read blocks
    bool is_own;
  };

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
    has_own_ = false;
    for (const auto& [reader, entry] : readers_) {
      others_ += entry.depth ? 0 : 1;
      depth_ = std::max<std::size_t>(depth_, entry.depth.value_or(0));
      has_own_ = has_own_ || entry.is_own;
    }
  }

  mutable std::shared_mutex mutex_;  // protects the members below
  std::map<Handle, Entry> readers_;
  std::size_t others_ = 0, depth_ = 0;
  bool has_own_ = false;
};

}  // namespace coframe::fastdds
