// SPDX-License-Identifier: Apache-2.0
#include "wire/tap.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "core/fork_guard.hpp"

namespace coframe {
namespace {

std::int64_t now() {
  const auto since_1970 = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_1970).count();
}

}  // namespace

Tap::Tap(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
         const Limits& limits)
    : limits_(limits), reader_(participant, topic, make_qos(profile, user_data).get(), &Tap::on_data, this) {
  on_data(reader_.entity(), this);  // samples that arrived before the listener was attached
}

// DDS is written in C, so no exception may reach it. If memory runs out, a message is lost.
void Tap::on_data(dds::Entity reader, void* self) noexcept {
  try {
    static_cast<Tap*>(self)->drain(reader);
  } catch (...) {
  }
}

void Tap::drain(dds::Entity reader) {
  const std::int64_t arrival_time = now();
  const auto keep = [&](const dds::Sample& sample) {
    if (messages_.ends.size() >= limits_.messages || messages_.bytes.size() >= limits_.size) {
      ++missed_;
      return;
    }
    const auto bytes = sample.bytes();
    messages_.bytes.append(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), limits_.head));
    messages_.arrived.push_back(arrival_time);
    messages_.sent.push_back(sample.info().source_timestamp);
    messages_.writers.push_back(sample.info().publication_handle);
    messages_.ends.push_back(messages_.bytes.size());
  };
  const auto drain_batch = [&] {
    const ForkSafeLock lock(mutex_);
    return dds::take(reader, dds::kBatch, keep);
  };
  while (drain_batch() == dds::kBatch) {
  }
}

Tap::Messages Tap::take() {
  const ForkSafeLock lock(mutex_);
  return std::exchange(messages_, {});
}

std::uint64_t Tap::missed() {
  const ForkSafeLock lock(mutex_);
  return missed_;
}

}  // namespace coframe
