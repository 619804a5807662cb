// SPDX-License-Identifier: Apache-2.0
// The status changes of a reader or writer, such as a missed deadline, recorded on DDS threads for Python to take.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "core/event.hpp"
#include "wire/dds.hpp"

namespace coframe {

class StatusEvents {
 public:
  enum Kind : std::size_t { kDeadlineMissed, kLiveliness, kIncompatibleQos, kMatched, kSampleLost, kKinds };
  // The members of the DDS status, in their order; handles are left out, and 0 stands for missing members.
  using Counts = std::array<std::int64_t, 4>;

  // `on_change` (may be null) is set whenever a status has changed. The DDS threads do not own it.
  explicit StatusEvents(std::shared_ptr<Event> on_change) : on_change_(std::move(on_change)) {}
  StatusEvents(const StatusEvents&) = delete;
  StatusEvents& operator=(const StatusEvents&) = delete;

  // Adds the callbacks to a listener. This object must exist as long as the listener is attached.
  void add_to_writer(dds::Listener* listener);
  void add_to_reader(dds::Listener* listener);

  // Returns the counts if they have changed since the last call. The changes are those since the last call.
  std::optional<Counts> take(Kind kind);

 private:
  template <Kind kind, class Status>
  static void on_status(dds::Entity, Status status, void* self) noexcept;

  const std::shared_ptr<Event> on_change_;
  std::mutex mutex_;
  std::array<std::optional<Counts>, kKinds> changed_;
};

}  // namespace coframe
