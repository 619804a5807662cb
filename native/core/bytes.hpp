// SPDX-License-Identifier: Apache-2.0
// Numbers and strings in sequence: little endian, without padding, read within bounds.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace coframe {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie");

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  // Returns false, without reading, if fewer bytes are left.
  template <class T>
  bool number(T& value) {
    if (left() < sizeof value) return false;
    std::memcpy(&value, next(), sizeof value);
    position_ += sizeof value;
    return true;
  }
  // A string is preceded by its length in 32 bits.
  bool text(std::string_view& value) {
    std::uint32_t length;
    if (!number(length) || left() < length) return false;
    value = {reinterpret_cast<const char*>(next()), length};
    position_ += length;
    return true;
  }
  void skip(std::size_t count) { position_ += count; }  // of the remaining bytes

  const std::uint8_t* next() const { return bytes_.data() + position_; }
  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size() - position_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
};

}  // namespace coframe
