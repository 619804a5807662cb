// SPDX-License-Identifier: Apache-2.0
// TFMessages are decoded from CDR, and from the format of ROS 1.
//
// Input: the format in a byte (odd: ROS 1), then the message.

#include <vector>

#include "core/cdr.hpp"
#include "core/ros1.hpp"
#include "input.hpp"

using namespace coframe;
using namespace coframe::fuzz;

namespace {

const std::uint8_t* bytes_of(const std::string& text) { return reinterpret_cast<const std::uint8_t*>(text.data()); }

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool is_ros1 = data[0] % 2 != 0;
  const Exact message({data + 1, size - 1});
  std::vector<TransformView> views;
  const DecodeFailure failure = is_ros1 ? decode_ros1_tf_message(message.data(), message.size(), views)
                                        : decode_tf_message(message.data(), message.size(), views);
  expect(failure.offset <= message.size(), "a failure is beyond the end");
  if (!is_ros1) {
    const bool is_valid = check_tf_message(message.data(), message.size()).reason == nullptr;
    expect(is_valid == (failure.reason == nullptr), "two decoders of CDR disagree");
  }
  if (failure.reason) return 0;
  const std::string encoded = encode_tf_message(views);
  std::vector<TransformView> again;
  expect(!decode_tf_message(bytes_of(encoded), encoded.size(), again).reason, "an encoded message is malformed");
  expect(encode_tf_message(again) == encoded, "a message changes when it is decoded and encoded");
  return 0;
}
