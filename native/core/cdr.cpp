// SPDX-License-Identifier: Apache-2.0
#include "core/cdr.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

namespace coframe {

namespace {

static_assert(std::endian::native == std::endian::little, "the fast path copies little-endian bytes as they are");

constexpr std::size_t kHeader = 4;      // encapsulation header: 00, 01 (little endian) or 00 (big endian), options
constexpr std::size_t kMaxPadding = 3;  // some writers pad the last 4 bytes
constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;

// Reads primitives. Positions are relative to the end of the header, because CDR aligns relative to it.
class CdrReader {
 public:
  CdrReader(const std::uint8_t* body, std::size_t size, bool swap) : body_(body), size_(size), swap_(swap) {}

  std::size_t position() const { return position_; }
  std::size_t left() const { return size_ - position_; }
  const char* reason() const { return reason_; }

  template <class T>
  bool number(T& value) {
    return numbers(&value, 1);
  }

  template <class T>
  bool numbers(T* values, std::size_t count) {
    const std::size_t size = count * sizeof(T);
    if (!align(sizeof(T)) || left() < size) return fail("the message ends inside a number");
    std::memcpy(values, body_ + position_, size);
    if (swap_) {
      auto* bytes = reinterpret_cast<std::uint8_t*>(values);
      for (std::size_t i = 0; i < size; i += sizeof(T)) std::reverse(bytes + i, bytes + i + sizeof(T));
    }
    position_ += size;
    return true;
  }

  bool text(std::string_view& value) {
    std::uint32_t length;
    if (!number(length)) return false;
    if (length > left()) return fail("a string is longer than the message");
    const auto* first = reinterpret_cast<const char*>(body_ + position_);
    position_ += length;
    value = std::string_view(first, length);
    if (length == 0) return true;
    if (value.back() != '\0') return fail("a string does not end with NUL");
    value.remove_suffix(1);
    return value.find('\0') == std::string_view::npos || fail("a string has a NUL inside");
  }

  // Reads a whole transform with the expected names. Returns false, without reading, if other names follow.
  bool transform(const ExpectedNames& expected, TransformView& view) {
    const std::size_t names = expected.bytes.size();
    if (swap_ || names == 0 || left() < kStamp + names + sizeof view.values) return false;
    const std::uint8_t* next = body_ + position_;
    if (std::memcmp(next + kStamp, expected.bytes.data(), names) != 0) return false;
    view.stamp = stamp_at(next);
    std::memcpy(&view.values, next + kStamp + names, sizeof view.values);
    view.as_expected = true;
    position_ += kStamp + names + sizeof view.values;
    return true;
  }

  // Returns the bytes since `first` with the padding before the next number; empty for the other byte order.
  std::string_view bytes_since(std::size_t first) const {
    if (swap_) return {};
    const std::size_t end = (position_ + sizeof(double) - 1) & ~(sizeof(double) - 1);
    return {reinterpret_cast<const char*>(body_ + first), std::min(end, size_) - first};
  }

 private:
  static constexpr std::size_t kStamp = 8;

  static Stamp stamp_at(const std::uint8_t* bytes) {
    std::int32_t seconds;
    std::uint32_t nanoseconds;
    std::memcpy(&seconds, bytes, sizeof seconds);
    std::memcpy(&nanoseconds, bytes + sizeof seconds, sizeof nanoseconds);
    return seconds * kNanosecondsPerSecond + nanoseconds;
  }

  bool align(std::size_t width) {
    const std::size_t aligned_position = (position_ + width - 1) & ~(width - 1);
    if (aligned_position > size_) return false;
    position_ = aligned_position;
    return true;
  }

  bool fail(const char* reason) {
    reason_ = reason;
    return false;
  }

