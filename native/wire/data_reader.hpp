// SPDX-License-Identifier: Apache-2.0
// A DDS reader with a data listener; the common part of all readers in this folder.
#pragma once

#include <atomic>
#include <vector>

#include "wire/dds.hpp"
#include "wire/status_events.hpp"

namespace coframe {

// Calls `on_data(entity, argument)` on DDS threads, one call at a time, from before the constructor returns until
// `close` returns. Samples may arrive before the listener is attached, so the owner must check once itself.
// The topic is released. With `on_change`, status changes are recorded in `events()`.
class DataReader {
 public:
  DataReader(dds::Entity participant, dds::Entity topic, const dds::Qos* qos, dds::DataCallback on_data, void* argument,
             std::shared_ptr<Event> on_change = nullptr);
  ~DataReader() { close(); }
  DataReader(const DataReader&) = delete;
  DataReader& operator=(const DataReader&) = delete;

  // Waits for a running callback; none runs afterwards. Must not be called from the callback.
  void close() noexcept;

  dds::Entity entity() const { return entity_; }  // 0 after close
  dds::Guid guid() const;
  std::uint32_t matched() const;
  std::vector<dds::Handle> matched_handles() const;
  dds::IncompatibleQosStatus incompatible() const;
  StatusEvents& events() { return events_; }

 private:
  StatusEvents events_;
  std::atomic<dds::Entity> entity_ = 0;
};

}  // namespace coframe
