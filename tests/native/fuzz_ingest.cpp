// SPDX-License-Identifier: Apache-2.0
// Serialized TFMessages, most of them malformed, are ingested by a buffer and by relays under a sanitizer.
// Deterministic.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/buffer.hpp"
#include "core/dump.hpp"
#include "core/relay.hpp"

namespace {

using namespace coframe;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kHeader = 4;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "Failed: %s\n", what);
  std::_Exit(1);
}

enum class Kind { cdr_little, cdr_big, ros1 };

// A message in CDR, in either byte order, or in the format of ROS 1. Written from the standards, not from the code
// under test.
class Message {
 public:
  explicit Message(Kind kind) : kind_(kind) {
    if (kind != Kind::ros1) bytes_ = {0, static_cast<std::uint8_t>(kind == Kind::cdr_big ? 0 : 1), 0, 0};
  }

  template <class T>
  void number(T value) {
    while (kind_ != Kind::ros1 && (bytes_.size() - kHeader) % sizeof(T) != 0) bytes_.push_back(0);
    std::array<std::uint8_t, sizeof(T)> raw;
    std::memcpy(raw.data(), &value, sizeof(T));
    if (kind_ == Kind::cdr_big) std::reverse(raw.begin(), raw.end());
    bytes_.insert(bytes_.end(), raw.begin(), raw.end());
  }

  void text(std::string_view value) {
    const bool ends_with_nul = kind_ != Kind::ros1;
    number(static_cast<std::uint32_t>(value.size() + ends_with_nul));
    bytes_.insert(bytes_.end(), value.begin(), value.end());
    if (ends_with_nul) bytes_.push_back(0);
  }

  Bytes take() { return std::move(bytes_); }

 private:
  Kind kind_;
  Bytes bytes_;
};

class Fuzzer {
 public:
  Fuzzer() : rng_(20) {
    const auto renaming = std::make_shared<const Renaming>("frame1", std::vector<std::string>{"frame2"});
    for (int i = 0; i < 8; ++i) {
      streams_.push_back(buffer_.open_stream(i % 2 == 0, "fuzzer", i % 4 < 2 ? nullptr : renaming));
      if (i >= kCdrStreams) streams_.back().encoding = TransformStream::Encoding::ros1;
    }
    for (Relay& relay : relays_) {
      relay.add_source(*renaming, Relay::Direction::merge);
      relay.add_source(*renaming, Relay::Direction::split);
    }
  }

  void run(int messages) {
    for (int i = 0; i < messages; ++i) {
      std::size_t transforms = 0;
      const Kind kind = static_cast<Kind>(rng_() % 3);
      Bytes bytes = message(kind, transforms);
      const bool damaged = rng_() % 4 != 0;
      for (unsigned n = damaged ? 1 + rng_() % 4 : 0; n > 0; --n) damage(bytes);
      ingest(kind, bytes, transforms, damaged);
      relay(bytes);
      if (i % 16 == 0) look_up_some();
      if (i % 5000 == 0) buffer_.clear();
    }
    const Counts counts = buffer_.counts();
    expect(counts.messages == static_cast<std::uint64_t>(messages), "some messages were not counted");
    std::printf("%d messages, %llu malformed; %llu transforms stored, %llu refused, %llu old; %zu frames\n", messages,
                static_cast<unsigned long long>(counts.malformed), static_cast<unsigned long long>(counts.stored),
                static_cast<unsigned long long>(counts.refused), static_cast<unsigned long long>(counts.old),
                buffer_.frame_names().size());
    expect(counts.malformed > 0 && counts.stored > 0 && counts.refused > 0 && counts.old > 0,
           "the messages do not cover all outcomes");
  }

 private:
  static constexpr int kCdrStreams = 4;

  template <class T, std::size_t size>
  const T& one_of(const std::array<T, size>& values) {
    return values[rng_() % size];
  }

  std::string name() {
    static const std::array<std::string, 8> edge_cases{"",      "/",         "//",  "/a",
                                                       "größe", "NO_PARENT", "a b", std::string(300, 'x')};
    return rng_() % 8 == 0 ? one_of(edge_cases) : "frame" + std::to_string(rng_() % 20);
  }

  double value() {
    static const std::array<double, 8> edge_cases{0.0, -0.0, 1e308, -1e308, 1e-308, NAN, INFINITY, -INFINITY};
    return rng_() % 50 == 0 ? one_of(edge_cases) : std::uniform_real_distribution<double>(-10, 10)(rng_);
  }

