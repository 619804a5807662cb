// SPDX-License-Identifier: Apache-2.0
// Serialised messages -> DDS.
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
  // `unchecked`: the topic is a dds::create_unchecked_topic() of transforms, and this checks what is written.
  Writer(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
         bool unchecked);
  ~Writer() { close(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Sends one message: 4 bytes of encapsulation, then CDR. Throws std::invalid_argument for less than that.
  void write(const void* data, std::size_t size) const;
  // The same on an unchecked topic, for a message of any type, without a check of its bytes.
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
  mutable std::mutex closing_;  // held while the topic's type, which ends with the entity, is used
  std::atomic<dds::Entity> entity_ = 0;
};

}  // namespace coframe
