// SPDX-License-Identifier: Apache-2.0
#include "readers.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "endpoint_qos.hpp"

namespace coframe::fastdds {
namespace {

std::int64_t now() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

dds::DataReaderQos make_qos(const Participant& participant, dds::Subscriber& subscriber, const std::string& topic,
                            const Qos& qos, const std::string& user_data) {
  dds::DataReaderQos reader_qos = subscriber.get_default_datareader_qos();
  const bool from_profile = participant.options().qos_from_profiles;
  if (from_profile) subscriber.get_datareader_qos_from_profile(topic, reader_qos);
  set_common_qos(reader_qos, qos, user_data, from_profile);
  return reader_qos;
}

}  // namespace

Batch::Batch(dds::DataReader& reader, BlockMap& blocks, Counter& ignored, std::uint32_t limit)
    : reader_(reader), ignored_(ignored), limit_(std::min(limit, kMaxMessages)) {
  reader_.take(samples_, infos_, static_cast<std::int32_t>(limit_));
  for (int i = 0; i < infos_.length(); ++i) {
    if (!infos_[i].valid_data || !BlockMap::is_reference(samples_[i])) continue;
    auto message = blocks.find(bytes_of(infos_[i].sample_identity.writer_guid()), samples_[i]);
    if (message) messages_.emplace(i, std::move(*message));
  }
}

bool Batch::has_messages() const {
  for (int i = 0; i < infos_.length(); ++i) {
    if (infos_[i].valid_data) return true;
  }
  return false;
}

DataReader::DataReader(std::shared_ptr<Participant> participant, std::string topic, std::string type, void* on_change)
    : ignored_(participant->ignored_of(topic)),
      participant_(std::move(participant)),
      topic_(std::move(topic)),
      type_(std::move(type)),
      events_(on_change) {}

void DataReader::start(const Qos& qos, const std::string& user_data, bool reads_blocks) {
  check_not_forked();
  user_data_ = user_data;
  // A reader without a limit may need more messages than there are blocks.
  offers_blocks_ = reads_blocks && !qos.keep_all && participant_->shares_blocks();
  const std::string announced =
      offers_blocks_ ? user_data + blocks_entry(static_cast<std::uint32_t>(qos.depth)) : user_data;
  subscriber_ = participant_->subscriber(qos.partitions);
  dds::Topic* topic = participant_->take_topic(topic_, type_);
  participant_->readers_of(topic_)->add(own_key(), announced, true);
  reader_ = subscriber_->create_datareader(topic, make_qos(*participant_, *subscriber_, topic_, qos, announced), this,
                                           dds::StatusMask::all());
  if (reader_ == nullptr) {
    participant_->forget_reader(topic_, own_key());
    participant_->return_topic(topic_, type_);
    throw Error("could not create a reader");
  }
  guid_ = reader_->guid();
  participant_->add_own(participant_->readers(), guid_, topic_, type_, qos, user_data);
}

void DataReader::close() noexcept {
  if (forked()) return;
  dds::DataReader* unused = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (closed_ || reader_ == nullptr) return;
    closed_ = true;
    reader_->set_listener(nullptr);
    if (users_ == 0) unused = std::exchange(reader_, nullptr);
  }
  if (unused != nullptr) destroy(unused);
}

dds::DataReader* DataReader::enter() {
  check_not_forked();
  const std::lock_guard lock(mutex_);
  if (closed_ || reader_ == nullptr) return nullptr;
  ++users_;
  return reader_;
}

void DataReader::leave() noexcept {
  dds::DataReader* unused = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (--users_ == 0 && closed_) unused = std::exchange(reader_, nullptr);
  }
  if (unused != nullptr) destroy(unused);
}

void DataReader::destroy(dds::DataReader* reader) noexcept {
  subscriber_->delete_datareader(reader);
  const std::shared_ptr<Participant> participant = std::exchange(participant_, nullptr);
  participant->forget_reader(topic_, own_key());
  participant->return_topic(topic_, type_);
  participant->remove_own(participant->readers(), guid_);
}

