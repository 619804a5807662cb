// SPDX-License-Identifier: Apache-2.0
#include "writer.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "endpoint_qos.hpp"

namespace coframe::fastdds {
namespace {

constexpr std::size_t kHeaderSize = 4;
constexpr std::size_t kMinBlockSize = 64'000;           // larger messages do not fit into one packet
constexpr std::int64_t kClosingPatience = 200'000'000;  // nanoseconds
constexpr std::int64_t kHistoryPatience = 500'000'000;  // nanoseconds, at most once per reader

// Readers learn from heartbeats which messages they have missed. They are sent as long as acknowledgements are
// outstanding; by default every 3 s, when publishers of transforms no longer keep the messages.
void set_heartbeats(dds::DataWriterQos& qos) {
  constexpr std::int64_t kPeriod = 20'000'000;  // nanoseconds
  auto& times = qos.reliable_writer_qos().times;
#if COFRAME_FASTDDS_3
  times.heartbeat_period = to_duration(kPeriod);
#else
  times.heartbeatPeriod = to_duration(kPeriod);
#endif
}

dds::DataWriterQos make_qos(const Participant& participant, dds::Publisher& publisher, const std::string& topic,
                            const Qos& qos, const std::string& user_data) {
  dds::DataWriterQos made = publisher.get_default_datawriter_qos();
  const bool from_profile = participant.options().qos_from_profiles;
  if (from_profile) publisher.get_datawriter_qos_from_profile(topic, made);
  set_common_qos(made, qos, user_data, from_profile);
  if (!from_profile) {
    made.publish_mode().kind =
        participant.options().asynchronous ? dds::ASYNCHRONOUS_PUBLISH_MODE : dds::SYNCHRONOUS_PUBLISH_MODE;
  }
  if (!from_profile) set_heartbeats(made);
  made.lifespan().duration = to_duration(qos.lifespan_ns);
  return made;
}

// Fast DDS sends any time, and other implementations read a time outside of these limits wrongly.
bool has_valid_clock() {
  constexpr std::int64_t kMaxSeconds = 0xfffffffe;
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t seconds = std::chrono::floor<std::chrono::seconds>(since_1970).count();
  return seconds >= 0 && seconds <= kMaxSeconds;
}

}  // namespace

Writer::Writer(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
               const std::string& user_data, bool checks_transforms, void* on_change)
    : participant_(std::move(participant)),
      topic_(std::move(topic)),
      type_(std::move(type)),
      checks_transforms_(checks_transforms),
      // Later readers, and those that have to wait, need messages that Fast DDS itself keeps.
      shares_blocks_(participant_->shares_blocks() && !qos.transient_local && !qos.keep_all &&
                     qos.lifespan_ns == kInfinite),
      is_latched_(qos.transient_local && qos.reliable && !qos.keep_all),
      depth_(static_cast<std::size_t>(std::max(qos.depth, 1))),
      events_(on_change) {
  check_not_forked();
  publisher_ = participant_->publisher(qos.partitions);
  dds::Topic* shared = participant_->take_topic(topic_, type_);
  writer_ = publisher_->create_datawriter(shared, make_qos(*participant_, *publisher_, topic_, qos, user_data), this,
                                          dds::StatusMask::all());
  if (writer_ == nullptr) {
    participant_->return_topic(topic_, type_);
    throw Error("could not create a writer");
  }
  guid_ = writer_->guid();
  readers_ = participant_->readers_of(topic_);
  participant_->add_own(participant_->writers(), guid_, topic_, type_, qos, user_data);
}

void Writer::close() noexcept {
  if (forked()) return;
  wait_for_blocks(kClosingPatience);  // afterwards, readers cannot open them
  const std::unique_lock lock(closing_);
  if (writer_ == nullptr) return;
  dds::DataWriter* writer = std::exchange(writer_, nullptr);
  writer->set_listener(nullptr);
  publisher_->delete_datawriter(writer);
  const std::shared_ptr<Participant> participant = std::exchange(participant_, nullptr);
  participant->return_topic(topic_, type_);
  participant->remove_own(participant->writers(), guid_);
  const std::lock_guard blocks_lock(blocks_mutex_);
  blocks_.reset();
}

void Writer::on_publication_matched(dds::DataWriter* writer, const dds::PublicationMatchedStatus& status) {
  const rtps::GUID_t reader = rtps::iHandle2GUID(status.last_subscription_handle);
  if (is_latched_ && status.current_count_change > 0 && are_in_one_process(reader, writer->guid())) {
    has_late_reader_ = true;
  }
  events_.add_matched(status, status.last_subscription_handle);
}

dds::DataWriter& Writer::open() const {
  check_not_forked();
  if (writer_ == nullptr) throw Error("the endpoint is closed");
  return *writer_;
}

bool Writer::accepts(std::span<const coframe_part> parts) const {
  if (!checks_transforms_) return true;
  // A TFMessage has no large arrays, so it is in one part.
  return parts.size() == 1 && core->is_tf_message(static_cast<const std::uint8_t*>(parts[0].data), parts[0].size);
}

std::int64_t Writer::write(std::span<const coframe_part> parts, std::size_t size, const rtps::SampleIdentity* related) {
  if (size < kHeaderSize) {
    throw std::invalid_argument("The message is too short: a serialized message begins with 4 bytes of encapsulation.");
  }
  if (size > std::numeric_limits<std::uint32_t>::max() / 2) throw Error("could not write: the message is too large");
  if (!has_valid_clock()) throw Error("could not write: messages cannot have the time of the system clock");
  const std::shared_lock lock(closing_);
  if (size >= kMinBlockSize && related == nullptr && shares_blocks_) {
    if (const auto number = send_in_block(parts, size)) return *number;
  }
  Outgoing message{parts, static_cast<std::uint32_t>(size)};
  return send(message, related);
}

void Writer::write_nothing() {
  if (!has_valid_clock()) throw Error("could not write: messages cannot have the time of the system clock");
  const std::shared_lock lock(closing_);
  Outgoing nothing{{}, 0};
  send(nothing, nullptr);
}

std::optional<std::int64_t> Writer::send_in_block(std::span<const coframe_part> parts, std::size_t size) {
  const auto sharing = readers_->share();
  if (!sharing) return std::nullopt;
  const std::lock_guard lock(blocks_mutex_);
  if (!blocks_) blocks_.emplace(bytes_of(guid_));
  Block* block = blocks_->take(size, sharing->readers, std::max(depth_, sharing->depth));
  if (block == nullptr) return std::nullopt;
  const auto copy = [&] {
    std::uint8_t* end = block->data();
    for (const coframe_part& part : parts) {
      std::memcpy(end, part.data, part.size);
      end += part.size;
    }
    blocks_->complete();
  };
  const BlockReference reference = blocks_->reference(size);
  const coframe_part whole{&reference, sizeof reference};
  Outgoing message{{&whole, 1}, sizeof reference};
  // Other processes wake up while the message is copied.
  if (sharing->has_own) copy();
  const std::int64_t number = send(message, nullptr);
  if (!sharing->has_own) copy();
  return number;
}

void Writer::deliver_history() {
  if (has_late_reader_.exchange(false)) open().wait_for_acknowledgments(to_duration(kHistoryPatience));
}

std::int64_t Writer::send(Outgoing& message, const rtps::SampleIdentity* related) {
  deliver_history();
  dds::DataWriter& writer = open();
  rtps::WriteParams params;
  if (related != nullptr) params.related_sample_identity(*related);
#if COFRAME_FASTDDS_3
  const Code code = writer.write(&message, params);
  if (is_timeout(code)) throw Error("could not write: Timeout");
  if (!is_ok(code)) throw Error("could not write: error " + std::to_string(code));
#else
  if (!writer.write(&message, params)) throw Error("could not write: Timeout");
#endif
  return static_cast<std::int64_t>(params.sample_identity().sequence_number().to64long());
}

void Writer::assert_liveliness() {
  const std::shared_lock lock(closing_);
  open().assert_liveliness();
}

bool Writer::wait_for_acks(std::int64_t timeout_ns) {
  const auto begin = std::chrono::steady_clock::now();
  {
    const std::shared_lock lock(closing_);
    if (!is_ok(open().wait_for_acknowledgments(to_duration(timeout_ns)))) return false;
  }
  const std::chrono::nanoseconds spent = std::chrono::steady_clock::now() - begin;
  return wait_for_blocks(timeout_ns - spent.count());
}

bool Writer::wait_for_blocks(std::int64_t timeout_ns) const {
  constexpr std::chrono::milliseconds kPause(1);
  const auto begin = std::chrono::steady_clock::now();
  while (true) {
    {
      const std::lock_guard lock(blocks_mutex_);
      if (!blocks_ || blocks_->finished()) return true;
    }
    const std::chrono::nanoseconds spent = std::chrono::steady_clock::now() - begin;
    if (spent.count() >= timeout_ns) return false;
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace coframe::fastdds