  Bytes message(Kind kind, std::size_t& transforms) {
    static const std::array<std::int32_t, 4> edge_seconds{0, -1, 0x7fffffff, -0x7fffffff - 1};
    Message made(kind);
    transforms = rng_() % 3 == 0 ? 0 : rng_() % 20;
    made.number(static_cast<std::uint32_t>(transforms));
    for (std::size_t i = 0; i < transforms; ++i) {
      if (kind == Kind::ros1) made.number(static_cast<std::uint32_t>(rng_()));  // the sequence number of the header
      made.number(rng_() % 200 == 0 ? one_of(edge_seconds) : static_cast<std::int32_t>(1000 + rng_() % 20));
      made.number(static_cast<std::uint32_t>(rng_() % 100 == 0 ? rng_() : rng_() % 1'000'000'000));
      made.text(name());
      made.text(name());
      for (int k = 0; k < 7; ++k) made.number(value());
    }
    return made.take();
  }

  void damage(Bytes& bytes) {
    static const std::array<std::uint32_t, 8> lengths{0, 1, 2, 0xff, 0xffff, 0x7fffffff, 0xfffffff0, 0xffffffff};
    const std::size_t size = bytes.size(), at = size == 0 ? 0 : rng_() % size;
    switch (size == 0 ? 1 : rng_() % 8) {
      case 0: bytes.resize(at); break;
      case 1: bytes.insert(bytes.end(), 1 + rng_() % 16, static_cast<std::uint8_t>(rng_())); break;
      case 2: bytes[at] = static_cast<std::uint8_t>(rng_()); break;
      case 3: bytes[at] ^= static_cast<std::uint8_t>(1u << rng_() % 8); break;
      case 4: bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at)); break;
      case 5: bytes[std::min(at, kHeader - 1)] ^= static_cast<std::uint8_t>(rng_() % 3); break;
      case 6: {  // a number similar to the length of a string or of the sequence
        const std::size_t aligned = at / 4 * 4;
        const auto nearly = static_cast<std::uint32_t>(rng_() % (2 * size));
        const std::uint32_t length = rng_() % 2 == 0 ? one_of(lengths) : nearly;
        if (aligned + sizeof length <= size) std::memcpy(&bytes[aligned], &length, sizeof length);
        break;
      }
      default: {  // a copy of a part in another place
        const std::size_t from = rng_() % size, count = std::min(size - std::max(at, from), std::size_t{64});
        std::memmove(&bytes[at], &bytes[from], count);
      }
    }
  }

  void ingest(Kind kind, const Bytes& bytes, std::size_t transforms, bool damaged) {
    // The exact size, so that the sanitizer detects every access beyond the end.
    const std::unique_ptr<std::uint8_t[]> exact(new std::uint8_t[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), exact.get());
    const Counts before = buffer_.counts();
    std::size_t stored = 0;
    TransformStream& stream = streams_[rng_() % kCdrStreams + (kind == Kind::ros1 ? kCdrStreams : 0)];
    const DecodeFailure failure = buffer_.ingest(stream, exact.get(), bytes.size(), stored);
    const Counts after = buffer_.counts();
    expect(after.stored - before.stored == stored, "the result differs from the count of stored transforms");
    expect(damaged || (!failure.reason && stored <= transforms), "a valid message is rejected");
    if (failure.reason) {
      expect(stored == 0 && failure.offset <= bytes.size(), "a rejected message changed the buffer");
      expect(after.refused == before.refused && after.old == before.old,
             "transforms of a rejected message are counted");
    } else {
      const std::uint64_t counted =
          after.stored + after.refused + after.old - before.stored - before.refused - before.old;
      expect(damaged || counted == transforms, "some transforms were not counted");
    }
  }

  void relay(const Bytes& bytes) {
    const std::unique_ptr<std::uint8_t[]> exact(new std::uint8_t[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), exact.get());
    Relay& relay = relays_[rng_() % relays_.size()];
    now_ += static_cast<std::int64_t>(rng_() % 10'000'000);
    relay.add(rng_() % 2, rng_() % 1500, exact.get(), bytes.size(), now_, now_);
    if (rng_() % 2 == 0) return;
    const std::string relayed = relay.take(now_);
    if (relayed.empty()) return;
    std::vector<TransformView> views;
    const auto* data = reinterpret_cast<const std::uint8_t*>(relayed.data());
    expect(!decode_tf_message(data, relayed.size(), views).reason, "a message of the relay is malformed");
    for (const TransformView& view : views) {
      expect(check_names(view.parent, view.child) == 0 && check_values(view.values) == 0 && is_utf8(view.child),
             "the relay forwards a transform that a buffer rejects");
    }
  }

  void look_up_some() {
    const std::vector<std::string> names = buffer_.frame_names();
    if (names.empty()) return;
    const FrameId target = buffer_.find(names[rng_() % names.size()]), source = buffer_.find(names.back());
    Stamp stamp = rng_() % 2 == 0 ? 0 : static_cast<Stamp>(1000 + rng_() % 20) * 1'000'000'000;
    Pose pose;
    Failure failure;
    if (target != 0 && source != 0 && !buffer_.lookup_by_id(target, source, stamp, pose, failure)) {
      expect(!buffer_.read([&](const Tree& tree) { return lookup_text(failure, tree); }).empty(),
             "a failure has no text");
    }
    for (const bool is_static : {false, true}) {
      const std::string bytes = buffer_.encode(is_static);
      std::vector<TransformView> views;
      const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
      expect(!decode_tf_message(data, bytes.size(), views).reason, "a message of the buffer is malformed");
    }
  }

  std::mt19937 rng_;
  Buffer buffer_{10'000'000'000};
  std::vector<TransformStream> streams_;
  std::array<Relay, 4> relays_{Relay(false, 0), Relay(false, 50'000'000), Relay(true, 0),
                               Relay(false, 100'000'000, MaxError{0.01, 0.01})};
  std::int64_t now_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Fuzzer().run(argc > 1 ? std::atoi(argv[1]) : 200'000);
  return 0;
}
