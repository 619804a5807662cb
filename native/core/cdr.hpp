// SPDX-License-Identifier: Apache-2.0
// Decodes and encodes tf2_msgs/TFMessage as CDR (XCDR1, with its 4-byte encapsulation header).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/tree.hpp"

namespace coframe {

// One transform of a message. The names point into the message's bytes.
struct TransformView {
  std::string_view parent, child;
  Stamp stamp;
  TransformValues values;
  // Both names with their lengths and padding, as they are stored between the stamp and the numbers of a little-endian
  // message.
  std::string_view name_bytes{};
  bool as_expected = false;  // the names equal the expected ones and are not set here
};

// The names of the transform at one position in a publisher's messages. Their padding depends on the position only.
struct ExpectedNames {
  std::string bytes;
  FrameId parent = 0, child = 0;
};

struct DecodeFailure {
  std::size_t offset = 0;        // bytes from the start of the message
  const char* reason = nullptr;  // nullptr: no failure
};

// Decodes a whole message or nothing. Every length is checked against the available bytes. Names that equal the
// expected ones at their position, which are known to be valid, are not checked again.
DecodeFailure decode_tf_message(const std::uint8_t* data, std::size_t size, std::vector<TransformView>& out,
                                std::span<const ExpectedNames> expected = {});

// Returns whether decode_tf_message() would succeed.
DecodeFailure check_tf_message(const std::uint8_t* data, std::size_t size);

// Encodes little endian, as ROS 2 does.
std::string encode_tf_message(const std::vector<TransformView>& transforms);

bool is_utf8(std::string_view text);

}  // namespace coframe
