// SPDX-License-Identifier: Apache-2.0
// Decodes tf2_msgs/TFMessage and tf/tfMessage as ROS 1 serializes them: little endian, unaligned, strings without NUL.
#pragma once

#include "core/cdr.hpp"

namespace coframe {

// Decodes like decode_tf_message().
DecodeFailure decode_ros1_tf_message(const std::uint8_t* data, std::size_t size, std::vector<TransformView>& out,
                                     std::span<const ExpectedNames> expected = {});

}  // namespace coframe
