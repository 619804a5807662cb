// SPDX-License-Identifier: Apache-2.0
// Lookups at many times.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string_view.h>

#include <optional>
#include <vector>

#include "bindings/bindings.hpp"
#include "bindings/buffer_parts.hpp"

namespace coframe::bindings {

double* rows_of(const Memory& memory, std::size_t columns, std::size_t count) {
  if (memory.size() != columns * count * sizeof(double)) {
    throw nb::value_error("the arrays must have as many rows as there are stamps");
  }
  return memory.data<double>();
}

namespace {

Batch::Missing missing_of(std::string_view on_error) {
  if (on_error == "raise") return Batch::Missing::stop;
  if (on_error == "nan") return Batch::Missing::nan;
  if (on_error == "clip") return Batch::Missing::clip;
  throw nb::value_error("on_error must be \"raise\", \"nan\" or \"clip\"");
}

// Arrays with the same number of rows: stamps (in and out), poses (N, 7), and optionally twists (N, 6) and the
// extrapolation (N,). Returns the first row without a transform, and raises for it unless it is filled with NaN.
std::size_t lookup_rows(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamps, nb::handle poses,
                        nb::handle twists, nb::handle extrapolated, std::string_view on_error, unsigned threads,
                        nb::handle extrapolate, bool hold) {
  constexpr int kFlags = PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS;
  const Memory times(stamps, kFlags), places(poses, kFlags);
  std::optional<Memory> rates, distances;
  const std::size_t count = times.size() / sizeof(Stamp);
  Batch batch{count, times.data<Stamp>(), rows_of(places, 7, count), nullptr, nullptr, missing_of(on_error)};
  if (!twists.is_none()) batch.twists = rows_of(rates.emplace(twists, kFlags), 6, count);
  if (!extrapolated.is_none())
    batch.extrapolated = reinterpret_cast<Stamp*>(rows_of(distances.emplace(extrapolated, kFlags), 1, count));
  const LookupQuery query = query_of(self, target, source, nb::none());
  const std::optional<Extrapolation> extrapolation = extrapolation_of(extrapolate, hold);
  Failure failure;
  std::size_t missing;
  const auto run = [&] {
    missing = self.core->lookup_many(query, extrapolation ? &*extrapolation : nullptr, batch, threads, failure);
  };
  if (count > kLargeBatch || threads > 1) {
    const WithoutGil release;
    run();
  } else {
    run();
  }
  if (missing < count && batch.missing != Batch::Missing::nan) {
    raise_for(self, std::move(failure), target, source);
    throw nb::python_error();
  }
  return missing;
}

nb::bytes stamps_between(BufferObject& self, nb::handle target, nb::handle source, Stamp first, Stamp last) {
  LookupQuery query = query_of(self, target, source, nb::none());
  std::vector<Stamp> stamps;
  Failure failure;
  if (!self.core->stamps_between(query, first, last, stamps, failure)) {
    raise_for(self, std::move(failure), target, source);
    throw nb::python_error();
  }
  return nb::bytes(stamps.data(), stamps.size() * sizeof(Stamp));
}

}  // namespace

void define_many_lookups(nb::class_<BufferObject>& cls) {
  cls.def("_lookup_rows", &lookup_rows, any("target"), any("source"), nb::arg("stamps"), nb::arg("poses"),
          any("twists"), any("extrapolated"), nb::arg("on_error"), nb::arg("threads"),
          nb::arg("extrapolate") = nb::none(), nb::arg("hold") = false)
      .def("_stamps_between", &stamps_between, any("target"), any("source"), nb::arg("first"), nb::arg("last"));
}

}  // namespace coframe::bindings
