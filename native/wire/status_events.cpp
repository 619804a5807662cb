// SPDX-License-Identifier: Apache-2.0
#include "wire/status_events.hpp"

#include <utility>

#include "core/fork_guard.hpp"

namespace coframe {
namespace {

StatusEvents::Counts status_counts(const dds::DeadlineMissedStatus& s) {
  return {s.total_count, s.total_count_change, 0, 0};
}
StatusEvents::Counts status_counts(const dds::LostStatus& s) { return {s.total_count, s.total_count_change, 0, 0}; }
StatusEvents::Counts status_counts(const dds::IncompatibleQosStatus& s) {
  return {s.total_count, s.total_count_change, s.last_policy_id, 0};
}
StatusEvents::Counts status_counts(const dds::MatchedStatus& s) {
  return {s.total_count, s.total_count_change, s.current_count, s.current_count_change};
}
StatusEvents::Counts status_counts(const dds::LivelinessChangedStatus& s) {
  return {s.alive_count, s.not_alive_count, s.alive_count_change, s.not_alive_count_change};
}

// Adds the changes of an earlier status that was not taken yet.
void add_status_changes(StatusEvents::Counts& now, const StatusEvents::Counts& before,
                        const dds::LivelinessChangedStatus&) {
  now[2] += before[2];
  now[3] += before[3];
}
void add_status_changes(StatusEvents::Counts& now, const StatusEvents::Counts& before, const dds::MatchedStatus&) {
  now[1] += before[1];
  now[3] += before[3];
}
template <class Status>
void add_status_changes(StatusEvents::Counts& now, const StatusEvents::Counts& before, const Status&) {
  now[1] += before[1];
}

}  // namespace

template <StatusEvents::Kind kind, class Status>
void StatusEvents::on_status(dds::Entity, Status status, void* self) noexcept {
  auto& events = *static_cast<StatusEvents*>(self);
  {
    const ForkSafeLock lock(events.mutex_);
    StatusEvents::Counts counts = status_counts(status);
    if (auto& before = events.changed_[kind]) add_status_changes(counts, *before, status);
    events.changed_[kind] = counts;
  }
  if (events.on_change_) events.on_change_->set();
}

void StatusEvents::add_to_writer(dds::Listener* listener) {
  const dds::Functions& f = dds::functions();
  f.dds_lset_offered_deadline_missed_arg(listener, &on_status<kDeadlineMissed, dds::DeadlineMissedStatus>, this, true);
  f.dds_lset_liveliness_lost_arg(listener, &on_status<kLiveliness, dds::LostStatus>, this, true);
  f.dds_lset_offered_incompatible_qos_arg(listener, &on_status<kIncompatibleQos, dds::IncompatibleQosStatus>, this,
                                          true);
  f.dds_lset_publication_matched_arg(listener, &on_status<kMatched, dds::MatchedStatus>, this, true);
}

void StatusEvents::add_to_reader(dds::Listener* listener) {
  const dds::Functions& f = dds::functions();
  f.dds_lset_requested_deadline_missed_arg(listener, &on_status<kDeadlineMissed, dds::DeadlineMissedStatus>, this,
                                           true);
  f.dds_lset_liveliness_changed_arg(listener, &on_status<kLiveliness, dds::LivelinessChangedStatus>, this, true);
  f.dds_lset_requested_incompatible_qos_arg(listener, &on_status<kIncompatibleQos, dds::IncompatibleQosStatus>, this,
                                            true);
  f.dds_lset_subscription_matched_arg(listener, &on_status<kMatched, dds::MatchedStatus>, this, true);
  f.dds_lset_sample_lost_arg(listener, &on_status<kSampleLost, dds::LostStatus>, this, true);
}

std::optional<StatusEvents::Counts> StatusEvents::take(Kind kind) {
  const std::lock_guard lock(mutex_);
  return std::exchange(changed_[kind], std::nullopt);
}

}  // namespace coframe
