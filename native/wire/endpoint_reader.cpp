// SPDX-License-Identifier: Apache-2.0
#include "wire/endpoint_reader.hpp"

#include <memory>
#include <utility>

namespace coframe {
namespace {

std::vector<std::string> read_partitions(const dds::Qos* qos) {
  const dds::Functions& f = dds::functions();
  std::uint32_t count = 0;
  char** names = nullptr;
  if (!f.dds_qget_partition(qos, &count, &names) || names == nullptr) return {};
  const std::unique_ptr<void, void (*)(void*)> list(names, f.dds_free);
  std::vector<std::string> partitions;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::unique_ptr<void, void (*)(void*)> name(names[i], f.dds_free);
    partitions.emplace_back(names[i]);
  }
  return partitions;
}

QosProfile read_qos(const dds::Qos* qos) {
  const dds::Functions& f = dds::functions();
  std::int32_t durability = dds::kVolatile;
  std::int32_t history = dds::kKeepLast;
  std::int32_t depth = 1;
  std::int32_t reliability = dds::kBestEffort;
  std::int64_t max_blocking_ns = 0;
  f.dds_qget_durability(qos, &durability);
  f.dds_qget_history(qos, &history, &depth);
  f.dds_qget_reliability(qos, &reliability, &max_blocking_ns);
  std::int32_t liveliness = dds::kAutomatic;
  std::int64_t deadline = kInfinite;
  std::int64_t lifespan = kInfinite;
  std::int64_t lease = kInfinite;
  f.dds_qget_liveliness(qos, &liveliness, &lease);
  f.dds_qget_deadline(qos, &deadline);
  f.dds_qget_lifespan(qos, &lifespan);
  return {.depth = depth,
          .reliable = reliability == dds::kReliable,
          .transient_local = durability >= dds::kTransientLocal,
          .keep_all = history == dds::kKeepAll,
          .manual_liveliness = liveliness != dds::kAutomatic,
          .deadline_ns = deadline,
          .lifespan_ns = lifespan,
          .lease_ns = lease,
          .partitions = read_partitions(qos)};
}

std::string read_user_data(const dds::Qos* qos) {
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds::functions().dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  const std::unique_ptr<void, void (*)(void*)> given(data, dds::functions().dds_free);
  return {static_cast<const char*>(data), size};
}

EndpointChange read_change(const dds::BuiltinEndpoint& endpoint, const dds::SampleInfo& info) {
  if (!info.valid_data || info.instance_state != dds::kAliveInstance) {
    return {.handle = info.instance_handle, .alive = false, .guid = endpoint.key};
  }
  return {.handle = info.instance_handle,
          .alive = true,
          .guid = endpoint.key,
          .participant = endpoint.participant_key,
          .topic = endpoint.topic_name,
          .type = endpoint.type_name,
          .qos = read_qos(endpoint.qos),
          .user_data = read_user_data(endpoint.qos)};
}

EndpointChange read_change(const dds::BuiltinParticipant& participant, const dds::SampleInfo& info) {
  const bool alive = info.valid_data && info.instance_state == dds::kAliveInstance;
  EndpointChange change{.handle = info.instance_handle, .alive = alive, .guid = participant.key};
  if (alive) {
    change.participant = participant.key;
    change.user_data = read_user_data(participant.qos);
  }
  return change;
}

}  // namespace

EndpointReader::EndpointReader(dds::Entity participant, dds::Entity topic, std::shared_ptr<Event> on_change)
    : topic_(topic),
      event_(std::move(on_change)),
      reader_(participant, topic, nullptr, &EndpointReader::on_data, this) {
  event_->set();
}

void EndpointReader::on_data(dds::Entity, void* self) noexcept { static_cast<EndpointReader*>(self)->event_->set(); }

std::vector<EndpointChange> EndpointReader::take() {
  std::vector<EndpointChange> changes;
  for (;;) {
    void* samples[dds::kBatch] = {};  // null: DDS provides the memory
    dds::SampleInfo info[dds::kBatch];
    const dds::Code count = dds::functions().dds_take(reader_.entity(), samples, info, dds::kBatch, dds::kBatch);
    if (count <= 0) return changes;
    for (dds::Code i = 0; i < count; ++i) {
      changes.push_back(topic_ == dds::kParticipantTopic
                            ? read_change(*static_cast<const dds::BuiltinParticipant*>(samples[i]), info[i])
                            : read_change(*static_cast<const dds::BuiltinEndpoint*>(samples[i]), info[i]));
    }
    dds::functions().dds_return_loan(reader_.entity(), samples, count);
  }
}

}  // namespace coframe
