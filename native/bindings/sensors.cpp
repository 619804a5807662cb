// SPDX-License-Identifier: Apache-2.0
// Points in NumPy arrays, given as fields: x, y and z each as an array with one or two axes and any strides.
#include <nanobind/nanobind.h>
#include <nanobind/stl/vector.h>

#include <bit>
#include <list>
#include <string_view>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "kernels/levels.hpp"
#include "sensors/depth_codecs.hpp"
#include "sensors/deskew.hpp"
#include "sensors/transform.hpp"

namespace coframe::bindings {

namespace {

// Work below about 5 ms does not justify releasing the GIL.
constexpr std::size_t kManyPoints = 2'000'000, kManyTimes = 500'000;

Number number_of(std::string_view format) {
  constexpr bool kLittle = std::endian::native == std::endian::little;
  const bool swapped = !format.empty() && (kLittle ? format[0] == '>' || format[0] == '!' : format[0] == '<');
  if (format.ends_with('f')) return swapped ? Number::float32_swapped : Number::float32;
  if (format.ends_with('d')) return swapped ? Number::float64_swapped : Number::float64;
  throw nb::value_error("coordinates must be float32 or float64");
}

// The memory of an array, locked while it is used.
class StridedMemory {
 public:
  explicit StridedMemory(nb::handle array) {
    if (PyObject_GetBuffer(array.ptr(), &view_, PyBUF_STRIDES | PyBUF_FORMAT | PyBUF_WRITABLE) != 0) {
      throw nb::python_error();
    }
  }
  StridedMemory(const StridedMemory&) = delete;
  StridedMemory& operator=(const StridedMemory&) = delete;
  ~StridedMemory() { PyBuffer_Release(&view_); }

  const Py_buffer& operator*() const { return view_; }

 private:
  Py_buffer view_;
};

class Fields {
 public:
  // A sequence of triples: the first is the position of the points, the others are directions.
  explicit Fields(nb::sequence triples) {
    for (nb::handle triple : triples) {
      if (nb::len(triple) != 3) throw nb::value_error("each field must have three coordinates");
      const Field x = field(triple[0]), y = field(triple[1]), z = field(triple[2]);
      coordinates_.push_back({x, y, z, !coordinates_.empty()});
    }
    if (memory_.empty()) throw nb::value_error("at least one field is required");
    flatten();
  }

  const Grid& grid() const { return grid_; }
  const std::vector<Coordinates>& coordinates() const { return coordinates_; }

 private:
  Field field(nb::handle array) {
    const Py_buffer& view = *memory_.emplace_back(array);
    if (view.ndim != 1 && view.ndim != 2) throw nb::value_error("a field must have one or two axes");
    const bool rows = view.ndim == 2;
    const Grid grid{rows ? static_cast<std::size_t>(view.shape[0]) : 1,
                    static_cast<std::size_t>(view.shape[view.ndim - 1])};
    if (memory_.size() == 1) grid_ = grid;
    if (grid.rows != grid_.rows || grid.width != grid_.width) throw nb::value_error("fields must have the same shape");
    return {static_cast<char*>(view.buf), rows ? view.strides[0] : 0, view.strides[view.ndim - 1],
            number_of(view.format ? view.format : "B")};
  }

  // Contiguous rows, and rows of one point, are treated as one long row.
  void flatten() {
    const bool columns = grid_.width == 1;
    const auto seamless = [&](const Field& f) {
      return columns || f.row_step == static_cast<std::ptrdiff_t>(grid_.width) * f.step;
    };
    for (const Coordinates& each : coordinates_) {
      if (!seamless(each.x) || !seamless(each.y) || !seamless(each.z)) return;
    }
    for (Coordinates& each : coordinates_) {
      for (Field* f : {&each.x, &each.y, &each.z}) {
        if (columns && grid_.rows > 1) f->step = f->row_step;
      }
    }
    grid_ = {1, grid_.count()};
  }

