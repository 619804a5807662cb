// SPDX-License-Identifier: Apache-2.0
#include "wire/tf_reader.hpp"

#include <utility>

namespace coframe {

TfReader::TfReader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
                   std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
                   std::shared_ptr<const Renaming> renaming, std::shared_ptr<Event> on_data_event)
    : store_(std::move(buffer), is_static, authority, std::move(renaming), on_data_event),
      reader_(participant, topic, make_qos(profile, user_data).get(), &TfReader::on_data, this, on_data_event) {
  on_data(reader_.entity(), this);  // samples that arrived before the listener was attached
}

// DDS is written in C, so no exception may reach it. If memory runs out, a message is lost.
void TfReader::on_data(dds::Entity reader, void* self) noexcept {
  try {
    static_cast<TfReader*>(self)->drain(reader);
  } catch (...) {
  }
}

void TfReader::drain(dds::Entity reader) {
  const auto drain_batch = [&] {
    TransformStore::Ingest ingest(store_);  // also while samples are taken, so that they stay in their order
    return dds::take(reader, dds::kBatch, [&ingest](const dds::Sample& sample) {
      ingest.add(sample.info().publication_handle, sample.bytes());
    });
  };
  while (drain_batch() == dds::kBatch) {
  }
}

}  // namespace coframe
