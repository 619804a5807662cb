// SPDX-License-Identifier: Apache-2.0
// Operations on batches of poses in NumPy arrays: composition, exponential, logarithm, interpolation.
#include <nanobind/nanobind.h>

#include <string_view>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "kernels/kernels.hpp"

namespace coframe::bindings {

namespace {

// Work below about 5 ms does not justify releasing the GIL.
constexpr std::size_t kManyRows = 200'000;

// A float64 array (n, width) or (1, width) whose rows are contiguous, locked while it is used.
class NumberRows {
 public:
  NumberRows(nb::handle array, std::size_t width, std::size_t n) {
    if (PyObject_GetBuffer(array.ptr(), &view_, PyBUF_STRIDES | PyBUF_FORMAT) != 0) throw nb::python_error();
    constexpr Py_ssize_t kSize = sizeof(double);
    const bool is_valid = view_.ndim == 2 && std::string_view(view_.format ? view_.format : "B") == "d" &&
                          view_.shape[1] == static_cast<Py_ssize_t>(width) &&
                          (width == 1 || view_.strides[1] == kSize) && view_.strides[0] % kSize == 0 &&
                          (view_.shape[0] == 1 || view_.shape[0] == static_cast<Py_ssize_t>(n));
    if (!is_valid) {
      PyBuffer_Release(&view_);
      throw nb::value_error("arrays must be float64 with contiguous rows, one or as many as the result has");
    }
  }
  NumberRows(const NumberRows&) = delete;
  NumberRows& operator=(const NumberRows&) = delete;
  ~NumberRows() { PyBuffer_Release(&view_); }

  const double* data() const { return static_cast<const double*>(view_.buf); }
  std::ptrdiff_t step() const {
    return view_.shape[0] == 1 ? 0 : view_.strides[0] / static_cast<std::ptrdiff_t>(sizeof(double));
  }

 private:
  Py_buffer view_;
};

// Translations (n, 3) and quaternions (n, 4).
class PoseRowsArgument {
 public:
  PoseRowsArgument(nb::tuple poses, std::size_t n) : p_(poses[0], 3, n), q_(poses[1], 4, n) {}
  PoseBatch batch() const { return {p_.data(), q_.data(), p_.step(), q_.step()}; }

 private:
  NumberRows p_, q_;
};

// The array (n, width) that a result is written to.
class Result {
 public:
  Result(nb::handle array, std::size_t width) : memory_(array, PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS) {
    if (memory_.size() % (width * sizeof(double)) != 0) throw nb::value_error("the result has the wrong size");
    count_ = memory_.size() / (width * sizeof(double));
  }
  std::size_t count() const { return count_; }
  double* data() const { return memory_.data<double>(); }

  template <class Function>
  void fill(Function&& function) const {
    if (count_ != 0) without_gil_if(count_ > kManyRows, function);
  }

 private:
  Memory memory_;
  std::size_t count_;
};

void py_compose(nb::tuple a, nb::tuple b, bool inverse, nb::handle out) {
  const Result result(out, 7);
  const PoseRowsArgument first(a, result.count()), second(b, result.count());
  result.fill(
      [&] { kernels().compose_batches(first.batch(), second.batch(), inverse, result.count(), result.data()); });
}

void py_exponentials(nb::handle twists, nb::handle out) {
  const Result result(out, 7);
  const Memory rows(twists, PyBUF_C_CONTIGUOUS);
  if (rows.size() != result.count() * 6 * sizeof(double)) throw nb::value_error("twists must be float64 (n, 6)");
  result.fill([&] { kernels().exponentials(rows.data<const double>(), result.count(), result.data()); });
}

void py_logarithms(nb::tuple poses, nb::handle out) {
  const Result result(out, 6);
  const PoseRowsArgument rows(poses, result.count());
  result.fill([&] { kernels().logarithms(rows.batch(), result.count(), result.data()); });
}

void py_interpolate(nb::tuple a, nb::tuple b, nb::handle fractions, bool screw, nb::handle out) {
  const Result result(out, 7);
  const PoseRowsArgument first(a, result.count()), second(b, result.count());
  const Memory numbers(fractions, PyBUF_C_CONTIGUOUS);
  const std::size_t count = numbers.size() / sizeof(double);
  if (count != 1 && count != result.count()) throw nb::value_error("there must be one fraction, or one per pose");
  const Fractions given{numbers.data<const double>(), count == 1 ? 0u : 1u};
  result.fill([&] {
    kernels().interpolate_batches(first.batch(), second.batch(), given, screw, result.count(), result.data());
  });
}

}  // namespace

void define_lie(nb::module_& module) {
  using nb::arg;
  module.def("compose_batches", &py_compose, arg("a"), arg("b"), arg("inverse"), arg("out"),
             "Write the poses a b, or a^-1 b, to an array (n, 7).");
  module.def("exponentials", &py_exponentials, arg("twists"), arg("out"), "Write exp(twist) to an array (n, 7).");
  module.def("logarithms", &py_logarithms, arg("poses"), arg("out"), "Write log(pose) to an array (n, 6).");
  module.def("interpolate_batches", &py_interpolate, arg("a"), arg("b"), arg("fractions"), arg("screw"), arg("out"),
             "Write interpolated poses to an array (n, 7).");
}

}  // namespace coframe::bindings
