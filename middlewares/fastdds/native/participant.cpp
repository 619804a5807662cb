// SPDX-License-Identifier: Apache-2.0
#include "participant.hpp"

#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <type_traits>

#include "complete_transport.hpp"

namespace coframe::fastdds {

const coframe_middleware* core = nullptr;

namespace {

std::atomic<bool> is_forked = false;
[[maybe_unused]] const int registered = pthread_atfork(nullptr, nullptr, [] { is_forked = true; });

// Other hosts and processes cannot choose GUIDs whose handles are equal.
std::uint64_t random_number() {
  std::random_device device;
  return (static_cast<std::uint64_t>(device()) << 32) | device();
}
const std::uint64_t seed = random_number();
const std::uint64_t factor = random_number() | 1;

std::uint64_t mix(std::uint64_t value) {
  value *= factor;
  value ^= value >> 29;
  value *= 0xbf58476d1ce4e5b9U;
  value ^= value >> 32;
  return value;
}

constexpr const char* kOff = "OFF";

// Returns a UDP port of the loopback interface that is free, and not in the range that DDS uses; 0 if there is none.
std::uint16_t free_port() {
  const int socket = ::socket(AF_INET, SOCK_DGRAM, 0);
  if (socket < 0) return 0;
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  const bool found = ::bind(socket, generic, size) == 0 && ::getsockname(socket, generic, &size) == 0;
  ::close(socket);
  return found ? ntohs(address.sin_port) : 0;
}

void set_own_transports(dds::DomainParticipantQos& qos, const std::shared_ptr<Completion>& completion) {
  // Participants of each peer that are looked for: all that a domain has ports for.
  constexpr std::uint32_t kPeers = 120;
  // Messages that are on their way to other processes. By default, an image of 1 MB does not fit, and most of it is
  // sent again after milliseconds. The memory is used only as far as it is needed.
  constexpr std::uint32_t kSegmentSize = std::uint32_t{4} << 20;
  auto& transports = qos.transport();
  transports.use_builtin_transports = false;
  const auto add = [&](const auto& descriptor) {
    using Complete = CompleteDescriptor<std::decay_t<decltype(descriptor)>>;
    transports.user_transports.push_back(std::make_shared<Complete>(descriptor, completion));
  };
  if (kSharesMemory) {
    transport::SharedMemTransportDescriptor memory;
    memory.segment_size(kSegmentSize);
    add(memory);
  }
  transport::UDPv4TransportDescriptor udp;
  udp.maxInitialPeersRange = kPeers;
  add(udp);
}

// An address that no other participant expects, so that none is received. Fast DDS 3 also ignores those that it finds.
rtps::Locator_t unknown_address() {
  rtps::Locator_t address;
  IPLocator::setIPv4(address, "127.0.0.1");
  address.port = free_port();
  return address;
}

void add_peer(dds::DomainParticipantQos& qos, const std::string& address) {
  rtps::Locator_t peer;
  IPLocator::setIPv4(peer, address);
  qos.wire_protocol().builtin.initialPeersList.push_back(peer);
}

void set_discovery(dds::DomainParticipantQos& qos, const ParticipantOptions& options,
                   const std::shared_ptr<Completion>& completion) {
  auto& builtin = qos.wire_protocol().builtin;
  const rtps::Locator_t any;
  if (options.range == kOff) {
    builtin.metatrafficMulticastLocatorList.clear();
    builtin.metatrafficUnicastLocatorList.push_back(unknown_address());
  } else if (options.range == "LOCALHOST") {
    builtin.metatrafficMulticastLocatorList.clear();
    builtin.metatrafficUnicastLocatorList.push_back(any);
    add_peer(qos, "127.0.0.1");
    for (const std::string& peer : options.peers) add_peer(qos, peer);
  } else if (options.range == "SUBNET" && !options.peers.empty()) {
    for (const std::string& peer : options.peers) add_peer(qos, peer);
    add_peer(qos, "239.255.0.1");
  }
  // The user's configuration comes first.
  if (options.profiles.empty() && std::getenv("FASTDDS_BUILTIN_TRANSPORTS") == nullptr)
    set_own_transports(qos, completion);
}

// Prints errors as one plain line each. Without it, Fast DDS writes them in colors, and reports descriptions of types
// of other versions, which coframe does not use.
class Console final : public dds::LogConsumer {
 public:
  void Consume(const dds::Log::Entry& entry) override {
    const char* category = entry.context.category != nullptr ? entry.context.category : "";
    if (entry.kind != dds::Log::Kind::Error || std::strncmp(category, "TYPELOOKUP", 10) == 0) return;
    std::fprintf(stderr, "Fast DDS: %s (%s)\n", entry.message.c_str(), category);
  }
};

void print_errors_plainly() {
  static std::once_flag once;
  std::call_once(once, [] {
    dds::Log::ClearConsumers();
    dds::Log::RegisterConsumer(std::make_unique<Console>());
  });
}

dds::DomainParticipantQos make_qos(const ParticipantOptions& options, const std::shared_ptr<Completion>& completion) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  // Before load_profiles(), which makes the default profile of the file that of participants.
  if (!options.profiles.empty() && !is_ok(factory->load_XML_profiles_file(options.profiles))) {
    throw Error("Fast DDS cannot read the profiles in " + options.profiles);
  }
  factory->load_profiles();
  dds::DomainParticipantQos qos = factory->get_default_participant_qos();
  qos.name(options.name.c_str());
  qos.user_data().setValue({options.user_data.begin(), options.user_data.end()});
  auto& builtin = qos.wire_protocol().builtin;
  builtin.readerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  builtin.writerHistoryMemoryPolicy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  // How often a client asks a discovery server for what it has not received yet.
  builtin.discovery_config.discoveryServer_client_syncperiod = to_duration(100'000'000);
  set_discovery(qos, options, completion);
  for (const auto& [name, value] : options.properties) qos.properties().properties().emplace_back(name, value);
  return qos;
}

// A forked child ends without the destructors of Fast DDS, which would wait for threads that do not exist there. Those
// of objects that exist now run after this function.
void guard_exit() {
#ifdef __GLIBC__
  static std::once_flag once;
  std::call_once(once, [] {
    const auto leave = [](int status, void*) {
      if (!forked()) return;
      std::fflush(nullptr);
      _exit(status);
    };
    on_exit(leave, nullptr);
  });
#endif
}

template <class Entity>
Entity* created(Entity* entity, const char* what) {
  if (entity == nullptr) throw Error(std::string("could not ") + what);
  return entity;
}

Guid participant_of(const rtps::GUID_t& guid) {
  return bytes_of(rtps::GUID_t(guid.guidPrefix, rtps::c_EntityId_RTPSParticipant));
}

template <class User>
std::string text_of(const User& user_data) {
  const auto& bytes = user_data.data_vec();
  return {bytes.begin(), bytes.end()};
}

template <class Policies>
Qos read_qos(const Policies& from, bool) {
  Qos qos;
#if COFRAME_FASTDDS_3
  const auto& durability = from.durability;
  const auto& reliability = from.reliability;
  const auto& liveliness = from.liveliness;
  const auto& deadline = from.deadline;
  const auto& partition = from.partition;
  const auto& latency = from.latency_budget;
#else
  const auto& durability = from.m_durability;
  const auto& reliability = from.m_reliability;
  const auto& liveliness = from.m_liveliness;
  const auto& deadline = from.m_deadline;
  const auto& partition = from.m_partition;
  const auto& latency = from.m_latencyBudget;
#endif
  qos.transient_local = durability.kind >= dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.reliable = reliability.kind == dds::RELIABLE_RELIABILITY_QOS;
  qos.manual_liveliness = liveliness.kind != dds::AUTOMATIC_LIVELINESS_QOS;
  qos.lease_ns = to_nanoseconds(liveliness.lease_duration);
  qos.deadline_ns = to_nanoseconds(deadline.period);
  qos.latency_budget_ns = to_nanoseconds(latency.duration);
  qos.partitions = partition.getNames();
  return qos;
}

}  // namespace

