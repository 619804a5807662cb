// SPDX-License-Identifier: Apache-2.0
// A DDS domain with its configuration, and a participant in it.
#pragma once

#include <atomic>
#include <string>

#include "wire/dds.hpp"

namespace coframe {

class DomainParticipant {
 public:
  // `config` is Cyclone's XML; other participants can read `user_data`. A domain that this process has already opened
  // elsewhere is shared, with its configuration.
  DomainParticipant(std::uint32_t domain, const std::string& config, const std::string& user_data);
  ~DomainParticipant() { close(); }
  DomainParticipant(const DomainParticipant&) = delete;
  DomainParticipant& operator=(const DomainParticipant&) = delete;

  // Deletes the participant with everything in it; returns when DDS's threads have ended.
  void close() noexcept;
  dds::Entity entity() const { return participant_; }
  dds::Guid guid() const;

 private:
  dds::Entity domain_ = 0;  // 0: owned elsewhere
  std::atomic<dds::Entity> participant_ = 0;
};

}  // namespace coframe
