// SPDX-License-Identifier: Apache-2.0
// Joint trees with names: forward kinematics from Python's joint positions to transforms.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <vector>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/transform.hpp"
#include "robots/joint_tree.hpp"

namespace coframe::bindings {

namespace {

// Work below about 5 ms does not justify releasing the GIL.
constexpr std::size_t kManyPoses = 500'000;

JointKind kind_of(std::string_view type) {
  if (type == "fixed") return JointKind::fixed;
  if (type == "revolute" || type == "continuous") return JointKind::rotating;
  if (type == "prismatic") return JointKind::prismatic;
  if (type == "planar") return JointKind::planar;
  if (type == "floating") return JointKind::floating;
  throw nb::value_error("unknown joint type");
}

template <std::size_t kCount>
std::array<double, kCount> numbers(nb::handle sequence) {
  std::array<double, kCount> values;
  if (nb::len(sequence) != kCount) throw nb::value_error("wrong number of values");
  for (std::size_t i = 0; i < kCount; ++i) values[i] = nb::cast<double>(nb::object(sequence[i]));
  return values;
}

Pose pose_at(const double* row) { return {{row[3], row[4], row[5], row[6]}, {row[0], row[1], row[2]}}; }

class JointTreeObject {
 public:
  // Joints are (name, type, parent link, child link, origin as 7 numbers, axis, mimic as (joint, multiplier, offset) or
  // None), parents before children.
  JointTreeObject(nb::str root, nb::list joints) : root_(root) {
    for (nb::handle joint : joints) {
      rows_[joint[0]] = names_.size();
      behind_[joint[3]] = names_.size();
      names_.push_back(nb::borrow(joint[0]));
      before_.push_back(nb::borrow(joint[2]));
      children_.push_back(nb::borrow(joint[3]));
    }
    std::vector<JointDescription> descriptions;
    for (nb::handle joint : joints) descriptions.push_back(description_of(joint));
    tree_ = JointTree(descriptions);
  }

  // Returns the transforms of one configuration: of each link relative to the root link, or of each joint relative to
  // the previous link. None if a position is not finite, has the wrong size, or belongs to no movable joint.
  nb::object transforms(nb::dict positions, bool in_root) const {
    std::vector<JointPositions> given(tree_.size());
    std::vector<double> values(7 * tree_.size());
    for (auto [name, position] : positions) {
      PyObject* row = PyDict_GetItemWithError(rows_.ptr(), name.ptr());
      if (!row) {
        if (PyErr_Occurred()) throw nb::python_error();
        return nb::none();
      }
      const std::size_t joint = PyLong_AsSize_t(row);
      double* place = values.data() + 7 * joint;
      if (!read_position(position.ptr(), position_size(tree_.kind(joint)), place)) return nb::none();
      given[joint] = {reinterpret_cast<const char*>(place), 0, sizeof(double)};
    }
    std::vector<double> poses(7 * tree_.size());
    if (tree_.poses(given, 1, in_root, 1, poses.data()) != tree_.size()) return nb::none();
    nb::dict found;
    if (in_root) found[root_] = make_transform(Pose{}, root_, root_);
    for (std::size_t j = 0; j < tree_.size(); ++j) {
      found[in_root ? children_[j] : names_[j]] =
          make_transform(pose_at(poses.data() + 7 * j), in_root ? root_ : before_[j], children_[j]);
    }
    return found;
  }

  // Writes the poses of many configurations to `out`, joint by joint. Positions are (joint, float64 array with one
  // axis, or two for a joint with several numbers). Returns the name of the first joint with an invalid position, or
  // None.
  nb::object poses_into(nb::list positions, std::size_t count, bool in_root, nb::handle out, unsigned threads) const {
    const Memory rows(out, PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS);
    if (rows.size() / sizeof(double) / 7 != tree_.size() * count || rows.size() % (7 * sizeof(double)) != 0) {
      throw nb::value_error("out must have 7 float64 for each joint in each configuration");
    }
    std::list<StridedDoubles> arrays;
    std::vector<JointPositions> given(tree_.size());
    for (nb::handle pair : positions) {
      const auto joint = nb::cast<std::size_t>(nb::object(rows_[pair[0]]));
      given[joint] = arrays.emplace_back(pair[1]).positions(count, position_size(tree_.kind(joint)));
    }
    std::size_t invalid_joint;
    without_gil_if(threads > 1 || tree_.size() * count > kManyPoses,
                   [&] { invalid_joint = tree_.poses(given, count, in_root, threads, rows.data<double>()); });
    return invalid_joint == tree_.size() ? nb::none() : names_[invalid_joint];
  }

