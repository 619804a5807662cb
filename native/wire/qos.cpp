// SPDX-License-Identifier: Apache-2.0
#include "wire/qos.hpp"

namespace coframe {
namespace {

// How long a write waits for a slow reliable reader before it fails.
constexpr std::int64_t kMaxBlockingNs = 1'000'000'000;

}  // namespace

QosPointer make_qos(const std::string& user_data) {
  const dds::Functions& f = dds::functions();
  QosPointer qos(f.dds_create_qos(), f.dds_delete_qos);
  if (!user_data.empty()) f.dds_qset_userdata(qos.get(), user_data.data(), user_data.size());
  return qos;
}

QosPointer make_qos(const QosProfile& profile, const std::string& user_data) {
  const dds::Functions& f = dds::functions();
  QosPointer qos = make_qos(user_data);
  const auto history = profile.keep_all ? dds::kKeepAll : dds::kKeepLast;
  const std::int32_t depth = profile.keep_all ? 1 : profile.depth;
  f.dds_qset_history(qos.get(), history, depth);
  f.dds_qset_reliability(qos.get(), profile.reliable ? dds::kReliable : dds::kBestEffort, kMaxBlockingNs);
  f.dds_qset_durability(qos.get(), profile.transient_local ? dds::kTransientLocal : dds::kVolatile);
  f.dds_qset_deadline(qos.get(), profile.deadline_ns);
  f.dds_qset_lifespan(qos.get(), profile.lifespan_ns);
  f.dds_qset_liveliness(qos.get(), profile.manual_liveliness ? dds::kManualByTopic : dds::kAutomatic, profile.lease_ns);
  if (profile.transient_local) {
    // Late joiners receive as many messages as the writer's history holds.
    f.dds_qset_durability_service(qos.get(), 0, history, depth, dds::kUnlimited, dds::kUnlimited, dds::kUnlimited);
  }
  if (!profile.partitions.empty()) {
    std::vector<const char*> names;
    for (const std::string& partition : profile.partitions) names.push_back(partition.c_str());
    f.dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
  }
  const std::int16_t representation = dds::kXcdr1;
  f.dds_qset_data_representation(qos.get(), 1, &representation);
  return qos;
}

}  // namespace coframe