Guid bytes_of(const rtps::GUID_t& guid) {
  Guid bytes;
  std::memcpy(bytes.data(), guid.guidPrefix.value, 12);
  std::memcpy(bytes.data() + 12, guid.entityId.value, 4);
  return bytes;
}

rtps::GUID_t guid_of(const Guid& bytes) {
  rtps::GUID_t guid;
  std::memcpy(guid.guidPrefix.value, bytes.data(), 12);
  std::memcpy(guid.entityId.value, bytes.data() + 12, 4);
  return guid;
}

Handle handle_of(const rtps::GUID_t& guid) {
  const Guid bytes = bytes_of(guid);
  std::uint64_t halves[2];
  std::memcpy(halves, bytes.data(), sizeof halves);
  return mix(mix(halves[0] ^ seed) ^ halves[1]);
}

// Fast DDS writes the host and the process to the beginning of a GUID.
bool are_in_one_process(const rtps::GUID_t& one, const rtps::GUID_t& other) {
  return std::memcmp(one.guidPrefix.value, other.guidPrefix.value, 8) == 0;
}

bool forked() { return is_forked; }

void check_not_forked() {
  if (forked()) {
    throw std::runtime_error("This process was forked while its parent used Fast DDS. Start processes with 'spawn'.");
  }
}