void DataReader::withdraw_blocks(dds::DataReader& reader) {
  if (!offers_blocks_.exchange(false)) return;
  dds::DataReaderQos qos = reader.get_qos();
  qos.user_data().setValue({user_data_.begin(), user_data_.end()});
  reader.set_qos(qos);
  participant_->readers_of(topic_)->add(own_key(), user_data_, true);
}

// Called by Fast DDS, which no exception may reach. If memory runs out, at least one message is lost.
void DataReader::on_data_available(dds::DataReader* reader) {
  try {
    on_data(*reader);
  } catch (...) {
    ++*ignored_;
  }
}

void DataReader::on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) {
  events_.add_matched(status, status.last_publication_handle);
  if (status.current_count_change < 0)
    blocks_.writer_left(bytes_of(rtps::iHandle2GUID(status.last_publication_handle)));
}

Reader::Reader(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
               const std::string& user_data, void* on_data)
    : DataReader(std::move(participant), std::move(topic), std::move(type), on_data), event_(on_data) {
  start(qos, user_data, true);
  if (event_ != nullptr) core->set_event(event_);
}

void Reader::on_data(dds::DataReader&) {
  pending_ = true;
  if (event_ != nullptr) core->set_event(event_);
}

Reader::Taken::Taken(Reader& reader, std::uint32_t limit) : access_(reader) {
  dds::DataReader* native = access_.native();
  if (native == nullptr) return;
  if (reader.blocks_.failed()) reader.withdraw_blocks(*native);
  reader.pending_ = false;
  do {
    batch_.emplace(*native, reader.blocks_, *reader.ignored_, limit);
  } while (!batch_->empty() && !batch_->has_messages());
  if (batch_->full()) reader.pending_ = true;
  if (batch_->empty()) reader.blocks_.queue_is_empty();
}

Tap::Tap(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
         const std::string& user_data, const Limits& limits)
    : DataReader(std::move(participant), std::move(topic), std::move(type), nullptr), limits_(limits) {
  start(qos, user_data, true);
}

void Tap::on_data(dds::DataReader& reader) {
  const std::int64_t arrival_time = now();
  const std::lock_guard lock(mutex_);
  bool may_have_more = true;
  while (may_have_more) {
    const Batch batch(reader, blocks_, *ignored_, Batch::kMaxMessages);
    batch.each([&](const Message& message) { store(message, arrival_time); });
    may_have_more = batch.full();
  }
  blocks_.queue_is_empty();
}

void Tap::store(const Message& message, std::int64_t arrival_time) {
  if (messages_.ends.size() >= limits_.messages || messages_.bytes.size() >= limits_.size) {
    ++missed_;
    return;
  }
  const auto head = message.bytes.first(std::min(message.bytes.size(), limits_.head));
  messages_.bytes.append(reinterpret_cast<const char*>(head.data()), head.size());
  messages_.arrived.push_back(arrival_time);
  messages_.sent.push_back(message.sent);
  messages_.writers.push_back(message.writer);
  messages_.ends.push_back(messages_.bytes.size());
}

Tap::Messages Tap::take() {
  if (blocks_.failed()) {
    if (const Access access(*this); access.native() != nullptr) withdraw_blocks(*access.native());
  }
  const std::lock_guard lock(mutex_);
  return std::exchange(messages_, {});
}

std::uint64_t Tap::missed() {
  const std::lock_guard lock(mutex_);
  return missed_;
}

TfReader::TfReader(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
                   const std::string& user_data, void* store, void* on_change)
    : DataReader(std::move(participant), std::move(topic), std::move(type), on_change), store_(store) {
  start(qos, user_data, false);
}

void TfReader::on_data(dds::DataReader& reader) {
  bool may_have_more = true;
  while (may_have_more) {
    const Batch batch(reader, blocks_, *ignored_, Batch::kMaxMessages);
    batch.each([&](const Message& message) {
      core->add_to_store(store_, message.writer, message.bytes.data(), message.bytes.size());
    });
    may_have_more = batch.full();
  }
}

}  // namespace coframe::fastdds
