// SPDX-License-Identifier: Apache-2.0
// Receives serialized messages with their arrival times. The user polls for them.
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
  // Messages, oldest first: arrival time by the system clock, send time by the writer's clock (both in nanoseconds
  // since 1970), the writer, and the end of the stored bytes of each.
  struct Messages {
    std::vector<std::int64_t> arrived, sent;
    std::vector<dds::Handle> writers;
    std::vector<std::uint64_t> ends;
    std::string bytes;
  };

  // What is kept until take(). Messages beyond `messages` or `size` are only counted.
  struct Limits {
    std::size_t head;  // bytes of each message
    std::size_t messages;
    std::size_t size;  // bytes of all messages
  };

  Tap(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
      const Limits& limits);
  void close() noexcept { reader_.close(); }

  // Returns the messages since the last call.
  Messages take();
  // Returns how many messages were dropped because a limit was reached.
  std::uint64_t missed();

  const DataReader& reader() const { return reader_; }
  DataReader& reader() { return reader_; }

 private:
  static void on_data(dds::Entity reader, void* self) noexcept;
  void drain(dds::Entity reader);

  const Limits limits_;
  std::mutex mutex_;  // protects the two members below
  Messages messages_;
  std::uint64_t missed_ = 0;
  DataReader reader_;  // last: its callback uses the members above
};

}  // namespace coframe
