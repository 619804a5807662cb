// SPDX-License-Identifier: Apache-2.0
#include "wire/participant_reader.hpp"

#include <utility>

namespace coframe {

ParticipantReader::ParticipantReader(dds::Entity participant, std::shared_ptr<Event> on_change)
    : event_(std::move(on_change)),
      reader_(participant, dds::kParticipantTopic, nullptr, &ParticipantReader::on_data, this) {
  event_->set();
}

void ParticipantReader::on_data(dds::Entity, void* self) noexcept {
  static_cast<ParticipantReader*>(self)->event_->set();
}

std::size_t ParticipantReader::take_new() {
  std::size_t appeared = 0;
  for (;;) {
    void* samples[dds::kBatch] = {};  // null: DDS provides the memory
    dds::SampleInfo info[dds::kBatch];
    const dds::Code count = dds::functions().dds_take(reader_.entity(), samples, info, dds::kBatch, dds::kBatch);
    if (count <= 0) return appeared;
    for (dds::Code i = 0; i < count; ++i) {
      const bool alive = info[i].valid_data && info[i].instance_state == dds::kAliveInstance;
      if (!alive) {
        known_.erase(info[i].instance_handle);
      } else if (known_.insert(info[i].instance_handle).second) {
        ++appeared;
      }
    }
    dds::functions().dds_return_loan(reader_.entity(), samples, count);
  }
}

}  // namespace coframe
