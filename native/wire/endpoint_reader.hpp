// SPDX-License-Identifier: Apache-2.0
// The endpoints or participants found by DDS discovery, including those of this process, as they appear and disappear.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/event.hpp"
#include "wire/data_reader.hpp"
#include "wire/qos.hpp"

namespace coframe {

struct EndpointChange {
  dds::Handle handle;  // equals the publication_handle of a writer's samples
  bool alive;          // false: it has disappeared, and only the handle and the GUID are set
                       // A participant has no topic, type and QoS.
  dds::Guid guid{};
  dds::Guid participant{};
  std::string topic{};
  std::string type{};
  QosProfile qos{};
  std::string user_data{};
};

class EndpointReader {
 public:
  // `topic` is dds::kPublicationTopic, dds::kSubscriptionTopic or dds::kParticipantTopic. `on_change` is set whenever
  // something has changed.
  EndpointReader(dds::Entity participant, dds::Entity topic, std::shared_ptr<Event> on_change);
  void close() noexcept { reader_.close(); }
  // Returns the changes since the last call.
  std::vector<EndpointChange> take();

 private:
  static void on_data(dds::Entity, void* self) noexcept;

  const dds::Entity topic_;
  std::shared_ptr<Event> event_;
  DataReader reader_;  // last: its callback uses the members above
};

}  // namespace coframe
