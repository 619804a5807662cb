#include "wire/writer.hpp"

#include <stdexcept>

namespace coframe {

Writer::Writer(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data) {
  const QosPointer qos = make_qos(profile, user_data);
  entity_ = dds::check(dds::functions().dds_create_writer(participant, topic, qos.get(), nullptr), "create a writer");
}

namespace {

void check_encapsulation(std::size_t size) {
  if (size < 4) throw std::invalid_argument("a serialised message begins with 4 bytes of encapsulation");
}

}  // namespace

void Writer::write(const void* data, std::size_t size) const {
  check_encapsulation(size);
  const dds::SampleContainer sample{data, size};
  dds::check(dds::functions().dds_write(entity_, &sample), "write");
}

void Writer::forward(const void* data, std::size_t size) const {
  check_encapsulation(size);
  const dds::Functions& f = dds::functions();
  const dds::Sertype* type = nullptr;
  dds::check(f.dds_get_entity_sertype(entity_, &type), "read the writer's type");
  dds::IoVector bytes{};
  bytes.data = const_cast<void*>(data);
  bytes.size = static_cast<decltype(bytes.size)>(size);
  dds::Serdata* sample = f.ddsi_serdata_from_ser_iov(type, dds::kWholeSample, 1, &bytes, size);
  if (sample == nullptr) throw std::invalid_argument("the encapsulation is none that DDS knows");
  dds::check(f.dds_writecdr(entity_, sample), "write");  // which takes the sample
}

void Writer::close() noexcept {
  const dds::Entity entity = entity_.exchange(0);
  if (entity > 0 && !dds::forked()) dds::functions().dds_delete(entity);
}

dds::Guid Writer::guid() const {
  dds::Guid guid{};
  dds::check(dds::functions().dds_get_guid(entity_, &guid), "read the writer's GUID");
  return guid;
}

std::uint32_t Writer::matched() const {
  dds::MatchedStatus status{};
  dds::check(dds::functions().dds_get_publication_matched_status(entity_, &status), "count the readers");
  return status.current_count;
}

std::vector<dds::Handle> Writer::matched_handles() const {
  return dds::matched_handles(dds::functions().dds_get_matched_subscriptions, entity_);
}

dds::IncompatibleQosStatus Writer::incompatible() const {
  dds::IncompatibleQosStatus status{};
  dds::check(dds::functions().dds_get_offered_incompatible_qos_status(entity_, &status), "read the QoS status");
  return status;
}

}  // namespace coframe
