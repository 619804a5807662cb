// SPDX-License-Identifier: Apache-2.0
// Receives transforms and stores them in a buffer, in the thread of DDS and without the GIL.
#pragma once

#include <memory>
#include <string>

#include "core/event.hpp"
#include "wire/data_reader.hpp"
#include "wire/qos.hpp"
#include "wire/transform_store.hpp"

namespace coframe {

class TfReader {
 public:
  // The arguments are those of TransformStore. `on_data` (may be null) is also set when a status changes.
  TfReader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
           std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
           std::shared_ptr<const Renaming> renaming, std::shared_ptr<Event> on_data);
  void close() noexcept { reader_.close(); }

  TransformStore& store() { return store_; }
  const TransformStore& store() const { return store_; }
  const DataReader& reader() const { return reader_; }
  DataReader& reader() { return reader_; }

 private:
  static void on_data(dds::Entity reader, void* self) noexcept;
  void drain(dds::Entity reader);

  TransformStore store_;
  DataReader reader_;  // last: its callback uses the store
};

}  // namespace coframe
