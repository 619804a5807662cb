// SPDX-License-Identifier: Apache-2.0
// DDS -> serialised messages with the time at which each came, taken by whoever looks now and then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "wire/data_reader.hpp"
#include "wire/qos.hpp"

namespace coframe {

class Tap {
 public:
  // Messages, the oldest first: when each came by the system's clock, when its writer says it was sent (both
  // nanoseconds since 1970), by whom, and where its first bytes end among those of all of them.
  struct Messages {
    std::vector<std::int64_t> arrived, sent;
    std::vector<dds::Handle> writers;
    std::vector<std::uint64_t> ends;
    std::string bytes;
  };

  // Keeps the first `head` bytes of each message, and so many messages; what comes while it is full is counted only.
  Tap(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
      std::size_t head, std::size_t capacity);
  void close() noexcept { reader_.close(); }

  // What has come since the last call.
  Messages take();
  // How many came while it was full.
  std::uint64_t missed();

  const DataReader& reader() const { return reader_; }

 private:
  static void on_data(dds::Entity reader, void* self) noexcept;
  void drain(dds::Entity reader);

  const std::size_t head_, capacity_;
  std::mutex mutex_;  // of the two below
  Messages messages_;
  std::uint64_t missed_ = 0;
  DataReader reader_;  // last: its callback uses the members above
};

}  // namespace coframe
