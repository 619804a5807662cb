// Serialised messages -> DDS.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "wire/dds.hpp"
#include "wire/qos.hpp"

namespace coframe {

class Writer {
 public:
  Writer(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data);
  ~Writer() { close(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Sends one message: 4 bytes of encapsulation, then CDR. Throws std::invalid_argument for less than that.
  void write(const void* data, std::size_t size) const;
  // The same on an unchecked topic, whose bytes nobody here understands.
  void forward(const void* data, std::size_t size) const;
  void close() noexcept;

  dds::Guid guid() const;
  std::uint32_t matched() const;
  std::vector<dds::Handle> matched_handles() const;
  dds::IncompatibleQosStatus incompatible() const;

 private:
  std::atomic<dds::Entity> entity_ = 0;
};

}  // namespace coframe
