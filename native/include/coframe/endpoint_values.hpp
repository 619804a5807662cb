// SPDX-License-Identifier: Apache-2.0
// The Python values of endpoints, as the core and the modules of other middlewares return them.
#pragma once

#include <nanobind/nanobind.h>

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace coframe::values {

namespace nb = nanobind;

// The names come from the network and need not be valid UTF-8.
inline nb::str to_text(const std::string& name) {
  return nb::steal<nb::str>(
      PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "backslashreplace"));
}

template <class Number>
nb::bytes array_bytes(const std::vector<Number>& numbers) {
  return nb::bytes(numbers.data(), numbers.size() * sizeof(Number));
}

// Large messages are copied without the GIL: a cloud of a million points takes milliseconds.
template <class WithoutGil>
nb::bytes message_bytes(const void* data, std::size_t size) {
  constexpr std::size_t kMuch = 1 << 16;
  if (size < kMuch) return nb::bytes(data, size);
  auto copy = nb::steal<nb::bytes>(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
  if (!copy.is_valid()) throw nb::python_error();
  char* memory = PyBytes_AS_STRING(copy.ptr());
  WithoutGil release;
  std::memcpy(memory, data, size);
  return copy;
}

template <class Qos>
nb::tuple qos_tuple(const Qos& qos) {
  return nb::make_tuple(qos.depth, qos.reliable, qos.transient_local, qos.keep_all, qos.manual_liveliness,
                        qos.deadline_ns, qos.lifespan_ns, qos.lease_ns);
}

// Returns the counts of a status that has changed since the last call, otherwise None.
template <class Events>
nb::object take_status(Events& events, std::size_t kind) {
  if (kind >= Events::kKinds) throw nb::value_error("unknown kind of status");
  const auto counts = events.take(static_cast<typename Events::Kind>(kind));
  if (!counts) return nb::none();
  return nb::make_tuple((*counts)[0], (*counts)[1], (*counts)[2], (*counts)[3]);
}

// Returns the changes that `changes.take()` returns without the GIL.
template <class WithoutGil, class Changes>
nb::list take_changes(Changes& source) {
  const auto changes = [&source] {
    WithoutGil release;
    return source.take();
  }();
  nb::list list;
  for (const auto& change : changes) {
    nb::list partitions;
    for (const std::string& partition : change.qos.partitions) partitions.append(to_text(partition));
    list.append(nb::make_tuple(change.handle, change.alive, nb::bytes(&change.guid, sizeof change.guid),
                               nb::bytes(&change.participant, sizeof change.participant), to_text(change.topic),
                               to_text(change.type), qos_tuple(change.qos),
                               nb::bytes(change.user_data.data(), change.user_data.size()), nb::tuple(partitions)));
  }
  return list;
}

}  // namespace coframe::values
