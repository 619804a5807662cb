// SPDX-License-Identifier: Apache-2.0
// A DDS domain with its configuration, and a participant in it.
#pragma once

#include <atomic>
#include <string>

#include "wire/dds.hpp"

namespace coframe {

class DomainParticipant {
 public:
  // `config` is the XML configuration of Cyclone DDS. Other participants can read `user_data`. If this process has
  // already opened the domain, it is shared, and `config` has no effect.
  DomainParticipant(std::uint32_t domain, const std::string& config, const std::string& user_data);
  ~DomainParticipant() { close(); }
  DomainParticipant(const DomainParticipant&) = delete;
  DomainParticipant& operator=(const DomainParticipant&) = delete;

  // Deletes the participant with all its entities. Returns after the threads of DDS have ended.
  void close() noexcept;
  dds::Entity entity() const { return participant_; }
  dds::Guid guid() const;
  // Replaces the user data. If they differ, DDS announces the participant immediately.
  void set_user_data(const std::string& user_data);

 private:
  dds::Entity domain_ = 0;  // 0: opened by another part of the process
  std::atomic<dds::Entity> participant_ = 0;
};

}  // namespace coframe