  const std::uint8_t* body_;
  std::size_t size_;
  std::size_t position_ = 0;
  bool swap_;
  const char* reason_ = nullptr;
};

bool read_transform(CdrReader& reader, TransformView& view) {
  std::int32_t seconds;
  std::uint32_t nanoseconds;
  if (!reader.number(seconds) || !reader.number(nanoseconds)) return false;
  view.stamp = seconds * kNanosecondsPerSecond + nanoseconds;
  const std::size_t names = reader.position();
  if (!reader.text(view.parent) || !reader.text(view.child)) return false;
  view.name_bytes = reader.bytes_since(names);
  view.as_expected = false;
  return reader.numbers(view.values.translation, 3) && reader.numbers(view.values.rotation, 4);
}

// `read` reads a transform by its index, or returns that it cannot.
template <class Read>
DecodeFailure read_message(const std::uint8_t* data, std::size_t size, std::uint32_t& count, Read&& read) {
  if (size < kHeader) return {size, "the message is shorter than its 4-byte header"};
  if (data[0] != 0 || data[1] > 1) return {0, "the header does not say plain CDR (00 01 or 00 00)"};
  CdrReader reader(data + kHeader, size - kHeader, data[1] == 0);
  bool complete = reader.number(count);
  for (std::uint32_t i = 0; complete && i < count; ++i) complete = read(reader, i);
  if (!complete) return {kHeader + reader.position(), reader.reason()};
  if (reader.left() > kMaxPadding) {
    return {kHeader + reader.position(), "bytes are left over after the last transform"};
  }
  return {};
}

class CdrWriter {
 public:
  CdrWriter() : bytes_({'\0', '\1', '\0', '\0'}) {}

  template <class T>
  void number(T value) {
    const std::size_t width = sizeof(T);
    bytes_.resize(kHeader + ((bytes_.size() - kHeader + width - 1) & ~(width - 1)), '\0');
    char raw[sizeof(T)];
    std::memcpy(raw, &value, width);
    bytes_.append(raw, width);
  }

  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size() + 1));
    bytes_.append(value);
    bytes_.push_back('\0');
  }

  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

}  // namespace

DecodeFailure decode_tf_message(const std::uint8_t* data, std::size_t size, std::vector<TransformView>& out,
                                std::span<const ExpectedNames> expected) {
  std::uint32_t count = 0;
  const DecodeFailure failure = read_message(data, size, count, [&](CdrReader& reader, std::uint32_t i) {
    if (i == out.size()) out.emplace_back();  // otherwise overwrites the one of an earlier message
    return (i < expected.size() && reader.transform(expected[i], out[i])) || read_transform(reader, out[i]);
  });
  out.resize(failure.reason ? 0 : count);
  return failure;
}

DecodeFailure check_tf_message(const std::uint8_t* data, std::size_t size) {
  std::uint32_t count;
  TransformView view;
  return read_message(data, size, count,
                      [&](CdrReader& reader, std::uint32_t) { return read_transform(reader, view); });
}

std::string encode_tf_message(const std::vector<TransformView>& transforms) {
  CdrWriter writer;
  writer.number(static_cast<std::uint32_t>(transforms.size()));
  for (const TransformView& view : transforms) {
    std::int64_t seconds = view.stamp / kNanosecondsPerSecond;
    std::int64_t nanoseconds = view.stamp % kNanosecondsPerSecond;
    if (nanoseconds < 0) {
      nanoseconds += kNanosecondsPerSecond;
      --seconds;
    }
    writer.number(static_cast<std::int32_t>(seconds));
    writer.number(static_cast<std::uint32_t>(nanoseconds));
    writer.text(view.parent);
    writer.text(view.child);
    for (double value : view.values.translation) writer.number(value);
    for (double value : view.values.rotation) writer.number(value);
  }
  return writer.take();
}

// Well-formed UTF-8 as in table 3-7 of the Unicode standard: no overlong forms, no surrogates.
bool is_utf8(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  for (std::size_t i = 0; i < text.size();) {
    const unsigned char lead = byte(i);
    std::size_t length = 1;
    unsigned char low = 0x80, high = 0xBF;  // bounds of the second byte
    if (lead < 0x80) {
      ++i;
      continue;
    } else if (lead >= 0xC2 && lead <= 0xDF) {
      length = 2;
    } else if (lead >= 0xE0 && lead <= 0xEF) {
      length = 3;
      if (lead == 0xE0) low = 0xA0;
      if (lead == 0xED) high = 0x9F;
    } else if (lead >= 0xF0 && lead <= 0xF4) {
      length = 4;
      if (lead == 0xF0) low = 0x90;
      if (lead == 0xF4) high = 0x8F;
    } else {
      return false;
    }
    if (text.size() - i < length || byte(i + 1) < low || byte(i + 1) > high) return false;
    for (std::size_t k = 2; k < length; ++k) {
      if ((byte(i + k) & 0xC0) != 0x80) return false;
    }
    i += length;
  }
  return true;
}

}  // namespace coframe
