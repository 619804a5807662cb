// SPDX-License-Identifier: Apache-2.0
#include "wire/participant.hpp"

#include "wire/qos.hpp"

namespace coframe {

DomainParticipant::DomainParticipant(std::uint32_t domain, const std::string& config, const std::string& user_data) {
  const dds::Functions& f = dds::functions();
  const dds::Entity created = f.dds_create_domain(domain, config.c_str());
  if (created != dds::kPreconditionNotMet) domain_ = dds::check(created, "open the DDS domain");
  const QosPointer qos = make_qos(user_data);
  const dds::Entity participant = f.dds_create_participant(domain, qos.get(), nullptr);
  if (participant < 0 && domain_ > 0) f.dds_delete(domain_);
  participant_ = dds::check(participant, "join the DDS domain");
  dds::count_participants(1);
}

void DomainParticipant::close() noexcept {
  const dds::Entity participant = participant_.exchange(0);
  if (participant <= 0 || dds::forked()) return;
  dds::functions().dds_delete(participant);
  if (domain_ > 0) dds::functions().dds_delete(domain_);
  dds::count_participants(-1);
}

dds::Guid DomainParticipant::guid() const {
  dds::Guid guid{};
  dds::check(dds::functions().dds_get_guid(participant_, &guid), "read the participant's GUID");
  return guid;
}

void DomainParticipant::set_user_data(const std::string& user_data) {
  const QosPointer qos = make_qos(user_data);
  dds::check(dds::functions().dds_set_qos(participant_, qos.get()), "change the participant's user data");
}

}  // namespace coframe
