// SPDX-License-Identifier: Apache-2.0
// The status changes of an endpoint and the endpoints that it has matched, recorded on the threads of Fast DDS.
#pragma once

#include <array>
#include <cstdint>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "participant.hpp"

namespace coframe::fastdds {

class StatusEvents {
 public:
  // The numbers of coframe._core.
  enum Kind : std::size_t { kDeadlineMissed, kLiveliness, kIncompatibleQos, kMatched, kSampleLost, kKinds };
  // The members of the DDS status, in their order; handles are left out, and 0 stands for missing members.
  using Counts = std::array<std::int64_t, 4>;

  // `on_change` (may be null) is set whenever a status has changed.
  explicit StatusEvents(void* on_change) : on_change_(on_change) {}

  // Returns the counts if they have changed since the last call. The changes are those since the last call.
  std::optional<Counts> take(Kind kind) {
    const std::lock_guard lock(mutex_);
    return std::exchange(changed_[kind], std::nullopt);
  }
  std::vector<Handle> matched() const {
    const std::lock_guard lock(mutex_);
    return {matched_.begin(), matched_.end()};
  }
  std::int64_t refused_policy() const {
    const std::lock_guard lock(mutex_);
    return refused_policy_;
  }

  template <class Status>
  void add_total(Kind kind, const Status& status) {
    add(kind, {status.total_count, status.total_count_change, 0, 0}, {false, true, false, false});
  }
  template <class Status>
  void add_incompatible(const Status& status) {
    {
      const std::lock_guard lock(mutex_);
      refused_policy_ = status.last_policy_id;
    }
    add(kIncompatibleQos, {status.total_count, status.total_count_change, status.last_policy_id, 0},
        {false, true, false, false});
  }
  template <class Status>
  void add_liveliness(const Status& s) {
    add(kLiveliness, {s.alive_count, s.not_alive_count, s.alive_count_change, s.not_alive_count_change},
        {false, false, true, true});
  }
  template <class Status>
  void add_matched(const Status& s, const rtps::InstanceHandle_t& other) {
    const Handle handle = handle_of(rtps::iHandle2GUID(other));
    {
      const std::lock_guard lock(mutex_);
      if (s.current_count_change > 0) matched_.insert(handle);
      if (s.current_count_change < 0) matched_.erase(handle);
    }
    add(kMatched, {s.total_count, s.total_count_change, s.current_count, s.current_count_change},
        {false, true, false, true});
  }

 private:
  // Changes that were not taken yet are added.
  void add(Kind kind, Counts counts, std::array<bool, 4> is_change) {
    {
      const std::lock_guard lock(mutex_);
      if (const auto& before = changed_[kind]) {
        for (std::size_t i = 0; i < counts.size(); ++i) counts[i] += is_change[i] ? (*before)[i] : 0;
      }
      changed_[kind] = counts;
    }
    if (on_change_ != nullptr) core->set_event(on_change_);
  }

  void* const on_change_;
  mutable std::mutex mutex_;
  std::array<std::optional<Counts>, kKinds> changed_;
  std::set<Handle> matched_;
  std::int64_t refused_policy_ = 0;
};

}  // namespace coframe::fastdds
