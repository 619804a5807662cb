// SPDX-License-Identifier: Apache-2.0
// Frozen buffers as files, and the samples of a buffer as arrays.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "core/frozen.hpp"
#include "core/guarded_memory.hpp"

namespace coframe::bindings {

namespace {

const Buffer& frozen_core(nb::handle buffer) {
  const Buffer& core = *buffer_of(buffer).core;
  if (!core.frozen()) throw nb::value_error("the buffer must be frozen: take a snapshot() of it");
  return core;
}

// Returns (table, number of chunks).
nb::tuple frozen_parts(nb::handle buffer) {
  return frozen_core(buffer).read([](const Tree& tree) {
    const std::string table = frozen_table(tree);
    return nb::make_tuple(nb::bytes(table.data(), table.size()), frozen_chunk_count(tree));
  });
}

nb::bytes chunks(nb::handle buffer, std::uint64_t first, std::uint64_t count) {
  const std::string bytes =
      frozen_core(buffer).read([&](const Tree& tree) { return frozen_chunks(tree, first, count); });
  return nb::bytes(bytes.data(), bytes.size());
}

// A mapped file, as a Python object that owns it.
class MemoryGuard {
 public:
  MemoryGuard(nb::handle memory, const std::string& loss)
      : memory_(memory, PyBUF_SIMPLE), guard_(memory_.data<void>(), memory_.size(), {LostMemory::Kind::frozen, loss}) {}

  std::span<const std::uint8_t> bytes() const { return {memory_.data<const std::uint8_t>(), memory_.size()}; }
  GuardedMemory* guard() { return &guard_; }

 private:
  const Memory memory_;
  GuardedMemory guard_;
};

// Kept as long as a core uses it; it may be released in any thread.
std::shared_ptr<GuardedMemory> held(nb::handle file) {
  file.inc_ref();
  return {nb::cast<MemoryGuard&>(file).guard(), [file](GuardedMemory*) {
            if (!Py_IsInitialized()) return;  // the process ends and releases its memory
            const CallingPython calling;
            const nb::gil_scoped_acquire acquire;
            file.dec_ref();
          }};
}

// Returns what is wrong with the bytes; empty if the buffer was restored from them.
std::string become_frozen(nb::handle object, nb::handle file, std::uint64_t table, std::uint64_t table_size,
                          std::uint64_t samples, std::uint64_t samples_size) {
  BufferObject& self = buffer_of(object);
  const std::span bytes = nb::cast<MemoryGuard&>(file).bytes();
  const std::uint64_t size = bytes.size();
  if (table > size || table_size > size - table || samples > size || samples_size > size - samples) {
    return "it is cut off";
  }
  const char* reason;
  auto core = Buffer::restored(self.core->cache_length(), bytes.subspan(table, table_size),
                               bytes.subspan(samples, samples_size), held(file), reason);
  if (reason) return reason;
  self.core = std::move(core);
  return "";
}

// Returns (stamps, poses, index of the parent's name, names).
nb::tuple samples_of(nb::handle buffer, std::string_view child) {
  const Buffer& core = frozen_core(buffer);
  return core.read([&](const Tree& tree) {
    const History::View history = tree.history(tree.find(child));
    const std::size_t count = history.size();
    std::vector<Stamp> stamps(count);
    std::vector<double> poses(7 * count);
    std::vector<std::uint32_t> parents(count);
    std::unordered_map<FrameId, std::uint32_t> numbers;
    nb::list names;
    for (std::size_t i = 0; i < count; ++i) {
      const Sample sample = history.sample(i);
      stamps[i] = history.is_static() ? 0 : history.time(i);
      std::copy_n(sample.pose.p, 3, &poses[7 * i]);
      std::copy_n(sample.pose.q, 4, &poses[7 * i + 3]);
      const auto [place, is_new] = numbers.try_emplace(sample.parent, static_cast<std::uint32_t>(numbers.size()));
      if (is_new) names.append(tree.name(sample.parent));
      parents[i] = place->second;
    }
    return nb::make_tuple(array_bytes(stamps), array_bytes(poses), array_bytes(parents), names);
  });
}

}  // namespace

void define_frozen(nb::module_& module) {
  using nb::arg;
  nb::class_<MemoryGuard>(
      module, "MemoryGuard",
      "Lets reads of a mapped file fail that another program truncates, which would end this process.")
      .def(nb::init<nb::handle, const std::string&>(), arg("memory"), arg("loss"))
      .def("check", [](MemoryGuard& self) { self.guard()->check(); }, "Raise the error if the memory is lost.");
  module.def("frozen_parts", &frozen_parts, arg("buffer"),
             "Return the table of a frozen buffer for a file, and its number of sample chunks.");
  module.def("frozen_chunks", &chunks, arg("buffer"), arg("first"), arg("count"),
             "Return the bytes of some of these chunks.");
  module.def("become_frozen", &become_frozen, arg("buffer"), arg("file"), arg("table"), arg("table_size"),
             arg("samples"), arg("samples_size"),
             "Restore a new buffer from a file's bytes, used in place; return what is wrong with them, or "
             ".");
  module.def("samples_of", &samples_of, arg("buffer"), arg("child"),
             "Return the samples of one frame of a frozen buffer: stamps, poses, indices of parent names, names.");
}

}  // namespace coframe::bindings
