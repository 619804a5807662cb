// SPDX-License-Identifier: Apache-2.0
// Subscriptions: one that queues messages, one that records them, and one that stores transforms. None uses Python.
#pragma once

#include <atomic>
#include <cstdint>
#include <fastdds/dds/core/LoanableSequence.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "participant.hpp"
#include "shared_blocks.hpp"
#include "status_events.hpp"

namespace coframe::fastdds {

// A message that was taken from a reader. The bytes are in the memory of Fast DDS, or in that of the writer's process.
struct Message {
  Incoming bytes;
  std::int64_t sent;  // nanoseconds since 1970 by the writer's clock
  Handle writer;
  rtps::SampleIdentity identity, related;  // what identifies requests and replies
};

// Messages that were taken together, oldest first. Their bytes are valid as long as this object.
class Batch {
 public:
  // The most messages in a batch; a default of Fast DDS.
  static constexpr std::uint32_t kMaxMessages = 32;

  // `ignored` counts messages that are too short to be any.
  Batch(dds::DataReader& reader, BlockMap& blocks, Counter& ignored, std::uint32_t limit);
  ~Batch() { reader_.return_loan(samples_, infos_); }
  Batch(const Batch&) = delete;
  Batch& operator=(const Batch&) = delete;

  // Whether nothing was waiting.
  bool empty() const { return infos_.length() == 0; }
  // Whether there are messages. Fast DDS also reports writers that have left, without a message.
  bool has_messages() const;
  // Whether more messages may be waiting.
  bool full() const { return static_cast<std::uint32_t>(infos_.length()) == limit_; }

  template <class Use>
  void each(Use&& use) const {
    constexpr std::size_t kHeaderSize = 4;
    for (int i = 0; i < infos_.length(); ++i) {
      const dds::SampleInfo& info = infos_[i];
      if (!info.valid_data) continue;
      const auto found = messages_.find(i);
      if (found == messages_.end() && BlockMap::is_reference(samples_[i])) continue;
      const Incoming bytes = found == messages_.end() ? samples_[i] : found->second.bytes();
      if (bytes.empty()) continue;  // from Writer::write_nothing
      if (bytes.size() < kHeaderSize) {
        ++ignored_;
        continue;
      }
      use(Message{bytes, info.source_timestamp.to_ns(), handle_of(info.sample_identity.writer_guid()),
                  info.sample_identity, info.related_sample_identity});
    }
  }

 private:
  dds::DataReader& reader_;
  Counter& ignored_;
  const std::uint32_t limit_;
  dds::LoanableSequence<Incoming> samples_;
  dds::SampleInfoSeq infos_;
  std::map<int, BlockMessage> messages_;  // those that are in blocks, by their position
};

// Receives serialized messages on the threads of Fast DDS.
class DataReader : protected dds::DataReaderListener {
 public:
  DataReader(std::shared_ptr<Participant> participant, std::string topic, std::string type, void* on_change);
  // Classes that override `on_data` call close() in their destructors.
  ~DataReader() override { close(); }
  // No callback runs afterwards. If the reader is in use, its last user deletes it.
  void close() noexcept;

  rtps::GUID_t guid() const { return guid_; }
  StatusEvents& events() { return events_; }
  const StatusEvents& events() const { return events_; }

  // The reader is not deleted while this object exists.
  class Access {
   public:
    explicit Access(DataReader& reader) : reader_(reader), native_(reader.enter()) {}
    ~Access() {
      if (native_ != nullptr) reader_.leave();
    }
    Access(const Access&) = delete;
    Access& operator=(const Access&) = delete;

    // Null if the reader is closed.
    dds::DataReader* native() const { return native_; }

   private:
    DataReader& reader_;
    dds::DataReader* const native_;
  };

 protected:
  // Called last by the constructors of derived classes, because messages may arrive at once. `reads_blocks`: the class
  // calls withdraw_blocks().
  void start(const Qos& qos, const std::string& user_data, bool reads_blocks);
  // Messages may have arrived.
  virtual void on_data(dds::DataReader& reader) = 0;
  // If blocks cannot be opened, asks the writers to send messages as they are.
  void withdraw_blocks(dds::DataReader& reader);

  BlockMap blocks_;
  // Messages that could not be passed on, shared by the readers of the topic.
  const std::shared_ptr<Counter> ignored_;

 private:
  friend class Access;
  dds::DataReader* enter();
  void leave() noexcept;
  void destroy(dds::DataReader* reader) noexcept;
  // Identifies the reader in the list of its topic, before it has a GUID.
  Handle own_key() const { return reinterpret_cast<Handle>(this); }

  void on_data_available(dds::DataReader* reader) override;
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override;
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

  std::shared_ptr<Participant> participant_;  // null after the end of the reader
  const std::string topic_, type_;
  StatusEvents events_;
  std::string user_data_;  // without what says that blocks can be read
  std::atomic<bool> offers_blocks_ = false;
  dds::Subscriber* subscriber_ = nullptr;
  rtps::GUID_t guid_;
  std::mutex mutex_;  // protects the members below
  dds::DataReader* reader_ = nullptr;
  int users_ = 0;
  bool closed_ = false;
};

// Queues messages in Fast DDS. The thread that waits for the event takes them.
class Reader final : public DataReader {
 public:
  // `on_data` (may be null) is set when messages arrive or a status changes.
  Reader(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
         const std::string& user_data, void* on_data);
  ~Reader() override { close(); }

  // Up to `limit` messages. They and the reader exist as long as this object, which need not be destroyed before
  // close().
  class Taken {
   public:
    Taken(Reader& reader, std::uint32_t limit);
    template <class Use>
    void each(Use&& use) {
      if (batch_) batch_->each(use);
    }
    // Whether more messages may be waiting.
    bool full() const { return batch_ && batch_->full(); }

   private:
    Access access_;
    std::optional<Batch> batch_;
  };

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
  void store(const Message& message, std::int64_t arrival_time);

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
};

}  // namespace coframe::fastdds
