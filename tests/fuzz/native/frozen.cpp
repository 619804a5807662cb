// SPDX-License-Identifier: Apache-2.0
// A frozen buffer is opened in place and queried.
//
// Input: the table, preceded by its length in 32 bits, then the samples.

#include <memory>
#include <string>
#include <vector>

#include "core/buffer.hpp"
#include "core/dump.hpp"
#include "core/frozen.hpp"
#include "input.hpp"

using namespace coframe;
using namespace coframe::fuzz;

namespace {

constexpr Stamp kSecond = 1'000'000'000;

void look_up_many(const Buffer& buffer, const std::string& target, const std::string& source) {
  std::vector<Stamp> stamps(20);
  for (std::size_t i = 0; i < stamps.size(); ++i) stamps[i] = static_cast<Stamp>(i) * 7 * kSecond / 10;
  std::vector<double> poses(7 * stamps.size()), twists(6 * stamps.size());
  LookupQuery query;
  query.target = target;
  query.source = source;
  Failure failure;
  const Batch batch{stamps.size(), stamps.data(), poses.data(), twists.data(), nullptr, Batch::Missing::nan};
  buffer.lookup_many(query, nullptr, batch, 1, failure);
  buffer.stamps_between(query, kSecond, 3 * kSecond, stamps, failure);
}

void look_up_some(Buffer& buffer) {
  const std::vector<std::string> names = buffer.frame_names();
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 3); ++i) {
    const std::string& from = names[names.size() - 1 - i];
    const FrameId target = buffer.find(names[i]), source = buffer.find(from);
    if (target == 0 || source == 0) continue;
    for (const Stamp requested : {Stamp{0}, kSecond, 5 * kSecond, Stamp{-1}}) {
      Stamp stamp = requested;
      Pose pose;
      Failure failure;
      if (buffer.lookup_by_id(target, source, stamp, pose, failure)) continue;
      expect(!buffer.read([&](const Tree& tree) { return lookup_text(failure, tree); }).empty(),
             "a failure has no text");
    }
    look_up_many(buffer, names[i], from);
  }
  buffer.edges();
  buffer.encode(false);
  buffer.encode(true);
  buffer.read([](const Tree& tree) { return frames_as_yaml(tree); });
  buffer.read([](const Tree& tree) { return frames_as_dot(tree, kSecond); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  const Exact table(input.part());
  const std::size_t rest = size - std::min(size, sizeof(std::uint32_t) + table.size());
  const auto samples = std::make_shared<const Exact>(std::span(data + (size - rest), rest));
  const char* reason = nullptr;
  const auto buffer =
      Buffer::restored(kKeepAll, {table.data(), table.size()}, {samples->data(), samples->size()}, samples, reason);
  expect(buffer || reason, "a rejected file has no reason");
  if (!buffer) return 0;
  look_up_some(*buffer);
  look_up_some(*buffer->snapshot());
  return 0;
}
