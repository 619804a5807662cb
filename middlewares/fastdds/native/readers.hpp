// SPDX-License-Identifier: Apache-2.0
// Subscriptions: one that queues messages, one that records them, and one that stores transforms. None uses Python.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <vector>

#include "participant.hpp"
#include "status_events.hpp"

namespace coframe::fastdds {

// Receives serialized messages on the threads of Fast DDS.
class DataReader : protected dds::DataReaderListener {
 public:
  DataReader(std::shared_ptr<Participant> participant, std::string topic, std::string type, void* on_change);
  // Classes that override `on_data` call close() in their destructors.
  ~DataReader() override { close(); }
  // No callback runs afterwards.
  void close() noexcept;

  rtps::GUID_t guid() const { return guid_; }
  StatusEvents& events() { return events_; }
  const StatusEvents& events() const { return events_; }

 protected:
  // Called last by the constructors of derived classes, because messages may arrive at once.
  void start(const Qos& qos, const std::string& user_data);
  // Messages may have arrived.
  virtual void on_data(dds::DataReader& reader) = 0;
  // Calls `use` with the reader unless it is closed.
  template <class Use>
  void with_reader(Use&& use) {
    check_not_forked();
    const std::shared_lock lock(closing_);
    if (reader_ != nullptr) use(*reader_);
  }

 private:
  void on_data_available(dds::DataReader* reader) override;
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    events_.add_matched(status, status.last_publication_handle);
  }
  void on_requested_deadline_missed(dds::DataReader*, const DeadlineMissedStatus& status) override {
    events_.add_total(StatusEvents::kDeadlineMissed, status);
  }
  void on_liveliness_changed(dds::DataReader*, const LivelinessChangedStatus& status) override {
    events_.add_liveliness(status);
  }
  void on_requested_incompatible_qos(dds::DataReader*, const dds::RequestedIncompatibleQosStatus& status) override {
    events_.add_incompatible(status);
  }
  void on_sample_lost(dds::DataReader*, const dds::SampleLostStatus& status) override {
    events_.add_total(StatusEvents::kSampleLost, status);
  }

  const std::shared_ptr<Participant> participant_;
  const std::string topic_, type_;
  StatusEvents events_;
  mutable std::shared_mutex closing_;  // held by users of the reader, and exclusively while it is closed
  dds::Subscriber* subscriber_ = nullptr;
  dds::DataReader* reader_ = nullptr;
  rtps::GUID_t guid_;
};

struct Message {
  Incoming bytes;
  std::int64_t sent;  // nanoseconds since 1970 by the writer's clock
  Handle writer;
  rtps::SampleIdentity identity, related;  // what identifies requests and replies
};

// Queues messages in Fast DDS. The thread that waits for the event takes them.
class Reader final : public DataReader {
 public:
  // `on_data` (may be null) is set when messages arrive or a status changes.
  Reader(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
         const std::string& user_data, void* on_data);
  ~Reader() override { close(); }

  // Returns up to `limit` messages, oldest first.
  std::vector<Message> take(std::uint32_t limit);
  // Returns whether messages may be waiting; false positives are possible, false negatives are not.
  bool pending() const { return pending_; }

 private:
  void on_data(dds::DataReader& reader) override;

  void* const event_;
  std::atomic<bool> pending_ = true;
};

// Records messages with their arrival times. The user polls for them.
class Tap final : public DataReader {
 public:
  struct Messages {
    std::vector<std::int64_t> arrived, sent;
    std::vector<Handle> writers;
    std::vector<std::uint64_t> ends;
    std::string bytes;
  };
  // What is kept until take(). Messages beyond `messages` or `size` are only counted.
  struct Limits {
    std::size_t head;  // bytes of each message
    std::size_t messages;
    std::size_t size;  // bytes of all messages
  };

  Tap(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
      const std::string& user_data, const Limits& limits);
  ~Tap() override { close(); }

  // Returns the messages since the last call.
  Messages take();
  // Returns how many messages were dropped because a limit was reached.
  std::uint64_t missed();

 private:
  void on_data(dds::DataReader& reader) override;

  const Limits limits_;
  std::mutex mutex_;  // protects the two members below
  Messages messages_;
  std::uint64_t missed_ = 0;
};

// Stores transforms in a `coframe._core.TransformStore`.
class TfReader final : public DataReader {
 public:
  TfReader(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
           const std::string& user_data, void* store, void* on_change);
  ~TfReader() override { close(); }

 private:
  void on_data(dds::DataReader& reader) override;

  void* const store_;
  std::mutex mutex_;  // protects the member below
  Incoming message_;  // its memory is kept
};

}  // namespace coframe::fastdds
