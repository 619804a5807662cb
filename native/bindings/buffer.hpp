// SPDX-License-Identifier: Apache-2.0
// The Python object that contains a Buffer.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "core/buffer.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Returns the UTF-8 of a frame's name, valid as long as the object. Raises TypeError if it is not a str.
std::string_view text(nb::handle name);

// A cache of ids by the identity of the `str` object of the name: programs use the same literals again and again, and
// this avoids hashing. Guarded by the GIL; ids never change.
class IdentityCache {
 public:
  IdentityCache() = default;
  IdentityCache(const IdentityCache&) = delete;
  IdentityCache& operator=(const IdentityCache&) = delete;
  ~IdentityCache() {
    for (Entry& entry : entries_) Py_XDECREF(entry.name);
  }

  // Returns 0 if it is not cached.
  std::uint32_t known(PyObject* name) const {
    const Entry& entry = entries_[place(name)];
    return entry.name == name ? entry.number : 0;
  }
  // `find` returns the id of a name. 0 (no such name yet) is not cached.
  template <class Find>
  std::uint32_t find(PyObject* name, Find&& find) {
    Entry& entry = entries_[place(name)];
    return entry.name == name ? entry.number : remember(entry, name, find(text(name)));
  }

 private:
  struct Entry {
    PyObject* name = nullptr;
    std::uint32_t number = 0;
  };
  static constexpr std::size_t kEntries = 256;
  static std::size_t place(PyObject* name) { return (reinterpret_cast<std::uintptr_t>(name) >> 4) % kEntries; }
  static std::uint32_t remember(Entry& entry, PyObject* name, std::uint32_t number);

  std::array<Entry, kEntries> entries_{};
};

struct BufferObject {
  explicit BufferObject(Stamp cache_length) : core(std::make_shared<Buffer>(cache_length)) {}

  std::shared_ptr<Buffer> core;  // shared with DDS readers and failures
  // Returns 0 also for names with a leading slash: lookups reject them, insertions remove the slash.
  FrameId frame(PyObject* name) {
    return frames.find(name, [this](std::string_view text) { return text.starts_with('/') ? 0 : core->find(text); });
  }
  AuthorityId authority(PyObject* name) {
    return authorities.find(name, [this](std::string_view text) { return core->authority(text); });
  }

  using StreamKey = std::tuple<bool, TransformStream::Encoding, AuthorityId>;
  // Returns the message stream of this authority. Its renaming is set when the stream is first used.
  TransformStream& stream(bool is_static, AuthorityId authority,
                          TransformStream::Encoding encoding = TransformStream::Encoding::cdr,
                          const std::optional<Renaming>& renaming = {}) {
    const auto [found, is_new] = streams.try_emplace({is_static, encoding, authority});
    TransformStream& stream = found->second;
    if (is_new) {
      stream.is_static = is_static;
      stream.encoding = encoding;
      stream.authority = authority;
      if (renaming) stream.renaming = std::make_shared<const Renaming>(*renaming);
    }
    return stream;
  }

  IdentityCache frames, authorities;
  PathCache paths;  // guarded by the GIL, unlike the core's cache
  std::map<StreamKey, TransformStream> streams;
};

}  // namespace coframe::bindings
