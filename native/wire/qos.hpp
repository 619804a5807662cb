// SPDX-License-Identifier: Apache-2.0
// Quality of service: the four policies that ROS programs set, and the DDS object that is created from them.
#pragma once

#include <memory>
#include <string>

#include "wire/dds.hpp"

namespace coframe {

struct QosProfile {
  std::int32_t depth;  // of keep-last
  bool reliable;
  bool transient_local;
  bool keep_all;
};

using QosPointer = std::unique_ptr<dds::Qos, void (*)(dds::Qos*)>;

// `user_data` is visible to other participants.
QosPointer make_qos(const std::string& user_data);
QosPointer make_qos(const QosProfile& profile, const std::string& user_data);

}  // namespace coframe
