// SPDX-License-Identifier: Apache-2.0
// What the fuzz targets of the native core have in common: parts of an input, and checks that end the process.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <span>

namespace coframe::fuzz {

inline void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "Failed: %s\n", what);
  std::abort();
}

// A copy of the exact size, so that the sanitizer detects every access beyond its end.
class Exact {
 public:
  explicit Exact(std::span<const std::uint8_t> bytes)
      : data_(static_cast<std::uint8_t*>(::operator new(std::max<std::size_t>(bytes.size(), 1), kAlignment))),
        size_(bytes.size()) {
    std::copy(bytes.begin(), bytes.end(), data_);
  }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  ~Exact() { ::operator delete(data_, kAlignment); }

  const std::uint8_t* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::align_val_t kAlignment{64};  // that of chunks of samples
  std::uint8_t* data_;
  std::size_t size_;
};

// An input is divided into a few small numbers and into parts that are preceded by their length.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : left_(data, size) {}

  bool is_empty() const { return left_.empty(); }
  std::uint8_t byte() { return number<std::uint8_t>(); }

  template <class T>
  T number() {
    T value{};
    const std::size_t count = std::min(sizeof value, left_.size());
    std::memcpy(&value, left_.data(), count);
    left_ = left_.subspan(count);
    return value;
  }

  // The bytes of a part. A length beyond the end means the rest.
  std::span<const std::uint8_t> part() {
    const std::size_t count = std::min<std::size_t>(number<std::uint32_t>(), left_.size());
    const auto found = left_.first(count);
    left_ = left_.subspan(count);
    return found;
  }

 private:
  std::span<const std::uint8_t> left_;
};

}  // namespace coframe::fuzz
