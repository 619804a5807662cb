// SPDX-License-Identifier: Apache-2.0
// The CDR bytes of a message while they are written: small values in one block, large arrays where they are.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

namespace coframe::bindings {

namespace nb = nanobind;

class Output {
 public:
  Output() : bytes_(memory()) { bytes_.assign(kLittleEndianHeader, kLittleEndianHeader + kHeaderSize); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;
  ~Output() {
    for (Array& array : arrays_) PyBuffer_Release(&array.view);
    if (bytes_.capacity() > kMaxKept) std::vector<char>().swap(bytes_);
  }

  void append(const void* data, std::size_t size) {
    const char* begin = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), begin, begin + size);
  }
  // Appends the memory of an array and releases it, now or at the end.
  void append(Py_buffer& view) {
    const auto size = static_cast<std::size_t>(view.len);
    if (size >= kLarge) {
      arrays_.push_back({bytes_.size(), view});
      in_arrays_ += size;
      return;
    }
    append(view.buf, size);
    PyBuffer_Release(&view);
  }
  void align(std::size_t size) {
    const std::size_t position = bytes_.size() + in_arrays_ - kHeaderSize;
    bytes_.resize(bytes_.size() + (-position & (size - 1)));
  }
  template <class Number>
  void put(Number number) {
    align(sizeof number);
    append(&number, sizeof number);
  }

  std::size_t size() const { return bytes_.size() + in_arrays_; }

  // Returns the message if it is in one part; otherwise nothing.
  std::span<const char> whole() const {
    return arrays_.empty() ? std::span<const char>(bytes_) : std::span<const char>();
  }

  // Calls `use(data, size)` for each part of the message, in order.
  template <class Use>
  void for_each_part(Use&& use) const {
    std::size_t used = 0;
    for (const Array& array : arrays_) {
      use(bytes_.data() + used, array.after - used);
      use(array.view.buf, static_cast<std::size_t>(array.view.len));
      used = array.after;
    }
    use(bytes_.data() + used, bytes_.size() - used);
  }

  nb::object bytes() const {
    nb::object result = nb::steal(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size())));
    if (!result.is_valid()) throw nb::python_error();
    char* end = PyBytes_AS_STRING(result.ptr());
    for_each_part([&end](const void* data, std::size_t length) {
      std::memcpy(end, data, length);
      end += length;
    });
    return result;
  }

 private:
  static constexpr std::size_t kHeaderSize = 4;
  static constexpr char kLittleEndianHeader[kHeaderSize] = {0, 1, 0, 0};
  // Memory of up to this size is kept for the next message of the thread.
  static constexpr std::size_t kMaxKept = 1 << 20;
  // Arrays of this size and more are copied only once, to where the message is needed.
  static constexpr std::size_t kLarge = 1 << 14;

  struct Array {
    std::size_t after;  // how many of the other bytes come before it
    Py_buffer view;
  };

  static std::vector<char>& memory() {
    thread_local std::vector<char> bytes;
    return bytes;
  }

  std::vector<char>& bytes_;  // all except the large arrays
  std::vector<Array> arrays_;
  std::size_t in_arrays_ = 0;
};

}  // namespace coframe::bindings
