// SPDX-License-Identifier: Apache-2.0
// tf2_msgs/TFMessage as CDR (XCDR1, with its 4-byte encapsulation header): bytes in, bytes out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/tree.hpp"

namespace coframe {

// One transform of a message; the names point into the message's bytes.
struct TransformView {
  std::string_view parent, child;
  Stamp stamp;
  TransformValues values;
  // Both names with their lengths and paddings, as they lie between the stamp and the numbers of a little-endian
  // message.
  std::string_view name_bytes{};
  bool as_expected = false;  // they are those that were expected: no name is set
};

// The names that a transform at some place of a source's messages had. How they are padded depends on the place alone.
struct ExpectedNames {
  std::string bytes;
  FrameId parent = 0, child = 0;
};

struct DecodeFailure {
  std::size_t offset = 0;        // from the first byte of the message
  const char* reason = nullptr;  // nullptr: none
};

// Decodes a whole message or nothing: every length is checked against the bytes that are there. What equals the names
// that are expected at its place, good ones, is not checked again.
DecodeFailure decode_tf_message(const std::uint8_t* data, std::size_t size, std::vector<TransformView>& out,
                                std::span<const ExpectedNames> expected = {});

// Whether decode_tf_message() would decode it.
DecodeFailure check_tf_message(const std::uint8_t* data, std::size_t size);

// Little endian, as ROS 2 writes it.
std::string encode_tf_message(const std::vector<TransformView>& transforms);

bool is_utf8(std::string_view text);

}  // namespace coframe
