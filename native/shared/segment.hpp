// SPDX-License-Identifier: Apache-2.0
// A transform tree in memory that the processes of one user on one machine share. The first process writes it, all
// others map it read-only. Linux only: elsewhere open() throws.
//
// The files of a tree NAME in a folder that only this user can enter:
//   NAME        the memory. Every process that has it open holds a shared lock (flock) on it.
//   NAME.lock   a named pipe. The writer holds an exclusive lock on it and has it open for writing; both end with its
//               process. The others wait for the end of the pipe, so they notice the end of the writer immediately.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "core/tree_data.hpp"

namespace coframe {

// Sharing is not possible; the text says why.
struct SegmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Segment : public std::enable_shared_from_this<Segment> {
 public:
  // What a tree may take. Memory is used only as far as it is needed.
  static constexpr std::size_t kCapacity = 256 << 20;

  // Opens the tree of that name in a folder, which is created. A tree that no other process has open is replaced by an
  // empty one: its transforms are those of programs that have ended.
  static std::shared_ptr<Segment> open(const std::string& folder, const std::string& name, Stamp cache_length,
                                       std::size_t capacity = kCapacity);
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;
  virtual ~Segment() = default;

  // The read-only data, for any number of buffers of this process.
  virtual SharedTreeData reader() = 0;
  // Becomes the writer if there is none. Returns false if another process is.
  virtual bool try_to_write() = 0;
  // The data of the writer, for one buffer. Requires that try_to_write() has returned true.
  virtual SharedTreeData writer() = 0;
  virtual void stop_writing() = 0;
  // The number of the process that writes, or wrote last.
  virtual std::int64_t writer_process() const = 0;
  // Waits until there may be no writer, until a call of interrupt(), or until `timeout_ns` has passed.
  virtual void wait_for_vacancy(std::int64_t timeout_ns) = 0;
  virtual void interrupt() = 0;
  // Whether the tree contains static transforms that are no longer published: a new subscription would not receive
  // them.
  virtual bool outdated() const = 0;
  // Bytes of the tree in use.
  virtual std::size_t used() const = 0;
  // Whether another program has truncated the memory.
  virtual bool lost() const = 0;
  // Why the tree could not grow; empty if it could. From then on, it drops the oldest samples and refuses new frames.
  virtual std::string shortage() const = 0;
  // Gives up writing, and no longer counts as a process that has the tree open. Readers may continue to read.
  virtual void close() = 0;

 protected:
  Segment() = default;
};

}  // namespace coframe
