// SPDX-License-Identifier: Apache-2.0
#include "core/ros1.hpp"

#include <cstring>

#include "core/bytes.hpp"

namespace coframe {

namespace {

struct Stamped {
  std::uint32_t number, seconds, nanoseconds;  // of the message, of its stamp
};

bool read_head(ByteReader& reader, TransformView& view) {
  Stamped head;
  if (!reader.number(head)) return false;
  view.stamp = std::int64_t{head.seconds} * 1'000'000'000 + head.nanoseconds;
  return true;
}

bool is_expected(const ByteReader& reader, const ExpectedNames& names) {
  const std::size_t size = names.bytes.size();
  return size != 0 && reader.left() >= size && std::memcmp(reader.next(), names.bytes.data(), size) == 0;
}

bool read_names(ByteReader& reader, const ExpectedNames* expected, TransformView& view) {
  view.as_expected = expected && is_expected(reader, *expected);
  if (view.as_expected) {
    reader.skip(expected->bytes.size());
    return true;
  }
  const auto* first = reinterpret_cast<const char*>(reader.next());
  const std::size_t start = reader.position();
  if (!reader.text(view.parent) || !reader.text(view.child)) return false;
  if (view.parent.find('\0') != view.parent.npos || view.child.find('\0') != view.child.npos) return false;
  view.name_bytes = {first, reader.position() - start};
  return true;
}

}  // namespace

DecodeFailure decode_ros1_tf_message(const std::uint8_t* data, std::size_t size, std::vector<TransformView>& out,
                                     std::span<const ExpectedNames> expected) {
  ByteReader reader({data, size});
  const auto fail = [&](const char* reason) {
    out.clear();
    return DecodeFailure{reader.position(), reason};
  };
  std::uint32_t count;
  if (!reader.number(count)) return fail("the message is shorter than its count");
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i == out.size()) out.emplace_back();  // otherwise overwrites the one of an earlier message
    TransformView& view = out[i];
    if (!read_head(reader, view)) return fail("the message ends inside a header");
    if (!read_names(reader, i < expected.size() ? &expected[i] : nullptr, view)) {
      return fail("a text is longer than the message, or has a NUL inside");
    }
    if (!reader.number(view.values)) return fail("the message ends inside a transform");
  }
  if (reader.left() > 0) return fail("bytes are left over after the last transform");
  out.resize(count);
  return {};
}

}  // namespace coframe
