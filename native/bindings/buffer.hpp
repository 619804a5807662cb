// SPDX-License-Identifier: Apache-2.0
// The Python object that contains a Buffer.
#pragma once

#include <nanobind/nanobind.h>

#include <map>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "bindings/call_paths.hpp"
#include "bindings/identity_cache.hpp"
#include "core/buffer.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Returns the UTF-8 of a frame's name, valid as long as the object. Raises TypeError if it is not a str.
std::string_view text(nb::handle name);

struct BufferObject {
  explicit BufferObject(Stamp cache_length, bool along_screws = false) : core(std::make_shared<Buffer>(cache_length)) {
    core->set_along_screws(along_screws);
  }

  std::shared_ptr<Buffer> core;  // shared with DDS readers and failures
  // Returns 0 also for names with a leading slash: lookups reject them, insertions remove the slash.
  FrameId frame(PyObject* name) {
    return frames.find(name, [this](PyObject* object) {
      const std::string_view given = text(object);
      return given.starts_with('/') ? 0 : core->find(given);
    });
  }
  AuthorityId authority(PyObject* name) {
    return authorities.find(name, [this](PyObject* object) { return core->authority(text(object)); });
  }

  bool lookup_cached_path(FrameId target, FrameId source, Stamp& stamp, Pose& pose) {
    return paths.with([&](PathCache& cache) { return core->lookup_cached_path(cache, target, source, stamp, pose); });
  }
  bool check_cached_path(FrameId target, FrameId source, Stamp stamp) {
    return paths.with([&](PathCache& cache) { return core->check_cached_path(cache, target, source, stamp); });
  }

  // Calls `insert`, which returns the refusals. A buffer that reads shared transforms first becomes a private one.
  template <class Insert>
  unsigned insert(Insert&& insert) {
    const unsigned refusals = insert();
    if (!(refusals & kShared)) return refusals;
    stop_sharing();
    return insert();
  }
  // Before every other change: a buffer that reads shared transforms becomes a private one.
  void stop_sharing() {
    if (!core->following()) return;
    core->check_memory();
    if (on_local_change.is_valid() && !on_local_change.is_none()) on_local_change();
    core->stop_following();
  }

  using StreamKey = std::tuple<bool, TransformStream::Encoding, AuthorityId>;
  // Returns the message stream of this authority, to be used while `ingesting` is locked. Its renaming is set when the
  // stream is first used.
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

  nb::object on_local_change;  // called before a buffer stops to read shared transforms; None: nothing
  IdentityCache<FrameId, 256> frames;
  IdentityCache<AuthorityId, 256> authorities;
  CallPaths paths;
  std::map<StreamKey, TransformStream> streams;
  nb::ft_mutex ingesting;  // guards `streams` where there is no GIL
};

}  // namespace coframe::bindings
