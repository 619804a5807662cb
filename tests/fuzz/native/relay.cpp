// SPDX-License-Identifier: Apache-2.0
// TFMessages of several publishers pass a relay, which merges them into one tree.
//
// Input: options (1: static, 2: at most 20 Hz, 4: with a maximum error), then messages: the publisher and milliseconds
// in a byte each, the length in 32 bits, the bytes.

#include <string>
#include <vector>

#include "core/relay.hpp"
#include "input.hpp"

using namespace coframe;
using namespace coframe::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const std::uint8_t options = input.byte();
  Relay relay((options & 1) != 0, (options & 2) != 0 ? 50'000'000 : 0,
              (options & 4) != 0 ? std::optional(MaxError{0.01, 0.01}) : std::nullopt);
  relay.add_source(Renaming("frame1", {"frame2"}), Relay::Direction::merge);
  relay.add_source(Renaming("frame1", {"frame2"}), Relay::Direction::split);
  std::int64_t now = 0;
  for (int messages = 0; !input.is_empty() && messages < 64; ++messages) {
    const std::uint8_t publisher = input.byte();
    now += input.byte() * std::int64_t{1'000'000};
    const Exact bytes(input.part());
    relay.add(publisher % 2, publisher / 2, bytes.data(), bytes.size(), now, now);
    if (publisher % 16 == 0) relay.forget_writer(publisher % 2, publisher / 2);
    const std::string written = relay.take(now);
    std::vector<TransformView> views;
    expect(written.empty() ||
               !decode_tf_message(reinterpret_cast<const std::uint8_t*>(written.data()), written.size(), views).reason,
           "a relayed message is malformed");
  }
  for (const Relay::Edge& edge : relay.edges()) expect(!relay.claim(edge).child.empty(), "a relayed frame has no name");
  return 0;
}
