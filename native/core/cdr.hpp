// tf2_msgs/TFMessage as CDR (XCDR1, with its 4-byte encapsulation header): bytes in, bytes out.
#pragma once

#include <cstddef>
#include <cstdint>
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
};

struct DecodeFailure {
  std::size_t offset = 0;        // from the first byte of the message
  const char* reason = nullptr;  // nullptr: none
};

// Decodes a whole message or nothing: every length is checked against the bytes that are there.
DecodeFailure decode_tf_message(const std::uint8_t* data, std::size_t size, std::vector<TransformView>& out);

// Little endian, as ROS 2 writes it.
std::string encode_tf_message(const std::vector<TransformView>& transforms);

bool is_utf8(std::string_view text);

}  // namespace coframe
