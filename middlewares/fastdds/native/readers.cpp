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
  dds::DataReaderQos made = subscriber.get_default_datareader_qos();
  const bool from_profile = participant.options().qos_from_profiles;
  if (from_profile) subscriber.get_datareader_qos_from_profile(topic, made);
  set_common_qos(made, qos, user_data, from_profile);
  return made;
}

// Takes the next message. Returns false if there is none; a message without data is skipped.
bool take_next(dds::DataReader& reader, Incoming& bytes, dds::SampleInfo& info) {
  while (is_ok(reader.take_next_sample(&bytes, &info))) {
    if (info.valid_data && bytes.size() >= 4) return true;
  }
  return false;
}

Handle writer_of(const dds::SampleInfo& info) { return handle_of(info.sample_identity.writer_guid()); }

}  // namespace

DataReader::DataReader(std::shared_ptr<Participant> participant, std::string topic, std::string type, void* on_change)
    : participant_(std::move(participant)), topic_(std::move(topic)), type_(std::move(type)), events_(on_change) {}

void DataReader::start(const Qos& qos, const std::string& user_data) {
  check_not_forked();
  subscriber_ = participant_->subscriber(qos.partitions);
  dds::Topic* shared = participant_->take_topic(topic_, type_);
  reader_ = subscriber_->create_datareader(shared, make_qos(*participant_, *subscriber_, topic_, qos, user_data), this,
                                           dds::StatusMask::all());
  if (reader_ == nullptr) {
    participant_->return_topic(topic_, type_);
    throw Error("could not create a reader");
  }
  guid_ = reader_->guid();
  participant_->add_own(participant_->readers(), guid_, topic_, type_, qos, user_data);
}

void DataReader::close() noexcept {
  if (forked()) return;
  const std::unique_lock lock(closing_);
  if (reader_ == nullptr) return;
  dds::DataReader* reader = std::exchange(reader_, nullptr);
  reader->set_listener(nullptr);
  subscriber_->delete_datareader(reader);
  participant_->return_topic(topic_, type_);
  participant_->remove_own(participant_->readers(), guid_);
}

// Called by Fast DDS, which no exception may reach. If memory runs out, a message is lost.
void DataReader::on_data_available(dds::DataReader* reader) {
  try {
    on_data(*reader);
  } catch (...) {
  }
}

Reader::Reader(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
               const std::string& user_data, void* on_data)
    : DataReader(std::move(participant), std::move(topic), std::move(type), on_data), event_(on_data) {
  start(qos, user_data);
  if (event_ != nullptr) core->set_event(event_);
}

void Reader::on_data(dds::DataReader&) {
  pending_ = true;
  if (event_ != nullptr) core->set_event(event_);
}

std::vector<Message> Reader::take(std::uint32_t limit) {
  std::vector<Message> messages;
  with_reader([&](dds::DataReader& reader) {
    pending_ = false;
    dds::SampleInfo info;
    Incoming bytes;
    while (messages.size() < limit) {
      if (!take_next(reader, bytes, info)) return;
      messages.push_back({std::move(bytes), info.source_timestamp.to_ns(), writer_of(info), info.sample_identity,
                          info.related_sample_identity});
      bytes = {};
    }
    pending_ = true;
  });
  return messages;
}

Tap::Tap(std::shared_ptr<Participant> participant, std::string topic, std::string type, const Qos& qos,
         const std::string& user_data, const Limits& limits)
    : DataReader(std::move(participant), std::move(topic), std::move(type), nullptr), limits_(limits) {
  start(qos, user_data);
}

void Tap::on_data(dds::DataReader& reader) {
  const std::int64_t arrived = now();
  const std::lock_guard lock(mutex_);
  dds::SampleInfo info;
  Incoming bytes;
  while (take_next(reader, bytes, info)) {
    if (messages_.ends.size() >= limits_.messages || messages_.bytes.size() >= limits_.size) {
      ++missed_;
      continue;
    }
    messages_.bytes.append(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), limits_.head));
    messages_.arrived.push_back(arrived);
    messages_.sent.push_back(info.source_timestamp.to_ns());
    messages_.writers.push_back(writer_of(info));
    messages_.ends.push_back(messages_.bytes.size());
  }
}

Tap::Messages Tap::take() {
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
  start(qos, user_data);
}

void TfReader::on_data(dds::DataReader& reader) {
  const std::lock_guard lock(mutex_);
  dds::SampleInfo info;
  while (take_next(reader, message_, info)) {
    core->add_to_store(store_, writer_of(info), message_.data(), message_.size());
  }
}

}  // namespace coframe::fastdds
