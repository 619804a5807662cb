// SPDX-License-Identifier: Apache-2.0
#include "wire/reader.hpp"

#include <algorithm>
#include <utility>

namespace coframe {

Reader::Reader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
               std::shared_ptr<Event> on_data_event)
    : event_(std::move(on_data_event)),
      reader_(participant, topic, make_qos(profile, user_data).get(), &Reader::on_data, this, event_) {
  if (event_) event_->set();
}

void Reader::on_data(dds::Entity, void* self) noexcept {
  Reader& reader = *static_cast<Reader*>(self);
  reader.pending_ = true;
  if (reader.event_) reader.event_->set();
}

std::vector<dds::Sample> Reader::take(std::uint32_t limit) {
  std::vector<dds::Sample> samples;
  std::uint32_t remaining = limit;
  pending_ = false;
  while (remaining > 0) {
    samples.reserve(samples.size() + std::min(remaining, dds::kBatch));
    const std::uint32_t request_size = std::min(remaining, dds::kBatch);
    const std::size_t before = samples.size();
    const std::uint32_t taken =
        dds::take(reader_.entity(), request_size, [&](dds::Sample&& sample) { samples.push_back(std::move(sample)); });
    remaining -= static_cast<std::uint32_t>(samples.size() - before);
    if (taken < request_size) return samples;
  }
  pending_ = true;
  return samples;
}

}  // namespace coframe