 private:
  // An array with any strides, locked while it is used.
  class StridedDoubles {
   public:
    explicit StridedDoubles(nb::handle array) {
      if (PyObject_GetBuffer(array.ptr(), &view_, PyBUF_STRIDES | PyBUF_FORMAT) != 0) throw nb::python_error();
    }
    StridedDoubles(const StridedDoubles&) = delete;
    StridedDoubles& operator=(const StridedDoubles&) = delete;
    ~StridedDoubles() { PyBuffer_Release(&view_); }

    JointPositions positions(std::size_t count, std::size_t size) const {
      const int axes = size == 1 ? 1 : 2;
      if (std::string_view(view_.format ? view_.format : "B") != "d" || view_.ndim != axes || size == 0 ||
          static_cast<std::size_t>(view_.shape[0]) != count ||
          (axes == 2 && static_cast<std::size_t>(view_.shape[1]) != size)) {
        throw nb::value_error("positions must be float64, (N,) or (N, size of the joint's position)");
      }
      return {static_cast<const char*>(view_.buf), view_.strides[0], axes == 2 ? view_.strides[1] : 0};
    }

   private:
    Py_buffer view_;
  };

  JointDescription description_of(nb::handle joint) const {
    JointDescription found;
    found.kind = kind_of(nb::cast<std::string_view>(nb::object(joint[1])));
    if (behind_.contains(joint[2])) found.parent = nb::cast<std::ptrdiff_t>(nb::object(behind_[joint[2]]));
    const auto origin = numbers<7>(joint[4]);
    found.origin = pose_at(origin.data());
    std::ranges::copy(numbers<3>(joint[5]), found.axis);
    const nb::object mimic = joint[6];
    if (!mimic.is_none()) {
      found.mimicked = nb::cast<std::ptrdiff_t>(nb::object(rows_[nb::object(mimic[0])]));
      found.multiplier = nb::cast<double>(nb::object(mimic[1]));
      found.offset = nb::cast<double>(nb::object(mimic[2]));
    }
    return found;
  }

  static bool read_number(PyObject* object, double& value) {
    if (!PyFloat_Check(object) && !PyLong_Check(object)) return false;
    value = PyFloat_AsDouble(object);
    if (value == -1.0 && PyErr_Occurred()) {  // an int that is too large for a float
      PyErr_Clear();
      return false;
    }
    return std::isfinite(value);
  }

  static bool read_position(PyObject* object, std::size_t size, double* place) {
    if (size == 1) return read_number(object, *place);
    if (size == 0 || !(PyList_Check(object) || PyTuple_Check(object))) return false;
    const nb::handle sequence(object);
    if (nb::len(sequence) != size) return false;
    for (std::size_t i = 0; i < size; ++i) {
      if (!read_number(nb::object(sequence[i]).ptr(), place[i])) return false;
    }
    return true;
  }

  nb::object root_;
  nb::dict rows_;    // the joints' rows by name
  nb::dict behind_;  // and by the link behind them
  std::vector<nb::object> names_, before_, children_;
  JointTree tree_{{}};
};

}  // namespace

void define_robots(nb::module_& module) {
  using nb::arg;
  nb::class_<JointTreeObject>(module, "JointTree", "A joint tree and the forward kinematics of its links.")
      .def(nb::init<nb::str, nb::list>(), arg("root"), arg("joints"))
      .def("transforms", &JointTreeObject::transforms, arg("positions"), arg("in_root"),
           "Return the transforms of one configuration; None if a position is invalid.")
      .def("poses_into", &JointTreeObject::poses_into, arg("positions"), arg("count"), arg("in_root"), arg("out"),
           arg("threads"), "Compute many configurations; return the first joint with an invalid position.");
}

}  // namespace coframe::bindings
