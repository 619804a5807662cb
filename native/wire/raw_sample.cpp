// SPDX-License-Identifier: Apache-2.0
#include "wire/raw_sample.hpp"

#include <limits>

namespace coframe::dds {

const RawSample::Operations RawSample::kOperations{
    .get_size = &RawSample::get_size,
    .to_ser_ref = &RawSample::view,
    .to_ser_unref = [](const RawSample*, const IoVector*) {},
    .free = [](const RawSample*) {},
};

RawSample::RawSample(const void* data, std::size_t size) noexcept
    : header_{.operations = &kOperations, .references = 1, .kind = kData, .type = &type_},
      data_(data),
      size_(size),
      type_operations_{functions().ddsi_sertype_v0},
      type_{&type_operations_} {}

Code RawSample::write(Entity writer) {
  if (size_ > std::numeric_limits<std::uint32_t>::max()) return kBadParameter;
  return functions().dds_writecdr(writer, reinterpret_cast<Serdata*>(this));
}

std::uint32_t RawSample::get_size(const RawSample* sample) { return static_cast<std::uint32_t>(sample->size_); }

const RawSample* RawSample::view(const RawSample* sample, std::size_t offset, std::size_t size, IoVector* bytes) {
  bytes->data = const_cast<char*>(static_cast<const char*>(sample->data_) + offset);
  bytes->size = static_cast<decltype(bytes->size)>(size);
  return sample;
}

}  // namespace coframe::dds
