// SPDX-License-Identifier: Apache-2.0
// Serialized bytes in the form of a sample of Cyclone DDS 0.10.
//
// A sample must have the type of its writer, and 0.10 has no function that returns that type. But dds_writecdr accepts
// samples of other types and converts them: it asks the sample for its bytes and copies them into a sample of the
// writer's type. This is such a sample. It lives on the caller's stack and does not copy the bytes.
#pragma once

#include "wire/dds.hpp"

namespace coframe::dds {

class RawSample {
 public:
  RawSample(const void* data, std::size_t size) noexcept;

  Code write(Entity writer);

 private:
  // The beginning of ddsi_sertype_ops and of ddsi_sertype. The rest is not used for a sample that is converted.
  struct TypeOperations {
    const void* version;
  };
  struct Type {
    const TypeOperations* operations;
  };
  // ddsi_serdata_ops. Those that are null are not used for a sample that is converted.
  struct Operations {
    const void* eqkey = nullptr;
    std::uint32_t (*get_size)(const RawSample*);
    const void* constructors_and_to_ser[5] = {};
    const RawSample* (*to_ser_ref)(const RawSample*, std::size_t offset, std::size_t size, IoVector*);
    void (*to_ser_unref)(const RawSample*, const IoVector*);
    const void* to_sample_and_untyped[3] = {};
    void (*free)(const RawSample*);
    const void* print_keyhash_and_shared_memory[4] = {};
  };

  static std::uint32_t get_size(const RawSample* sample);
  static const RawSample* view(const RawSample* sample, std::size_t offset, std::size_t size, IoVector* bytes);
  static const Operations kOperations;

  // ddsi_serdata
  struct Header {
    const Operations* operations;
    std::uint32_t hash;
    std::uint32_t references;
    std::int32_t kind;
    const Type* type;
    std::int64_t timestamp;
    std::uint32_t status;
    std::int64_t written_at;
    void* shared_memory[2];
  };

  Header header_;
  const void* data_;
  std::size_t size_;
  TypeOperations type_operations_;
  Type type_;
};

}  // namespace coframe::dds
