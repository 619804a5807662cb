// The Python object around a Buffer.
#pragma once

#include <nanobind/nanobind.h>

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/buffer.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Frame numbers by the identity of the `str` object: programs ask with the same literals again and again, and this
// spares the hash. Guarded by the GIL; a frame's number never changes.
class NameCache {
 public:
  NameCache() = default;
  NameCache(const NameCache&) = delete;
  NameCache& operator=(const NameCache&) = delete;
  ~NameCache() {
    for (Entry& entry : entries_) Py_XDECREF(entry.name);
  }

  FrameId find(PyObject* name, const Buffer& buffer);

 private:
  struct Entry {
    PyObject* name = nullptr;
    FrameId frame = 0;
  };
  std::array<Entry, 256> entries_{};
};

struct BufferObject {
  explicit BufferObject(Stamp cache_length) : core(std::make_shared<Buffer>(cache_length)) {}

  std::shared_ptr<Buffer> core;  // shared with the wire's readers and with failures
  NameCache names;
  std::map<std::pair<bool, std::string>, TransformStream> streams;  // of ingest()
};

}  // namespace coframe::bindings
