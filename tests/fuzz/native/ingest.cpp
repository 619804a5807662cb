// SPDX-License-Identifier: Apache-2.0
// TFMessages of one publisher, in CDR or in the format of ROS 1, are stored in a buffer, which is then queried.
//
// Input: options (1: static, 2: ROS 1, 4: another name for frames, 8: a cache of 1 s), then messages, each preceded by
// its length in 32 bits.

#include <memory>
#include <string>
#include <vector>

#include "core/buffer.hpp"
#include "core/dump.hpp"
#include "input.hpp"

using namespace coframe;
using namespace coframe::fuzz;

namespace {

constexpr Stamp kSecond = 1'000'000'000;

void look_up_some(Buffer& buffer) {
  const std::vector<std::string> names = buffer.frame_names();
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 3); ++i) {
    LookupQuery query;
    query.target = names[i];
    query.source = names[names.size() - 1 - i];
    LookupResult result;
    Failure failure;
    if (buffer.lookup_by_name(query, result, failure)) continue;
    expect(!buffer.read([&](const Tree& tree) { return lookup_text(failure, tree); }).empty(), "a failure has no text");
  }
}

// What the buffer encodes is a valid message.
void encode(const Buffer& buffer) {
  for (const bool is_static : {false, true}) {
    const std::string bytes = buffer.encode(is_static);
    std::vector<TransformView> views;
    const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
    expect(!decode_tf_message(data, bytes.size(), views).reason, "a message of the buffer is malformed");
  }
}

void ingest(Buffer& buffer, TransformStream& stream, const Exact& bytes) {
  const Counts before = buffer.counts();
  std::size_t stored = 0;
  const DecodeFailure failure = buffer.ingest(stream, bytes.data(), bytes.size(), stored);
  const Counts after = buffer.counts();
  expect(after.messages == before.messages + 1, "the message was not counted");
  expect(after.stored - before.stored == stored, "the result differs from the count of stored transforms");
  const std::uint64_t counted = after.stored + after.refused + after.old - before.stored - before.refused - before.old;
  expect(!failure.reason || counted == 0, "transforms of a malformed message are counted");
  expect(failure.offset <= bytes.size(), "a failure is beyond the end");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const std::uint8_t options = input.byte();
  Buffer buffer((options & 8) != 0 ? kSecond : 10 * kSecond);
  const auto renaming = std::make_shared<const Renaming>("frame1", std::vector<std::string>{"frame2"});
  TransformStream stream = buffer.open_stream((options & 1) != 0, "fuzzer", (options & 4) != 0 ? renaming : nullptr);
  if ((options & 2) != 0) stream.encoding = TransformStream::Encoding::ros1;
  for (int messages = 0; !input.is_empty() && messages < 64; ++messages) ingest(buffer, stream, Exact(input.part()));
  look_up_some(buffer);
  encode(buffer);
  if ((options & 16) != 0) buffer.read([](const Tree& tree) { return frames_as_yaml(tree); });
  if ((options & 32) != 0) buffer.clear();
  return 0;
}
