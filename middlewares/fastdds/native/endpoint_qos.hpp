// SPDX-License-Identifier: Apache-2.0
// The quality of service of readers and writers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "participant.hpp"

namespace coframe::fastdds {

// Sets what readers and writers have in common.
template <class EndpointQos>
void set_common_qos(EndpointQos& to, const Qos& qos, const std::string& user_data, bool from_profile) {
  constexpr std::int32_t kKeepAll = 5000;  // messages, the default of Fast DDS
  constexpr std::int32_t kAllocated = 10;  // at once; more when they are needed
  if (!from_profile) {
    to.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    to.data_sharing().off();
  }
  to.reliability().kind = qos.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  to.reliability().max_blocking_time = to_duration(1'000'000'000);
  to.durability().kind = qos.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  to.history().kind = qos.keep_all ? dds::KEEP_ALL_HISTORY_QOS : dds::KEEP_LAST_HISTORY_QOS;
  to.history().depth = qos.depth;
  const std::int32_t history_depth = qos.keep_all ? kKeepAll : qos.depth;
  to.resource_limits().max_samples = history_depth;
  to.resource_limits().max_instances = 1;
  to.resource_limits().max_samples_per_instance = history_depth;
  to.resource_limits().allocated_samples = std::min(history_depth, kAllocated);
  to.deadline().period = to_duration(qos.deadline_ns);
  to.liveliness().kind = qos.manual_liveliness ? dds::MANUAL_BY_TOPIC_LIVELINESS_QOS : dds::AUTOMATIC_LIVELINESS_QOS;
  to.liveliness().lease_duration = to_duration(qos.lease_ns);
  if (qos.lease_ns != kInfinite) to.liveliness().announcement_period = to_duration(qos.lease_ns / 3 * 2);
  to.latency_budget().duration = to_duration(qos.latency_budget_ns);
  to.user_data().setValue({user_data.begin(), user_data.end()});
}

}  // namespace coframe::fastdds
