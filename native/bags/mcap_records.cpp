// SPDX-License-Identifier: Apache-2.0
#include "bags/mcap_records.hpp"

#include <bit>
#include <cstring>

namespace coframe {

namespace {

static_assert(std::endian::native == std::endian::little, "MCAP is little-endian and is read without conversion");

constexpr std::uint8_t kSchema = 0x03, kChannel = 0x04, kMessage = 0x05;
constexpr std::uint8_t kPrivate = 0x80;   // records from here on are private extensions and are skipped
constexpr std::size_t kHead = 9;          // opcode and length
constexpr std::size_t kMessageHead = 22;  // channel, sequence number, log time, publish time

template <class T>
T number_at(const std::uint8_t* data) {
  T value;
  std::memcpy(&value, data, sizeof value);
  return value;
}

}  // namespace

McapRecords find_mcap_records(const std::uint8_t* data, std::size_t size) {
  McapRecords found;
  while (size - found.size >= kHead) {
    const std::uint8_t* record = data + found.size;
    const std::uint8_t opcode = record[0];
    const auto length = number_at<std::uint64_t>(record + 1);
    if (length > size - found.size - kHead) break;
    const std::size_t start = found.size + kHead, end = start + length;
    if (opcode == kMessage) {
      if (length < kMessageHead) break;
      found.channels.push_back(number_at<std::uint16_t>(data + start));
      found.times.push_back(number_at<std::uint64_t>(data + start + 6));
      found.records.push_back(found.size);
      found.starts.push_back(start + kMessageHead);
      found.ends.push_back(end);
    } else if (opcode == kSchema || opcode == kChannel) {
      found.definitions.push_back({opcode, start, end});
    } else if (opcode < kPrivate) {
      break;
    }
    found.size = end;
  }
  return found;
}

}  // namespace coframe
