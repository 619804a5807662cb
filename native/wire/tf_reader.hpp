// DDS -> buffer: transforms are stored on DDS's own thread, without Python and its lock.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/buffer.hpp"
#include "core/arrival_period.hpp"
#include "core/stamp_delay.hpp"
#include "wire/data_reader.hpp"
#include "wire/qos.hpp"

namespace coframe {

class TfReader {
 public:
  // What one writer has sent so far.
  struct WriterStatistics {
    dds::Handle writer;
    std::uint64_t messages;
    std::int64_t received_at;  // nanoseconds of the steady clock
    ArrivalPeriod period;
    StampDelay delay;                // behind the system clock; of transforms that are not static
    NameProblems name_problems;
  };

  // `authority` is what the buffer notes as the source of every transform, until `name_writer` says better. With a
  // `renaming` (may be null) the buffer gets the frames under the names that it makes.
  TfReader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
           std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
           std::shared_ptr<const Renaming> renaming);
  void close() noexcept { reader_.close(); }

  // The buffer notes `authority` for what this writer has sent and will send.
  void name_writer(dds::Handle writer, const std::string& authority);
  // The writer has left.
  void forget_writer(dds::Handle writer);

  // Of each writer that is remembered.
  std::vector<WriterStatistics> writers() const;

  // When the newest message's transforms were in the buffer, in nanoseconds of the steady clock; 0: never.
  std::int64_t stored_at() const { return stored_at_; }

  const DataReader& reader() const { return reader_; }

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
  mutable std::mutex mutex_;                          // of the sources
  std::unordered_map<dds::Handle, Source> sources_;  // by writer
  std::atomic<std::int64_t> stored_at_ = 0;
  DataReader reader_;                                 // last: its callback uses the members above
};

}  // namespace coframe
