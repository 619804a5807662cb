// SPDX-License-Identifier: Apache-2.0
// Publishes serialized messages.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string>
#include <vector>

#include "participant.hpp"
#include "shared_blocks.hpp"
#include "status_events.hpp"

namespace coframe::fastdds {

class Writer final : dds::DataWriterListener {
 public:
  // `on_change` (may be null) is set when a status changes.
  Writer(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
         const std::string& user_data, bool checks_transforms, void* on_change);
  ~Writer() override { close(); }
  void close() noexcept;
  bool closed() const { return writer_ == nullptr; }

  // Sends a message in parts, of `size` bytes together, and returns its sequence number. Throws std::invalid_argument
  // for less than 4 bytes. `related` is the identity that accompanies requests and replies; it may be null.
  std::int64_t write(std::span<const coframe_part> parts, std::size_t size,
                     const rtps::SampleIdentity* related = nullptr);
  // Sends a message without a payload. Cyclone DDS acknowledges it, and delivers it to no reader.
  void write_nothing();
  // Returns whether a message may be written: damaged transforms may not.
  bool accepts(std::span<const coframe_part> parts) const;

  rtps::GUID_t guid() const { return guid_; }
  StatusEvents& events() { return events_; }
  const StatusEvents& events() const { return events_; }
  void assert_liveliness();
  // Waits until all reliable readers have received all messages. Returns false after the timeout.
  bool wait_for_acks(std::int64_t timeout_ns);

 private:
  void on_publication_matched(dds::DataWriter*, const dds::PublicationMatchedStatus& status) override;
  void on_offered_deadline_missed(dds::DataWriter*, const DeadlineMissedStatus& status) override {
    events_.add_total(StatusEvents::kDeadlineMissed, status);
  }
  void on_offered_incompatible_qos(dds::DataWriter*, const dds::OfferedIncompatibleQosStatus& status) override {
    events_.add_incompatible(status);
  }
  void on_liveliness_lost(dds::DataWriter*, const dds::LivelinessLostStatus& status) override {
    events_.add_total(StatusEvents::kLiveliness, status);
  }
  dds::DataWriter& open() const;
  // The readers of this process that were matched since the last message receive the latched ones first, which a new
  // message may replace. Fast DDS sends them on another thread.
  void deliver_history();
  std::int64_t send(Outgoing& message, const rtps::SampleIdentity* related);
  // Sends a reference to the message in a block. Returns nothing if a reader needs the message itself.
  std::optional<std::int64_t> send_in_block(std::span<const coframe_part> parts, std::size_t size);
  // Waits until the readers have finished with the messages in blocks. Returns false after the timeout.
  bool wait_for_blocks(std::int64_t timeout_ns) const;

  std::shared_ptr<Participant> participant_;  // null after close()
  const std::string topic_, type_;
  const bool checks_transforms_;
  const bool shares_blocks_;
  const bool is_latched_;
  const std::size_t depth_;
  StatusEvents events_;
  mutable std::shared_mutex closing_;  // held by users of the writer, and exclusively while it is closed
  dds::Publisher* publisher_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
  rtps::GUID_t guid_;
  std::atomic<bool> has_late_reader_ = false;  // one of this process, which was matched since the last message
  std::shared_ptr<TopicReaders> readers_;
  mutable std::mutex blocks_mutex_;  // protects the member below
  std::optional<BlockPool> blocks_;
};

}  // namespace coframe::fastdds
