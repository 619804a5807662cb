// SPDX-License-Identifier: Apache-2.0
// Stores the transforms of received messages in a buffer, without the GIL, with statistics of each writer. The wire
// that receives the messages does not matter.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/arrival_period.hpp"
#include "core/buffer.hpp"
#include "core/event.hpp"
#include "core/fork_guard.hpp"
#include "core/stamp_delay.hpp"
#include "wire/published_statics.hpp"

namespace coframe {

class TransformStore {
 public:
  using Writer = std::uint64_t;  // a number that the wire gives each writer

  // Statistics of one writer.
  struct WriterStatistics {
    Writer writer;
    std::uint64_t messages;
    std::int64_t received_at;  // nanoseconds of the steady clock
    ArrivalPeriod period;
    StampDelay delay;  // from its stamps to their arrival by the system clock; dynamic transforms only
    NameProblems name_problems;
  };

  // Stores messages as long as it exists; one at a time. A scope of ForkSafeScope.
  class Ingest {
   public:
    explicit Ingest(TransformStore& store) : store_(store), lock_(store.mutex_) {}
    ~Ingest();
    Ingest(const Ingest&) = delete;
    Ingest& operator=(const Ingest&) = delete;

    // Stores the transforms of one message: 4 bytes of encapsulation, then CDR. The buffer counts malformed messages.
    void add(Writer writer, std::span<const std::uint8_t> message);

   private:
    TransformStore& store_;
    const ForkSafeLock<std::mutex> lock_;
  };

  // `authority` is stored as the source of every transform until `name_writer` is called. With a `renaming` (may be
  // null), frames are renamed. `event` (may be null) is set by the next message after `arm`.
  TransformStore(std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
                 std::shared_ptr<const Renaming> renaming, std::shared_ptr<Event> event);

  // Stores `authority` as the source of this writer's past and future transforms.
  void name_writer(Writer writer, const std::string& authority);
  // Forgets a writer that has disappeared.
  void forget_writer(Writer writer);
  // Static transforms of a writer that no longer exists are no longer published, unless another one publishes them.
  void writer_left(Writer writer);
  // Those that the buffer contained before, and that have not been received, are no longer published.
  void settle_statics();

  // Returns the statistics of all writers.
  std::vector<WriterStatistics> writers() const;

  // Returns when transforms were last stored, in nanoseconds of the steady clock; 0: never.
  std::int64_t stored_at() const { return stored_at_; }

  // Lets the next message set the event. Without this, messages wake no thread.
  void arm() { is_armed_ = true; }
  // Returns the number of received messages.
  std::uint64_t received() const { return received_; }

 private:
  struct Source {
    TransformStream stream;
    bool has_name = false;
    std::uint64_t messages = 0;
    std::int64_t received_at = 0;
    ArrivalPeriod period;
    StampDelay delay;
  };

  Source& source_of(Writer writer);

  std::shared_ptr<Buffer> buffer_;
  const bool is_static_;
  const std::string authority_;
  const std::shared_ptr<const Renaming> renaming_;
  mutable std::mutex mutex_;                    // protects the sources and what is published
  std::unordered_map<Writer, Source> sources_;  // by writer
  std::optional<PublishedStatics> published_;   // for static transforms in shared data
  std::atomic<std::int64_t> stored_at_ = 0;
  std::atomic<std::uint64_t> received_ = 0;
  std::atomic<bool> is_armed_ = false;
  const std::shared_ptr<Event> event_;
};

}  // namespace coframe
