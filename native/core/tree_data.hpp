// SPDX-License-Identifier: Apache-2.0
// What a tree stores. The data contain no ordinary pointers, so several processes can map them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/guarded_memory.hpp"
#include "core/history.hpp"
#include "core/memory.hpp"
#include "core/name_table.hpp"
#include "core/stable_vector.hpp"

namespace coframe {

using AuthorityId = std::uint32_t;  // 0 is "no recorded authority"

struct Frame {
  // What happened to the samples of the frame since the buffer was created.
  struct Counts {
    RelaxedAtomic<std::uint64_t> stored;
    RelaxedAtomic<std::uint64_t> late;                   // of these, inserted before newer ones
    RelaxedAtomic<std::uint64_t> repeated;               // exact repetitions, which change nothing
    RelaxedAtomic<std::uint64_t> old;                    // rejected as older than the cache
    RelaxedAtomic<std::uint64_t> self, nan, quaternion;  // rejected for these reasons

    void add(Insertion outcome);
    void refuse(unsigned refusals);
    void copy(const Counts& other);
  };

  Name name;
  History history;  // kind none: the root of a tree
  RelaxedAtomic<AuthorityId> authority;
  RelaxedAtomic<bool> known{false};  // false after the frame was removed
  Counts counts;
};

// What the buffer of a tree counts.
struct Counts {
  std::uint64_t messages = 0;    // TFMessages received as bytes
  std::uint64_t malformed = 0;   // of those, not decodable
  std::uint64_t stored = 0;      // transforms
  std::uint64_t refused = 0;     // transforms with invalid names or values, or for a frozen buffer
  std::uint64_t old = 0;         // transforms older than the cache
  std::uint64_t over_limit = 0;  // of the refused transforms, those for which there was no room
};

// The same in the data of a tree, where other processes read them.
struct TreeCounts {
  RelaxedAtomic<std::uint64_t> messages, malformed, stored, refused, old, over_limit;

  Counts get() const { return {messages, malformed, stored, refused, old, over_limit}; }
  void set(const Counts& counts);
};

// The data of a tree: on the heap of a process, or in memory that several processes map.
struct TreeData {
  Stamp cache_length = 0;
  Revision revision;
  StableVector<Frame> frames;
  NameTable frame_numbers;
  StableVector<Name> authorities;
  NameTable authority_numbers;
  Atomic<std::uint64_t> version{1};
  Atomic<std::uint64_t> changes{0};  // incremented after every change; see Buffer
  TreeCounts counts;
  // Of shared data:
  Atomic<std::uint64_t> outdated{0};  // 1: contains static transforms that are no longer published
  Interrupted interrupted;
  ChunkList chunks;
  RelativePointer<Chunk> nothing;
};

// Prepares new data, before they have readers. `version` must differ from that of all data that they replace.
void initialize(TreeData& data, Memory& memory, Stamp cache_length, std::uint64_t version);

// What a process does with shared data beyond reading and writing them.
class SharedAccess {
 public:
  virtual ~SharedAccess() = default;
  // For a reader that has waited for the end of a change: completes it if its writer has died. Returns false if the
  // writer lives.
  virtual bool complete_change() = 0;
  // Says whose change does not end, and what to do.
  virtual std::string unfinished_change() const = 0;
  // Waits until the number of changes is not `known_changes`, until a call of wake(), or until `timeout_ns` has passed.
  virtual void wait_for_change(std::uint64_t known_changes, std::int64_t timeout_ns) = 0;
  virtual void wake() = 0;
};

// Shared data as one process maps them.
struct SharedTreeData {
  TreeData* data = nullptr;
  std::shared_ptr<Memory> memory;  // of the writer; nullptr: read only
  std::shared_ptr<SharedAccess> access;
  std::shared_ptr<GuardedMemory> mapped = {};  // where the data are
  std::string authority = {};                  // of a reader: the source of all transforms; empty: the recorded ones
};

}  // namespace coframe
