// SPDX-License-Identifier: Apache-2.0
#include "wire/data_reader.hpp"

#include <memory>
#include <utility>

namespace coframe {

DataReader::DataReader(dds::Entity participant, dds::Entity topic, const dds::Qos* qos, dds::DataCallback on_data,
                       void* argument, std::shared_ptr<Event> on_change)
    : events_(on_change) {
  const dds::Functions& f = dds::functions();
  const std::unique_ptr<dds::Listener, void (*)(dds::Listener*)> listener(f.dds_create_listener(argument),
                                                                          f.dds_delete_listener);
  if (on_change) events_.add_to_reader(listener.get());
  // The data callback is not passed to dds_create_reader, because it could not take samples before that returns.
  entity_ = dds::check(f.dds_create_reader(participant, topic, qos, listener.get()), "create a reader");
  dds::release_topic(topic);
  f.dds_lset_data_available(listener.get(), on_data);
  const dds::Code attached = f.dds_set_listener(entity_, listener.get());  // copies the listener
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
