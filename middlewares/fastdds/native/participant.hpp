// SPDX-License-Identifier: Apache-2.0
// A participant of a DDS domain, its topics, and the endpoints that it discovers.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bytes_type.hpp"
#include "fastdds.hpp"
#include "topic_readers.hpp"

namespace coframe::fastdds {

extern const coframe_middleware* core;  // the functions of coframe._core

#ifdef COFRAME_FASTDDS_SHARES_MEMORY
inline constexpr bool kSharesMemory = true;
#else
inline constexpr bool kSharesMemory = false;
#endif

Guid bytes_of(const rtps::GUID_t& guid);
rtps::GUID_t guid_of(const Guid& bytes);
Handle handle_of(const rtps::GUID_t& guid);
bool are_in_one_process(const rtps::GUID_t& one, const rtps::GUID_t& other);

// An operation of Fast DDS that failed.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// In a forked child, the threads of Fast DDS do not exist.
bool forked();
void check_not_forked();

struct Qos {
  std::int32_t depth = 1;
  bool reliable = false;
  bool transient_local = false;
  bool keep_all = false;
  bool manual_liveliness = false;
  std::int64_t deadline_ns = kInfinite;
  std::int64_t lifespan_ns = kInfinite;
  std::int64_t lease_ns = kInfinite;
  std::vector<std::string> partitions{};
  std::int64_t latency_budget_ns = 0;
};

struct EndpointChange {
  Handle handle;
  bool alive;  // false: it has left, and only the handle and the GUID are set
  Guid guid{};
  Guid participant{};
  std::string topic{};
  std::string type{};
  Qos qos{};
  std::string user_data{};
};

// The last change of each endpoint that has changed since the last call of `take`.
class EndpointChanges {
 public:
  void add(EndpointChange change);
  std::vector<EndpointChange> take();

 private:
  std::mutex mutex_;
  std::unordered_map<Handle, EndpointChange> changes_;
};

using Counter = std::atomic<std::uint64_t>;

struct ParticipantOptions {
  std::uint32_t domain;
  std::string name;
  std::string user_data;
  std::string range;               // OFF, LOCALHOST or SUBNET; otherwise, what the configuration of Fast DDS says
  std::vector<std::string> peers;  // IPv4 addresses
  std::string profiles;            // the user's XML file, which configures transports; empty if there is none
  bool qos_from_profiles;          // endpoints use the profile with the name of their topic
  bool asynchronous;               // endpoints send on a thread of Fast DDS
  std::vector<std::pair<std::string, std::string>> properties;
};

// Lives until the last endpoint is closed.
class Participant final : dds::DomainParticipantListener {
 public:
  // `changed` is set when an endpoint appears or disappears.
  Participant(const ParticipantOptions& options, void* changed);
  ~Participant() override;
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  rtps::GUID_t guid() const { return participant_->guid(); }
  EndpointChanges& writers() { return writers_; }
  EndpointChanges& readers() { return readers_; }
  // Other participants, of which only the GUID and the user data are set.
  EndpointChanges& participants() { return participants_; }
  const ParticipantOptions& options() const { return options_; }

  // The number of received messages of a topic that could not be passed on.
  std::shared_ptr<Counter> ignored_of(const std::string& topic);
  // Returns the numbers that are not 0, and sets them to 0.
  std::vector<std::pair<std::string, std::uint64_t>> take_ignored();

  // `changed` is not set from now on.
  void stop() { stopped_ = true; }

  // A topic is shared by all endpoints with its name and type; each must return it.
  dds::Topic* take_topic(const std::string& name, const std::string& type);
  void return_topic(const std::string& name, const std::string& type);
  // The readers of a topic. Those of other participants are added before they can receive messages.
  std::shared_ptr<TopicReaders> readers_of(const std::string& topic);
  void forget_reader(const std::string& topic, Handle reader) noexcept;
  // Whether messages may be in blocks, which are not encrypted.
  bool shares_blocks() const { return options_.properties.empty() && !block_namespace().empty(); }
  dds::Publisher* publisher(const std::vector<std::string>& partitions);
  dds::Subscriber* subscriber(const std::vector<std::string>& partitions);

  // The endpoints of this process are part of the graph as well.
  void add_own(EndpointChanges& changes, const rtps::GUID_t& guid, const std::string& topic, const std::string& type,
               const Qos& qos, const std::string& user_data);
  void remove_own(EndpointChanges& changes, const rtps::GUID_t& guid);

 private:
  using Partitions = std::vector<std::string>;
  struct SharedTopic {
    dds::Topic* topic;
    std::string type;
    int users;
  };

#if COFRAME_FASTDDS_3
  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryStatus reason,
                                const rtps::ParticipantBuiltinTopicData& info, bool& ignored) override;
  void on_data_writer_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryStatus reason,
                                const rtps::PublicationBuiltinTopicData& info, bool& ignored) override;
  void on_data_reader_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryStatus reason,
                                const rtps::SubscriptionBuiltinTopicData& info, bool& ignored) override;
#else
  void on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& info) override;
  void on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override;
  void on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) override;
#endif
  template <class Make>
  void store(EndpointChanges& changes, const rtps::GUID_t& guid, bool alive, Make&& make) noexcept;
  void note_reader(const rtps::GUID_t& guid, bool alive, const std::string& topic,
                   const std::string& user_data) noexcept;
  void set_changed();

  const ParticipantOptions options_;
  void* const changed_;
  std::atomic<bool> stopped_ = false;
  EndpointChanges writers_, readers_, participants_;
  std::mutex readers_mutex_;  // protects the two members below
  std::map<std::string, std::shared_ptr<TopicReaders>> readers_of_;
  std::unordered_map<Handle, std::string> topics_of_readers_;
  std::mutex mutex_;  // protects the four members below
  std::map<std::string, SharedTopic> topics_;
  std::map<std::string, std::shared_ptr<Counter>> ignored_;
  std::map<Partitions, dds::Publisher*> publishers_;
  std::map<Partitions, dds::Subscriber*> subscribers_;
  dds::DomainParticipant* participant_ = nullptr;
};

}  // namespace coframe::fastdds
