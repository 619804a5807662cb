// SPDX-License-Identifier: Apache-2.0
// Receives transforms and stores them in a buffer, in the thread of DDS and without the GIL.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/arrival_period.hpp"
#include "core/buffer.hpp"
#include "core/stamp_delay.hpp"
#include "wire/data_reader.hpp"
#include "wire/event.hpp"
#include "wire/qos.hpp"

namespace coframe {

class TfReader {
 public:
  // Statistics of one writer.
  struct WriterStatistics {
    dds::Handle writer;
    std::uint64_t messages;
    std::int64_t received_at;  // nanoseconds of the steady clock
    ArrivalPeriod period;
    StampDelay delay;  // from its stamps to their arrival by the system clock; dynamic transforms only
    NameProblems name_problems;
  };

  // `authority` is stored as the source of every transform until `name_writer` is called. With a `renaming` (may be
  // null), frames are renamed. `on_data` (may be null) is set when a status changes, and by the next message after
  // `arm`.
  TfReader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
           std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
           std::shared_ptr<const Renaming> renaming, std::shared_ptr<Event> on_data);
  void close() noexcept { reader_.close(); }

  // Stores `authority` as the source of this writer's past and future transforms.
  void name_writer(dds::Handle writer, const std::string& authority);
  // Forgets a writer that has disappeared.
  void forget_writer(dds::Handle writer);

  // Returns the statistics of all writers.
  std::vector<WriterStatistics> writers() const;

  // Returns when transforms were last stored, in nanoseconds of the steady clock; 0: never.
  std::int64_t stored_at() const { return stored_at_; }

  // Lets the next message set the event. Without this, messages wake no thread.
  void arm() { armed_ = true; }
  // Returns the number of received messages.
  std::uint64_t received() const { return received_; }

  const DataReader& reader() const { return reader_; }
  DataReader& reader() { return reader_; }

 private:
  struct Source {
    TransformStream stream;
    bool named = false;
    std::uint64_t messages = 0;
    std::int64_t received_at = 0;
    ArrivalPeriod period;
    StampDelay delay;
  };

  static void on_data(dds::Entity reader, void* self) noexcept;
  void drain(dds::Entity reader);
  void store(const dds::Sample& sample);
  Source& source_of(dds::Handle writer);

  std::shared_ptr<Buffer> buffer_;
  const bool is_static_;
  const std::string authority_;
  const std::shared_ptr<const Renaming> renaming_;
  mutable std::mutex mutex_;                         // protects the sources
  std::unordered_map<dds::Handle, Source> sources_;  // by writer
  std::atomic<std::int64_t> stored_at_ = 0;
  std::atomic<std::uint64_t> received_ = 0;
  std::atomic<bool> armed_ = false;
  const std::shared_ptr<Event> event_;
  DataReader reader_;  // last: its callback uses the members above
};

}  // namespace coframe
