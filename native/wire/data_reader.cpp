// SPDX-License-Identifier: Apache-2.0
#include "wire/data_reader.hpp"

namespace coframe {

DataReader::DataReader(dds::Entity participant, dds::Entity topic, const dds::Qos* qos, dds::DataCallback on_data,
                       void* argument) {
  const dds::Functions& f = dds::functions();
  // The listener is not passed to dds_create_reader, because a callback that runs before that returns could not yet
  // take samples.
  entity_ = dds::check(f.dds_create_reader(participant, topic, qos, nullptr), "create a reader");
  dds::Listener* listener = f.dds_create_listener(argument);
  f.dds_lset_data_available(listener, on_data);
  const dds::Code attached = f.dds_set_listener(entity_, listener);  // copies the listener
  f.dds_delete_listener(listener);
  if (attached < 0) {
    close();
    dds::check(attached, "listen for data");
  }
}

void DataReader::close() noexcept {
  const dds::Entity entity = entity_.exchange(0);
  if (entity <= 0 || dds::forked()) return;
  dds::functions().dds_set_listener(entity, nullptr);  // waits for running and pending callbacks
  dds::functions().dds_delete(entity);
}

dds::Guid DataReader::guid() const {
  dds::Guid guid{};
  dds::check(dds::functions().dds_get_guid(entity_, &guid), "read the reader's GUID");
  return guid;
}

std::uint32_t DataReader::matched() const {
  dds::MatchedStatus status{};
  dds::check(dds::functions().dds_get_subscription_matched_status(entity_, &status), "count the writers");
  return status.current_count;
}

std::vector<dds::Handle> DataReader::matched_handles() const {
  return dds::matched_handles(dds::functions().dds_get_matched_publications, entity_);
}

dds::IncompatibleQosStatus DataReader::incompatible() const {
  dds::IncompatibleQosStatus status{};
  dds::check(dds::functions().dds_get_requested_incompatible_qos_status(entity_, &status), "read the QoS status");
  return status;
}

}  // namespace coframe
