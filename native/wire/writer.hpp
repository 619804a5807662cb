// SPDX-License-Identifier: Apache-2.0
// Publishes serialized messages.
#pragma once

#include <atomic>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "wire/dds.hpp"
#include "wire/qos.hpp"
#include "wire/status_events.hpp"

namespace coframe {

class Writer {
 public:
  // `checks_transforms`: the messages are transforms, and `write` refuses damaged ones. `on_change` (may be null) is
  // set when a status changes. The topic is released.
  Writer(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
         bool checks_transforms, std::shared_ptr<Event> on_change);
  ~Writer() { close(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Sends one message: 4 bytes of encapsulation, then CDR. Throws std::invalid_argument for less than 4 bytes.
  void write(const void* data, std::size_t size) const;
  // The same for a message in several parts, of `size` bytes together. The first part has the encapsulation.
  void write(std::span<const dds::IoVector> parts, std::size_t size) const;
  // Sends one message without checking its bytes.
  void forward(const void* data, std::size_t size) const;
  void close() noexcept;
  bool closed() const { return entity_ == 0; }

  dds::Guid guid() const;
  std::uint32_t matched() const;
  std::vector<dds::Handle> matched_handles() const;
  dds::IncompatibleQosStatus incompatible() const;
  StatusEvents& events() { return events_; }
  // Shows the readers that this writer is alive.
  void assert_liveliness() const;
  // Waits until all reliable readers have received all messages. Returns false after the timeout.
  bool wait_for_acks(std::int64_t timeout_ns) const;

 private:
  dds::Code pass_on(std::span<const dds::IoVector> parts, std::size_t size) const;

  const bool checks_transforms_;
  StatusEvents events_;
  mutable std::mutex closing_;  // held while the type is used, because close() deletes it
  std::atomic<dds::Entity> entity_ = 0;
  const dds::Sertype* type_ = nullptr;
};

}  // namespace coframe
