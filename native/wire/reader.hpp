// SPDX-License-Identifier: Apache-2.0
// Receives serialized messages of any type. The thread that waits for the event takes them.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "core/event.hpp"
#include "wire/data_reader.hpp"
#include "wire/qos.hpp"

namespace coframe {

class Reader {
 public:
  // `on_data` (may be null) is set whenever samples arrive or a status changes.
  Reader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
         std::shared_ptr<Event> on_data);
  void close() noexcept { reader_.close(); }

  // Returns up to `limit` messages, oldest first.
  std::vector<dds::Sample> take(std::uint32_t limit);
  // Returns whether samples may be waiting; false positives are possible, false negatives are not.
  bool pending() const { return pending_; }

  const DataReader& reader() const { return reader_; }
  DataReader& reader() { return reader_; }

 private:
  static void on_data(dds::Entity, void* self) noexcept;

  std::shared_ptr<Event> event_;
  std::atomic<bool> pending_ = true;  // samples may have arrived before the listener was attached
  DataReader reader_;                 // last: its callback uses the members above
};

}  // namespace coframe