void EndpointChanges::add(EndpointChange change) {
  const std::lock_guard lock(mutex_);
  changes_.insert_or_assign(change.handle, std::move(change));
}

std::vector<EndpointChange> EndpointChanges::take() {
  std::unordered_map<Handle, EndpointChange> taken_changes;
  {
    const std::lock_guard lock(mutex_);
    taken_changes.swap(changes_);
  }
  std::vector<EndpointChange> changes;
  changes.reserve(taken_changes.size());
  for (auto& [handle, change] : taken_changes) changes.push_back(std::move(change));
  return changes;
}

Participant::Participant(const ParticipantOptions& options, void* changed) : options_(options), changed_(changed) {
  check_not_forked();
  print_errors_plainly();
  const auto completion = std::make_shared<Completion>();
  const dds::DomainParticipantQos qos = make_qos(options, completion);
  // The listener receives discovery, and nothing about endpoints.
  participant_ = created(dds::DomainParticipantFactory::get_instance()->create_participant(options.domain, qos, this,
                                                                                           dds::StatusMask::none()),
                         "create a participant");
  completion->set();
  guard_exit();
}

Participant::~Participant() {
  if (forked()) return;
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

void Participant::set_changed() {
  if (!stopped_) core->set_event(changed_);
}

std::shared_ptr<Counter> Participant::ignored_of(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<Counter>& counter = ignored_[topic];
  if (counter == nullptr) counter = std::make_shared<Counter>();
  return counter;
}

std::vector<std::pair<std::string, std::uint64_t>> Participant::take_ignored() {
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  const std::lock_guard lock(mutex_);
  for (auto& [topic, counter] : ignored_) {
    if (const std::uint64_t count = counter->exchange(0); count > 0) counts.emplace_back(topic, count);
  }
  return counts;
}

dds::Topic* Participant::take_topic(const std::string& name, const std::string& type) {
  const std::lock_guard lock(mutex_);
  const auto found = topics_.find(name);
  if (found != topics_.end()) {
    if (found->second.type != type) {
      throw Error("could not create a topic with the type " + type + ": this process uses it with the type " +
                  found->second.type);
    }
    ++found->second.users;
    return found->second.topic;
  }
  dds::TypeSupport support(new BytesType(type));
  if (!is_ok(support.register_type(participant_, type))) throw Error("could not register the type " + type);
  dds::Topic* topic = created(participant_->create_topic(name, type, dds::TOPIC_QOS_DEFAULT), "create the topic");
  topics_.emplace(name, SharedTopic{topic, type, 1});
  return topic;
}

void Participant::return_topic(const std::string& name, const std::string& type) {
  const std::lock_guard lock(mutex_);
  const auto found = topics_.find(name);
  if (found == topics_.end() || --found->second.users > 0) return;
  participant_->delete_topic(found->second.topic);
  topics_.erase(found);
  participant_->unregister_type(type);  // fails while another topic has it
}

std::shared_ptr<TopicReaders> Participant::readers_of(const std::string& topic) {
  const std::lock_guard lock(readers_mutex_);
  auto& readers = readers_of_[topic];
  if (!readers) readers = std::make_shared<TopicReaders>();
  return readers;
}

void Participant::forget_reader(const std::string& topic, Handle reader) noexcept {
  const std::lock_guard lock(readers_mutex_);
  const auto found = readers_of_.find(topic);
  if (found == readers_of_.end()) return;
  const bool is_empty = found->second->remove(reader);
  if (is_empty && found->second.use_count() == 1) readers_of_.erase(found);  // otherwise, a writer has it
}

// Called by Fast DDS before it matches a reader. If memory runs out, messages might be sent in a form that the reader
// cannot read, so the process ends as it would for any other failed allocation of Fast DDS.
void Participant::note_reader(const rtps::GUID_t& guid, bool alive, const std::string& topic,
                              const std::string& user_data) noexcept {
  const Handle handle = handle_of(guid);
  if (alive) {
    {
      const std::lock_guard lock(readers_mutex_);
      topics_of_readers_.insert_or_assign(handle, topic);
    }
    readers_of(topic)->add(handle, user_data, are_in_one_process(guid, this->guid()));
    return;
  }
  std::string left;
  {
    const std::lock_guard lock(readers_mutex_);
    const auto found = topics_of_readers_.find(handle);
    if (found == topics_of_readers_.end()) return;
    left = std::move(found->second);
    topics_of_readers_.erase(found);
  }
  forget_reader(left, handle);
}

dds::Publisher* Participant::publisher(const std::vector<std::string>& partitions) {
  const std::lock_guard lock(mutex_);
  dds::Publisher*& publisher = publishers_[partitions];
  if (publisher == nullptr) {
    dds::PublisherQos qos = dds::PUBLISHER_QOS_DEFAULT;
    Partitions names = partitions;
    qos.partition().names(names);
    publisher = created(participant_->create_publisher(qos), "create a publisher");
  }
  return publisher;
}

dds::Subscriber* Participant::subscriber(const std::vector<std::string>& partitions) {
  const std::lock_guard lock(mutex_);
  dds::Subscriber*& subscriber = subscribers_[partitions];
  if (subscriber == nullptr) {
    dds::SubscriberQos qos = dds::SUBSCRIBER_QOS_DEFAULT;
    Partitions names = partitions;
    qos.partition().names(names);
    subscriber = created(participant_->create_subscriber(qos), "create a subscriber");
  }
  return subscriber;
}

void Participant::add_own(EndpointChanges& changes, const rtps::GUID_t& guid, const std::string& topic,
                          const std::string& type, const Qos& qos, const std::string& user_data) {
  changes.add({handle_of(guid), true, bytes_of(guid), participant_of(guid), topic, type, qos, user_data});
  set_changed();
}

void Participant::remove_own(EndpointChanges& changes, const rtps::GUID_t& guid) {
  changes.add({.handle = handle_of(guid), .alive = false, .guid = bytes_of(guid)});
  set_changed();
}

// Called by Fast DDS, which no exception may reach. If memory runs out, an endpoint is not part of the graph.
template <class Make>
void Participant::store(EndpointChanges& changes, const rtps::GUID_t& guid, bool alive, Make&& make) noexcept {
  try {
    EndpointChange change{.handle = handle_of(guid), .alive = alive, .guid = bytes_of(guid)};
    if (alive) {
      change.participant = participant_of(guid);
      make(change);
    }
    changes.add(std::move(change));
  } catch (...) {
  }
  set_changed();
}

#if COFRAME_FASTDDS_3

void Participant::on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryStatus reason,
                                           const rtps::ParticipantBuiltinTopicData& info, bool& ignored) {
  using Status = rtps::ParticipantDiscoveryStatus;
  ignored = options_.range == kOff;
  if (ignored) return;
  const bool alive = reason == Status::DISCOVERED_PARTICIPANT || reason == Status::CHANGED_QOS_PARTICIPANT;
  store(participants_, info.guid, alive, [&](EndpointChange& change) { change.user_data = text_of(info.user_data); });
}

