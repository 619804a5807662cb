// SPDX-License-Identifier: Apache-2.0
// Large messages in memory that the processes of one user share. The writer copies a message into a block and sends a
// reference of a few bytes through Fast DDS; the reader decodes the message where it is.
//
// A block is an anonymous file (memfd). It disappears with the last process that has mapped it, it cannot be truncated,
// and other processes of the user open it through /proc/PID/fd. Linux only: elsewhere no block can be created.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace coframe::fastdds {

using Guid = std::array<std::uint8_t, 16>;

// The beginning of a block. The data follow it.
struct alignas(64) BlockHeader {
  std::uint64_t magic;
  std::uint64_t token;  // differs between blocks
  std::uint64_t size;   // of the data
  Guid writer;
  // From high to low: 32 bits, the number of the message; 16 bits, readers that have not finished with it; 16 bits,
  // readers that are reading it.
  std::atomic<std::uint64_t> state;
  std::atomic<std::uint32_t> complete;  // the number of the last message whose bytes are all there
  std::atomic<std::uint32_t> retired;   // not 0: the writer no longer uses the block
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free);

// A block that this process has mapped.
class Block {
 public:
  // Takes the mapping and the file descriptor; `file` may be -1.
  Block(void* memory, std::size_t size, int file) : memory_(memory), size_(size), file_(file) {}
  ~Block();
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

  BlockHeader& header() const { return *static_cast<BlockHeader*>(memory_); }
  std::uint8_t* data() const { return static_cast<std::uint8_t*>(memory_) + sizeof(BlockHeader); }
  std::size_t capacity() const { return size_ - sizeof(BlockHeader); }
  int file() const { return file_; }

 private:
  void* memory_;
  std::size_t size_;
  int file_;
};

// What is sent instead of a message.
struct BlockReference {
  std::uint8_t encapsulation[4];  // one that no other message has
  std::int32_t process;
  std::int32_t file;
  std::uint32_t number;  // of the message
  std::uint64_t token;
  std::uint64_t size;
};

inline constexpr std::uint8_t kReferenceEncapsulation[4] = {0xc0, 0xf0, 0x00, 0x01};

// The blocks of a writer. Not thread-safe.
class BlockPool {
 public:
  static constexpr std::size_t kMaxBlocks = 64;
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 30;  // of all blocks

  explicit BlockPool(const Guid& writer) : writer_(writer) {}
  ~BlockPool() { clear(); }

  // Returns a block for a message of `size` bytes that `readers` readers will read. The `kept_count` newest messages
  // keep their blocks until all readers have finished with them. Returns null if the message cannot be shared.
  Block* take(std::size_t size, std::size_t readers, std::size_t kept_count);
  // Refers to the message in the newest block. It may be sent before the message is complete.
  BlockReference reference(std::size_t size) const;
  // All bytes of the message in the newest block are there: wakes the readers that wait for them.
  void complete();
  // Whether all readers have finished with all messages.
  bool finished() const;
  void clear();

 private:
  bool has_room(std::size_t size) const;
  Block* reuse(std::size_t position, std::size_t readers);
  Block* create(std::size_t size, std::size_t readers);
  void forget(std::size_t position);

  const Guid writer_;
  std::uint32_t number_ = 0;
  std::vector<std::unique_ptr<Block>> blocks_;  // the newest message is in the last one
};

// A message in a block. The writer does not use the block for another message while this object exists.
class BlockMessage {
 public:
  BlockMessage(std::shared_ptr<Block> block, std::size_t size) : block_(std::move(block)), size_(size) {}
  BlockMessage(BlockMessage&&) = default;
  BlockMessage& operator=(BlockMessage&&) = delete;
  ~BlockMessage();

  std::span<const std::uint8_t> bytes() const { return {block_->data(), size_}; }

 private:
  std::shared_ptr<Block> block_;
  std::size_t size_;
};

// The blocks that a reader has mapped. Thread-safe.
class BlockMap {
 public:
  static bool is_reference(std::span<const std::uint8_t> bytes);
  // Returns the message that `reference`, which was received from `writer`, refers to, once it is complete; nothing if
  // the writer has already replaced it or has died, or if the block cannot be opened.
  std::optional<BlockMessage> find(const Guid& writer, std::span<const std::uint8_t> reference);
  // Whether a block could not be opened.
  bool failed() const { return failed_; }
  // The writer no longer exists. Its messages may still be in the queue of the reader.
  void writer_left(const Guid& writer);
  // The queue is empty: unmaps the blocks of writers that no longer exist.
  void queue_is_empty();

 private:
  std::shared_ptr<Block> open(const Guid& writer, const BlockReference& reference);

  std::atomic<bool> failed_ = false;
  std::mutex mutex_;  // protects the members below
  std::map<Guid, std::vector<std::shared_ptr<Block>>> blocks_;
  std::vector<Guid> left_;
};

// Two processes with the same name can share blocks. Empty if this process cannot.
const std::string& block_namespace();

}  // namespace coframe::fastdds
