// Recordings: many messages in one call.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string_view.h>

#include <vector>

#include "bags/mcap_records.hpp"
#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

template <class T>
nb::bytes bytes_of(const std::vector<T>& values) {
  return nb::bytes(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

nb::tuple mcap_records(nb::handle data) {
  const Memory bytes(data, PyBUF_SIMPLE);
  McapRecords found;
  {
    const WithoutGil release;
    found = find_mcap_records(bytes.data<const std::uint8_t>(), bytes.size());
  }
  nb::list definitions;
  for (const auto& [opcode, start, end] : found.definitions) definitions.append(nb::make_tuple(opcode, start, end));
  return nb::make_tuple(bytes_of(found.channels), bytes_of(found.times), bytes_of(found.records),
                        bytes_of(found.starts), bytes_of(found.ends), definitions, found.size);
}

TransformStream::Encoding encoding_of(std::string_view name) {
  if (name == "cdr") return TransformStream::Encoding::cdr;
  if (name == "ros1") return TransformStream::Encoding::ros1;
  throw nb::value_error("encoding must be \"cdr\" or \"ros1\"");
}

// How many of the slices were damaged, and what is wrong with the first of these.
nb::tuple ingest_slices(nb::handle buffer, nb::handle data, nb::handle starts, nb::handle ends, bool is_static,
                        nb::handle authority, const std::optional<Renaming>& renaming, std::string_view encoding) {
  BufferObject& self = buffer_of(buffer);
  const Memory bytes(data, PyBUF_SIMPLE), first(starts, PyBUF_SIMPLE), last(ends, PyBUF_SIMPLE);
  const std::size_t count = first.size() / sizeof(std::uint64_t);
  if (first.size() != last.size()) throw nb::value_error("as many ends as starts are wanted");
  TransformStream& stream = self.stream(is_static, self.authority(authority.ptr()), renaming, encoding_of(encoding));
  std::size_t damaged = 0;
  const char* reason = "";
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t start = first.data<const std::uint64_t>()[i], end = last.data<const std::uint64_t>()[i];
    if (start > end || end > bytes.size()) throw nb::value_error("a slice is not inside the data");
    std::size_t stored;
    const DecodeFailure failure =
        self.core->ingest(stream, bytes.data<const std::uint8_t>() + start, end - start, stored);
    if (failure.reason && damaged++ == 0) reason = failure.reason;
  }
  return nb::make_tuple(damaged, reason);
}

}  // namespace

void define_bags(nb::module_& module) {
  using nb::arg;
  module.def("mcap_records", &mcap_records, arg("data"),
             "Where the messages lie among records of MCAP: channels (uint16), times, records, starts and ends (uint64) "
             "as bytes, definitions as (opcode, start, end), and how many bytes are whole records.");
  module.def("ingest_slices", &ingest_slices, arg("buffer"), arg("data"), arg("starts"), arg("ends"), arg("static"),
             arg("authority"), arg("renaming") = nb::none(), arg("encoding") = "cdr",
             "Buffer.ingest() of many parts of `data`, which uint64 arrays tell: how many are damaged, and why the first.");
}

}  // namespace coframe::bindings
