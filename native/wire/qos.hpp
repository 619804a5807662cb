// SPDX-License-Identifier: Apache-2.0
// Quality of service: the policies that ROS programs set, and the DDS object that is created from them.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "wire/dds.hpp"

namespace coframe {

inline constexpr std::int64_t kInfinite = std::numeric_limits<std::int64_t>::max();  // DDS_INFINITY

struct QosProfile {
  std::int32_t depth;  // of keep-last
  bool reliable;
  bool transient_local;
  bool keep_all;
  bool manual_liveliness = false;  // the publisher asserts its liveliness itself
  std::int64_t deadline_ns = kInfinite;
  std::int64_t lifespan_ns = kInfinite;   // of a writer's messages
  std::int64_t lease_ns = kInfinite;      // the time without a sign of life after which a writer counts as lost
  std::vector<std::string> partitions{};  // empty: the default partition
};

using QosPointer = std::unique_ptr<dds::Qos, void (*)(dds::Qos*)>;

// `user_data` is visible to other participants.
QosPointer make_qos(const std::string& user_data);
QosPointer make_qos(const QosProfile& profile, const std::string& user_data);

}  // namespace coframe
