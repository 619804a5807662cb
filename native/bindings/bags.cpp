// SPDX-License-Identifier: Apache-2.0
// Recordings: functions that process many messages in one call.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string_view.h>

#include <string>
#include <unordered_map>
#include <vector>

#include "bags/mcap_records.hpp"
#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "core/cdr.hpp"
#include "core/ros1.hpp"

namespace coframe::bindings {

namespace {

nb::tuple mcap_records(nb::handle data) {
  const Memory bytes(data, PyBUF_SIMPLE);
  McapRecords found;
  {
    const WithoutGil release;
    found = find_mcap_records(bytes.data<const std::uint8_t>(), bytes.size());
  }
  nb::list definitions;
  for (const auto& [opcode, start, end] : found.definitions) definitions.append(nb::make_tuple(opcode, start, end));
  return nb::make_tuple(array_bytes(found.channels), array_bytes(found.times), array_bytes(found.records),
                        array_bytes(found.starts), array_bytes(found.ends), definitions, found.size);
}

TransformStream::Encoding encoding_of(std::string_view name) {
  if (name == "cdr") return TransformStream::Encoding::cdr;
  if (name == "ros1") return TransformStream::Encoding::ros1;
  throw nb::value_error("encoding must be \"cdr\" or \"ros1\"");
}

// Returns how many of the slices were malformed, and what is wrong with the first.
nb::tuple ingest_slices(nb::handle buffer, nb::handle data, nb::handle starts, nb::handle ends, bool is_static,
                        nb::handle authority, std::string_view encoding, const std::optional<Renaming>& renaming) {
  BufferObject& self = buffer_of(buffer);
  const Memory bytes(data, PyBUF_SIMPLE), first(starts, PyBUF_SIMPLE), last(ends, PyBUF_SIMPLE);
  const std::size_t count = first.size() / sizeof(std::uint64_t);
  if (first.size() != last.size()) throw nb::value_error("as many ends as starts are wanted");
  self.stop_sharing();
  const AuthorityId authority_id = self.authority(authority.ptr());
  const nb::ft_lock_guard lock(self.ingesting);
  TransformStream& stream = self.stream(is_static, authority_id, encoding_of(encoding), renaming);
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

// The transforms of many messages as columns, one row each. Names are numbered in order of appearance.
class TransformColumns {
 public:
  explicit TransformColumns(bool is_ros1) : is_ros1_(is_ros1) {}

  void add(const std::uint8_t* data, std::size_t size, std::uint32_t message) {
    const DecodeFailure failure =
        is_ros1_ ? decode_ros1_tf_message(data, size, views_) : decode_tf_message(data, size, views_);
    if (failure.reason) {
      if (damaged_++ == 0) reason_ = failure.reason;
      return;
    }
    for (const TransformView& view : views_) {
      messages_.push_back(message);
      stamps_.push_back(view.stamp);
      parents_.push_back(number(view.parent));
      children_.push_back(number(view.child));
      values_.insert(values_.end(), std::begin(view.values.translation), std::end(view.values.translation));
      values_.insert(values_.end(), std::begin(view.values.rotation), std::end(view.values.rotation));
    }
  }

  nb::tuple take() const {
    nb::list names;
    for (const std::string& name : names_) {
      names.append(nb::steal<nb::str>(
          PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "backslashreplace")));
    }
    return nb::make_tuple(array_bytes(messages_), array_bytes(stamps_), array_bytes(parents_), array_bytes(children_),
                          array_bytes(values_), names, damaged_, nb::str(reason_));
  }

 private:
  std::uint32_t number(std::string_view name) {
    const auto [found, is_new] = numbers_.try_emplace(std::string(name), static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.emplace_back(name);
    return found->second;
  }

  const bool is_ros1_;
  std::vector<TransformView> views_;
  std::vector<std::uint32_t> messages_, parents_, children_;
  std::vector<Stamp> stamps_;
  std::vector<double> values_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::vector<std::string> names_;
  std::size_t damaged_ = 0;
  const char* reason_ = "";
};

nb::tuple transform_columns(nb::handle data, nb::handle starts, nb::handle ends, std::string_view encoding) {
  const Memory bytes(data, PyBUF_SIMPLE), first(starts, PyBUF_SIMPLE), last(ends, PyBUF_SIMPLE);
  const std::size_t count = first.size() / sizeof(std::uint64_t);
  if (first.size() != last.size()) throw nb::value_error("as many ends as starts are wanted");
  TransformColumns columns(encoding == "ros1");
  {
    const WithoutGil release;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint64_t start = first.data<const std::uint64_t>()[i], end = last.data<const std::uint64_t>()[i];
      if (start > end || end > bytes.size()) throw std::invalid_argument("a slice is not inside the data");
      columns.add(bytes.data<const std::uint8_t>() + start, end - start, static_cast<std::uint32_t>(i));
    }
  }
  return columns.take();
}

}  // namespace

void define_bags(nb::module_& module) {
  using nb::arg;
  module.def("mcap_records", &mcap_records, arg("data"),
             "Return the positions of the messages in MCAP records: channels (uint16), times, records, starts and ends "
             "(uint64) "
             "as bytes, definitions as (opcode, start, end), and how many bytes are whole records.");
  module.def("ingest_slices", &ingest_slices, arg("buffer"), arg("data"), arg("starts"), arg("ends"), arg("static"),
             arg("authority"), arg("encoding") = "cdr", arg("renaming") = nb::none(),
             "Ingest many slices of `data`; return how many are malformed, and why the first is.");
  module.def("transform_columns", &transform_columns, arg("data"), arg("starts"), arg("ends"), arg("encoding") = "cdr",
             "Return the transforms of many TFMessages as columns.");
}

}  // namespace coframe::bindings