void Participant::on_data_writer_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryStatus reason,
                                           const rtps::PublicationBuiltinTopicData& info, bool& ignored) {
  using Status = rtps::WriterDiscoveryStatus;
  ignored = false;
  const bool alive = reason == Status::DISCOVERED_WRITER || reason == Status::CHANGED_QOS_WRITER;
  store(writers_, info.guid, alive, [&](EndpointChange& change) {
    change.topic = info.topic_name.to_string();
    change.type = info.type_name.to_string();
    change.qos = read_qos(info, true);
    change.qos.lifespan_ns = to_nanoseconds(info.lifespan.duration);
    change.user_data = text_of(info.user_data);
  });
}

void Participant::on_data_reader_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryStatus reason,
                                           const rtps::SubscriptionBuiltinTopicData& info, bool& ignored) {
  using Status = rtps::ReaderDiscoveryStatus;
  ignored = false;
  const bool alive = reason == Status::DISCOVERED_READER || reason == Status::CHANGED_QOS_READER;
  note_reader(info.guid, alive, info.topic_name.to_string(), text_of(info.user_data));
  store(readers_, info.guid, alive, [&](EndpointChange& change) {
    change.topic = info.topic_name.to_string();
    change.type = info.type_name.to_string();
    change.qos = read_qos(info, false);
    change.user_data = text_of(info.user_data);
  });
}

