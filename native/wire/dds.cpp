// SPDX-License-Identifier: Apache-2.0
#include "wire/dds.hpp"

#include <utility>

#include "wire/library.hpp"
#include "wire/raw_sample.hpp"

namespace coframe::dds {

Error::Error(const std::string& what, Code code)
    : std::runtime_error("could not " + what + ": " + loaded.dds_strretcode(code)), code_(code) {}

Code check(Code code, const char* what) {
  if (code < 0) throw Error(what, code);
  return code;
}

Entity create_unchecked_topic(Entity participant, const std::string& name, const std::string& type) {
  // One octet and no type description: the type matches by name only, with or without type information on the other
  // side.
  constexpr std::uint32_t kOctetAtOffset = 0x01010000, kEnd = 0;
  constexpr std::uint32_t instructions[] = {kOctetAtOffset, 0, kEnd};
  const TypeDescriptor descriptor{.size = 1,
                                  .alignment = 1,
                                  .flags = 0,
                                  .key_count = 0,
                                  .name = type.c_str(),
                                  .keys = nullptr,
                                  .instruction_count = 2,
                                  .instructions = instructions,
                                  .meta = "",
                                  .type_information = {},
                                  .type_mapping = {},
                                  .representations = 0};
  return check(functions().dds_create_topic(participant, &descriptor, name.c_str(), nullptr, nullptr),
               "create the topic");
}

const Sertype* type_of(Entity entity) {
  const Functions& f = functions();
  const Sertype* type = nullptr;
  if (f.dds_get_entity_sertype != nullptr) check(f.dds_get_entity_sertype(entity, &type), "read the type");
  return type;
}

Code write(Entity writer, const Sertype* type, std::span<const IoVector> parts, std::size_t size) {
  const Functions& f = functions();
  if (type == nullptr) {
    if (parts.size() == 1) return RawSample(parts[0].data, size).write(writer);
    std::vector<char> bytes;
    bytes.reserve(size);
    for (const IoVector& part : parts) {
      const char* begin = static_cast<const char*>(part.data);
      bytes.insert(bytes.end(), begin, begin + part.size);
    }
    return RawSample(bytes.data(), size).write(writer);
  }
  Serdata* sample = f.ddsi_serdata_from_ser_iov(type, kData, parts.size(), parts.data(), size);  // copies the bytes
  return sample ? f.dds_writecdr(writer, sample) : kBadParameter;                                // releases the sample
}

void release_topic(Entity topic) {
  if (topic < kPublicationTopic) functions().dds_delete(topic);
}

std::vector<Handle> matched_handles(Code (*get)(Entity, Handle*, std::size_t), Entity entity) {
  std::vector<Handle> handles;
  for (;;) {
    const Code count = check(get(entity, handles.data(), handles.size()), "list the matched endpoints");
    const bool all = static_cast<std::size_t>(count) <= handles.size();
    handles.resize(static_cast<std::size_t>(count));
    if (all) return handles;
  }
}

Sample::Sample(Serdata* data, const SampleInfo& info) noexcept : data_(data), info_(info) {
  view_ = loaded.ddsi_serdata_to_ser_ref(data, 0, loaded.ddsi_serdata_size(data), &bytes_);
}

Sample::Sample(Sample&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      view_(std::exchange(other.view_, nullptr)),
      bytes_(other.bytes_),
      info_(other.info_) {}

Sample::~Sample() {
  if (view_ != nullptr) loaded.ddsi_serdata_to_ser_unref(view_, &bytes_);
  if (data_ != nullptr) loaded.ddsi_serdata_unref(data_);
}

std::span<const std::uint8_t> Sample::bytes() const noexcept {
  return {static_cast<const std::uint8_t*>(bytes_.data), static_cast<std::size_t>(bytes_.size)};
}

}  // namespace coframe::dds
