// SPDX-License-Identifier: Apache-2.0
// Renaming of frames, and relays of their messages.
#include "core/relay.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <chrono>

#include "bindings/bindings.hpp"
#include "bindings/relay.hpp"
#include "core/renaming.hpp"

namespace coframe::bindings {

namespace {

template <class Clock>
std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

// Names that Relay writes are UTF-8, but examples of names may be cut anywhere.
nb::str to_str(const std::string& name) {
  return nb::steal<nb::str>(
      PyUnicode_DecodeUTF8(name.data(), static_cast<Py_ssize_t>(name.size()), "backslashreplace"));
}

void add(Relay& self, Relay::SourceId source, Relay::WriterId writer, nb::bytes message, std::int64_t at) {
  if (source >= self.sources()) throw nb::index_error("no source with this number");
  const std::int64_t steady_time = at < 0 ? now<std::chrono::steady_clock>() : at;
  self.add(source, writer, reinterpret_cast<const std::uint8_t*>(message.c_str()), message.size(), steady_time,
           now<std::chrono::system_clock>());
}

void create(Relay* self, bool is_static, std::int64_t period, std::optional<std::pair<double, double>> max_error) {
  if (!max_error) {
    new (self) Relay(is_static, period);
    return;
  }
  const MaxError error{max_error->first, max_error->second};
  if (!(error.distance >= 0.0) || !(error.angle >= 0.0 && error.angle <= MaxError::kMaxAngle)) {
    throw nb::value_error("the maximum error must not be negative, and its angle at most 45 degrees");
  }
  new (self) Relay(is_static, period, error);
}

nb::object take_relayed(Relay& self, std::int64_t at) {
  const std::string message = self.take(at < 0 ? now<std::chrono::steady_clock>() : at);
  return message.empty() ? nb::object(nb::none()) : nb::object(nb::bytes(message.data(), message.size()));
}

nb::list edges(const Relay& self) {
  nb::list list;
  for (const Relay::Edge& edge : self.edges()) {
    const Relay::Claim& claim = self.claim(edge);
    if (edge.passed == 0 && claim.rival == Relay::kNoSource) continue;
    const bool contested = claim.rival != Relay::kNoSource;
    list.append(nb::make_tuple(to_str(edge.parent), to_str(claim.child), claim.source, edge.writer,
                               contested ? nb::int_(claim.rival) : nb::object(nb::none()), claim.contested, edge.passed,
                               edge.thinned, edge.newest, edge.received_at));
  }
  return list;
}

nb::list relay_writers(const Relay& self, Relay::SourceId source) {
  if (source >= self.sources()) throw nb::index_error("no source with this number");
  nb::list list;
  for (const auto& [handle, writer] : self.writers(source)) {
    list.append(nb::make_tuple(
        writer_tuple(handle, writer.messages, writer.received_at, writer.period, writer.delay, writer.name_problems),
        writer.malformed, writer.refused, writer.over_limit));
  }
  return list;
}

}  // namespace

nb::tuple writer_tuple(std::uint64_t writer, std::uint64_t messages, std::int64_t received_at,
                       const ArrivalPeriod& period, const StampDelay& delay, const NameProblems& name_problems) {
  const nb::object stamp_delay = delay.known() ? nb::object(nb::int_(delay.typical())) : nb::object(nb::none());
  return nb::make_tuple(writer, messages, received_at, period.median(), stamp_delay, to_str(name_problems.slashed),
                        to_str(name_problems.prefixed), to_str(name_problems.plain));
}

void define_relay(nb::module_& module) {
  nb::class_<Renaming>(module, "Renaming", "Add a prefix to the names of frames, except those to keep.")
      .def(nb::init<std::string, std::vector<std::string>>(), nb::arg("prefix"), nb::arg("keep"))
      .def("__call__", [](const Renaming& self, const std::string& name) { return self(name); }, nb::arg("name"));

  nb::class_<Relay>(module, "Relay", "Merge the TFMessages of several sources into one tree.")
      .def("__init__", &create, nb::arg("static"), nb::arg("period"), nb::arg("max_error") = nb::none())
      .def(
          "add_source",
          [](Relay& self, const Renaming& renaming, bool split) {
            return self.add_source(renaming, split ? Relay::Direction::split : Relay::Direction::merge);
          },
          nb::arg("renaming"), nb::arg("split"), nb::lock_self(), "Add a source; return its number.")
      .def("add", &add, nb::arg("source"), nb::arg("writer"), nb::arg("message"), nb::arg("at") = -1, nb::lock_self(),
           "Add a message from a writer of a source.")
      .def("take", &take_relayed, nb::arg("at") = -1, nb::lock_self(),
           "Return one message with everything to send since the last call, or None.")
      .def(
          "next_due",
          [](const Relay& self) {
            return self.next_due() == Relay::kNever ? nb::object(nb::none()) : nb::object(nb::int_(self.next_due()));
          },
          nb::lock_self(), "Return when take() has something to send although nothing is added, or None.")
      .def("forget_writer", &Relay::forget_writer, nb::arg("source"), nb::arg("writer"), nb::lock_self(),
           "Forget a writer that has disappeared.")
      .def("edges", &edges, nb::lock_self(), "Return the statistics of each edge.")
      .def("writers", &relay_writers, nb::arg("source"), nb::lock_self(),
           "Return the statistics of each writer of a source.");
}

}  // namespace coframe::bindings