  Grid grid_{0, 0};
  std::list<StridedMemory> memory_;
  std::vector<Coordinates> coordinates_;
};

// x, y, z, qx, qy, qz, qw.
Pose pose_of(const std::vector<double>& values) {
  if (values.size() != 7) throw nb::value_error("a pose is 7 numbers");
  return {{values[3], values[4], values[5], values[6]}, {values[0], values[1], values[2]}};
}

void py_transform(const std::vector<double>& pose, nb::sequence triples, unsigned threads) {
  const Fields fields(triples);
  const Pose values = pose_of(pose);
  without_gil_if(threads > 1 || fields.grid().count() > kManyPoints,
                 [&] { transform_points(values, fields.grid(), fields.coordinates(), threads); });
}

nb::tuple py_deskew(BufferObject& buffer, nb::handle target, nb::handle source, nb::handle times,
                    const std::vector<double>& result_from_target, nb::sequence triples, bool nan_for_missing,
                    unsigned threads) {
  const Fields fields(triples);
  const Memory stamps(times, PyBUF_C_CONTIGUOUS);
  const std::size_t count = fields.grid().count();
  if (stamps.size() != count * sizeof(Stamp)) throw nb::value_error("there must be as many times as points");
  const DeskewRequest request{buffer.frame(target.ptr()),
                              buffer.frame(source.ptr()),
                              pose_of(result_from_target),
                              stamps.data<const Stamp>(),
                              nan_for_missing,
                              threads};
  const std::shared_ptr<Buffer> core = buffer.core;
  Missing missing;
  without_gil_if(threads > 1 || count > kManyTimes,
                 [&] { missing = deskew(*core, request, fields.grid(), fields.coordinates()); });
  return nb::make_tuple(missing.count, missing.first);
}

bool py_unfilter_png(nb::handle rows, nb::handle pixels, std::size_t row_bytes, std::size_t pixel_bytes) {
  const Memory filtered(rows, PyBUF_C_CONTIGUOUS), target(pixels, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE);
  if (row_bytes == 0 || pixel_bytes == 0 || target.size() % row_bytes != 0) {
    throw nb::value_error("the size of the pixels must be a multiple of a row");
  }
  const std::size_t height = target.size() / row_bytes;
  if (filtered.size() != height * (row_bytes + 1)) throw nb::value_error("each row must begin with its filter");
  bool valid = false;
  without_gil_if(true, [&] {
    valid =
        unfilter_png(filtered.data<const std::uint8_t>(), target.data<std::uint8_t>(), height, row_bytes, pixel_bytes);
  });
  return valid;
}

bool py_decode_rvl(nb::handle words, nb::handle depths) {
  const Memory compressed(words, PyBUF_C_CONTIGUOUS), target(depths, PyBUF_C_CONTIGUOUS | PyBUF_WRITABLE);
  bool valid = false;
  without_gil_if(true, [&] {
    valid = decode_rvl(compressed.data<const std::uint32_t>(), compressed.size() / 4, target.data<std::uint16_t>(),
                       target.size() / 2);
  });
  return valid;
}

nb::tuple level_names() {
  nb::list names;
  for (const Kernels* each : all_kernels()) names.append(each->level);
  return nb::tuple(names);
}

}  // namespace

void define_sensors(nb::module_& module) {
  using nb::arg;
  module.attr("CPU_LEVEL") = kernels().level;
  module.attr("CPU_LEVELS") = level_names();
  module.def("transform_fields", &py_transform, arg("pose"), arg("fields"), arg("threads"),
             "Transform points by a pose, in place.");
  module.def("deskew_fields", &py_deskew, arg("buffer"), arg("target"), arg("source"), arg("times"),
             arg("result_from_target"), arg("fields"), arg("nan_for_missing"), arg("threads"),
             "Transform points, each at its own time, in place; return how many have no transform, and the first.");
  module.def("unfilter_png", &py_unfilter_png, arg("rows"), arg("pixels"), arg("row_bytes"), arg("pixel_bytes"),
             "Undo the filters of PNG rows into the pixels; return whether all filters are known.");
  module.def("decode_rvl", &py_decode_rvl, arg("words"), arg("depths"),
             "Decode an RVL depth image of uint16 values; return whether the data is complete.");
}

}  // namespace coframe::bindings