#else

namespace {

// Fast DDS 2 loses count of what it sends if readers of one topic share a multicast address, as those of Cyclone DDS
// do, and one of them is then sent a message of its own: debug builds such as Debian's abort, others write to memory
// that is not theirs. Without multicast addresses, each reader is always sent messages of its own. This is called
// before the reader is matched, and the object is not constant.
void forget_multicast(const rtps::ReaderProxyData& data) {
  const_cast<rtps::RemoteLocatorList&>(data.remote_locators()).multicast.clear();
}

}  // namespace

void Participant::on_participant_discovery(dds::DomainParticipant*, rtps::ParticipantDiscoveryInfo&& info) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const bool alive = info.status == Info::DISCOVERED_PARTICIPANT || info.status == Info::CHANGED_QOS_PARTICIPANT;
  store(participants_, info.info.m_guid, alive,
        [&](EndpointChange& change) { change.user_data = text_of(info.info.m_userData); });
}

void Participant::on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) {
  const auto& data = info.info;
  store(writers_, data.guid(), info.status != rtps::WriterDiscoveryInfo::REMOVED_WRITER, [&](EndpointChange& change) {
    change.topic = data.topicName().to_string();
    change.type = data.typeName().to_string();
    change.qos = read_qos(data.m_qos, true);
    change.qos.lifespan_ns = to_nanoseconds(data.m_qos.m_lifespan.duration);
    change.user_data = text_of(data.m_qos.m_userData);
  });
}

void Participant::on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) {
  const auto& data = info.info;
  forget_multicast(data);
  const bool alive = info.status != rtps::ReaderDiscoveryInfo::REMOVED_READER;
  note_reader(data.guid(), alive, data.topicName().to_string(), text_of(data.m_qos.m_userData));
  store(readers_, data.guid(), alive, [&](EndpointChange& change) {
    change.topic = data.topicName().to_string();
    change.type = data.typeName().to_string();
    change.qos = read_qos(data.m_qos, false);
    change.user_data = text_of(data.m_qos.m_userData);
  });
}

#endif

}  // namespace coframe::fastdds
