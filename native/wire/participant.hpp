// SPDX-License-Identifier: Apache-2.0
// One membership in a DDS domain: the domain with its configuration, and a participant in it.
#pragma once

#include <atomic>
#include <string>

#include "wire/dds.hpp"

namespace coframe {

class DomainParticipant {
 public:
  // `config` is Cyclone's XML; `user_data` is what other participants read of this one.
  // A domain that this process has already opened by other means is shared, with its configuration.
  DomainParticipant(std::uint32_t domain, const std::string& config, const std::string& user_data);
  ~DomainParticipant() { close(); }
  DomainParticipant(const DomainParticipant&) = delete;
  DomainParticipant& operator=(const DomainParticipant&) = delete;

  // Deletes the participant and all that is in it; returns when DDS's threads have ended.
  void close() noexcept;
  dds::Entity entity() const { return participant_; }
  dds::Guid guid() const;

 private:
  dds::Entity domain_ = 0;  // 0: not ours to delete
  std::atomic<dds::Entity> participant_ = 0;
};

}  // namespace coframe
