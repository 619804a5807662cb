// SPDX-License-Identifier: Apache-2.0
// Numbers and texts in a row, little endian and without padding, read within bounds.
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

  // False, and nothing is read, where there are not as many bytes.
  template <class T>
  bool number(T& value) {
    if (left() < sizeof value) return false;
    std::memcpy(&value, next(), sizeof value);
    position_ += sizeof value;
    return true;
  }
  // Behind its length, as 32 bits.
  bool text(std::string_view& value) {
    std::uint32_t length;
    if (!number(length) || left() < length) return false;
    value = {reinterpret_cast<const char*>(next()), length};
    position_ += length;
    return true;
  }
  void skip(std::size_t count) { position_ += count; }  // of those that are left

  const std::uint8_t* next() const { return bytes_.data() + position_; }
  std::size_t position() const { return position_; }
  std::size_t left() const { return bytes_.size() - position_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t position_ = 0;
};

}  // namespace coframe
