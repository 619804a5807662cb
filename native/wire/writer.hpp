// SPDX-License-Identifier: Apache-2.0
// Publishes serialised messages.
#pragma once

#include <atomic>
#include <mutex>
#include <string>
#include <vector>

#include "wire/dds.hpp"
#include "wire/qos.hpp"

namespace coframe {

class Writer {
 public:
  // `unchecked`: the topic was created by dds::create_unchecked_topic() for transforms, so this class checks messages
  // before it sends them.
  Writer(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
         bool unchecked);
  ~Writer() { close(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Sends one message: 4 bytes of encapsulation, then CDR. Throws std::invalid_argument for less than 4 bytes.
  void write(const void* data, std::size_t size) const;
  // Sends one message of any type on an unchecked topic without checking its bytes.
  void forward(const void* data, std::size_t size) const;
  void close() noexcept;

  dds::Guid guid() const;
  std::uint32_t matched() const;
  std::vector<dds::Handle> matched_handles() const;
  dds::IncompatibleQosStatus incompatible() const;

 private:
  dds::Code write_unchecked(const void* data, std::size_t size) const;
  dds::Code pass_on(const void* data, std::size_t size) const;

  const bool unchecked_;
  mutable std::mutex closing_;  // held while the type of the topic is used, because close() deletes it
  std::atomic<dds::Entity> entity_ = 0;
};

}  // namespace coframe
