// SPDX-License-Identifier: Apache-2.0
// The participants found by DDS discovery, including that of this process.
#pragma once

#include <cstddef>
#include <memory>
#include <unordered_set>

#include "wire/data_reader.hpp"
#include "wire/event.hpp"

namespace coframe {

class ParticipantReader {
 public:
  // `on_change` is set whenever a participant appears, changes or disappears.
  ParticipantReader(dds::Entity participant, std::shared_ptr<Event> on_change);
  void close() noexcept { reader_.close(); }
  // Returns how many participants have appeared since the last call.
  std::size_t take_new();

 private:
  static void on_data(dds::Entity, void* self) noexcept;

  std::shared_ptr<Event> event_;
  std::unordered_set<dds::Handle> known_;
  DataReader reader_;  // last: its callback uses the members above
};

}  // namespace coframe
