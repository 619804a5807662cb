// SPDX-License-Identifier: Apache-2.0
// The type of all topics: its samples are serialized messages, with 4 bytes of encapsulation.
#pragma once

#include <coframe/middleware.h>

#include <cstring>
#include <functional>
#include <span>
#include <string>

#include "fastdds.hpp"

namespace coframe::fastdds {

// What is written: parts of a message.
struct Outgoing {
  std::span<const coframe_part> parts;
  std::uint32_t size;
};

// What is read: the payload of Fast DDS itself, which is valid until the loan of the sample is returned.
using Incoming = std::span<const std::uint8_t>;

class BytesType final : public dds::TopicDataType {
 public:
  explicit BytesType(const std::string& name) {
    constexpr std::uint32_t kInitialSize = 256;  // of the memory of a sample, which grows as needed
#if COFRAME_FASTDDS_3
    set_name(name);
    max_serialized_type_size = kInitialSize;
    is_compute_key_provided = false;
#else
    setName(name.c_str());
    m_typeSize = kInitialSize;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
#endif
  }

#if COFRAME_FASTDDS_3
  bool serialize(const void* const data, rtps::SerializedPayload_t& payload, dds::DataRepresentationId_t) override {
    return put(*static_cast<const Outgoing*>(data), payload);
  }
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override { return get(payload, data); }
  std::uint32_t calculate_serialized_size(const void* const data, dds::DataRepresentationId_t) override {
    return static_cast<const Outgoing*>(data)->size;
  }
  void* create_data() override { return new Incoming; }
  void delete_data(void* data) override { delete static_cast<Incoming*>(data); }
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override { return false; }
  bool compute_key(const void* const, rtps::InstanceHandle_t&, bool) override { return false; }
#else
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    return put(*static_cast<const Outgoing*>(data), *payload);
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override { return get(*payload, data); }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<const Outgoing*>(data)->size; };
  }
  void* createData() override { return new Incoming; }
  void deleteData(void* data) override { delete static_cast<Incoming*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
#endif

 private:
  static bool put(const Outgoing& message, rtps::SerializedPayload_t& payload) {
    if (payload.max_size < message.size) return false;
    auto* end = payload.data;
    for (const coframe_part& part : message.parts) {
      std::memcpy(end, part.data, part.size);
      end += part.size;
    }
    payload.length = message.size;
    payload.encapsulation = CDR_LE;
    return true;
  }

  static bool get(const rtps::SerializedPayload_t& payload, void* data) {
    *static_cast<Incoming*>(data) = {payload.data, payload.length};
    return true;
  }
};

}  // namespace coframe::fastdds
