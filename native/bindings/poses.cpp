// SPDX-License-Identifier: Apache-2.0
// Many frames at one time, relative to one of them: what a viewer draws 30 times per second.
#include <nanobind/nanobind.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

// How the pose of a frame was found.
enum class State : std::uint8_t {
  exactly,
  held,         // an edge has no sample at that time; its nearest sample was used
  not_at_all,   // NaN
  in_own_tree,  // not connected to the fixed frame: relative to the root of its own tree
};

// Frames that are looked up together repeatedly, so that their names are resolved once.
class PoseTable {
 public:
  PoseTable(nb::handle_t<BufferObject> buffer, nb::str fixed, nb::list frames, nb::list roots)
      : buffer_(nb::borrow(buffer)), self_(nb::cast<BufferObject&>(buffer)) {
    if (frames.size() != roots.size()) throw nb::value_error("roots must have as many items as frames");
    rows_.reserve(frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const bool is_apart = !roots[i].is_none();
      rows_.push_back({{nb::cast<nb::str>(is_apart ? nb::object(roots[i]) : fixed), 0},
                       {nb::cast<nb::str>(nb::object(frames[i])), 0},
                       is_apart});
    }
  }

  void look_up(Stamp stamp, Stamp hold, nb::handle poses, nb::handle states) {
    constexpr int kFlags = PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS;
    const Memory memory(poses, kFlags), out_states(states, kFlags);
    if (memory.size() != rows_.size() * 7 * sizeof(double) || out_states.size() != rows_.size()) {
      throw nb::value_error("poses must be (N, 7) float64 and states (N,) uint8 for N frames");
    }
    double* out = memory.data<double>();
    std::uint8_t* how = out_states.data<std::uint8_t>();
    for (Row& row : rows_) {
      Pose pose;
      const State state = look_up(row, stamp, hold, pose);
      *how++ = static_cast<std::uint8_t>(state);
      if (state == State::not_at_all) {
        out = std::fill_n(out, 7, std::numeric_limits<double>::quiet_NaN());
      } else {
        out = std::copy_n(pose.q, 4, std::copy_n(pose.p, 3, out));
      }
    }
  }

 private:
  struct Frame {
    nb::str name;
    FrameId number;  // 0: does not exist yet
  };
  struct Row {
    Frame target, source;
    bool is_apart;  // the target is the root of the frame's own tree
  };

  FrameId number_of(Frame& frame) {
    if (frame.number == 0) frame.number = self_.frame(frame.name.ptr());
    return frame.number;
  }

  State look_up(Row& row, Stamp stamp, Stamp hold, Pose& pose) {
    const FrameId target = number_of(row.target), source = number_of(row.source);
    Stamp when = stamp, beyond = 0;
    if (target == 0 || source == 0 || target == source || !self_.lookup_cached_path(target, source, when, pose)) {
      LookupQuery query = query_of(self_, row.target.name, row.source.name, nb::none());
      query.stamp = stamp;
      Extrapolation extrapolation{Extrapolation::Method::hold, hold, 0};
      LookupResult result;
      Failure failure;
      if (!self_.core->lookup_by_name(query, result, failure, &extrapolation)) return State::not_at_all;
      pose = result.pose;
      beyond = extrapolation.furthest;
    }
    if (row.is_apart) return State::in_own_tree;
    return beyond == 0 ? State::exactly : State::held;
  }

  nb::object buffer_;
  BufferObject& self_;
  std::vector<Row> rows_;
};

std::size_t poses_near(nb::handle poses, nb::handle states, nb::handle origin, Py_ssize_t fixed, double limit,
                       nb::handle near) {
  const Memory rows(poses, PyBUF_C_CONTIGUOUS), states_memory(states, PyBUF_C_CONTIGUOUS),
      local(origin, PyBUF_C_CONTIGUOUS), out(near, PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS);
  const std::size_t count = states_memory.size();
  if (rows.size() != count * 7 * sizeof(double) || out.size() != count * 7 * sizeof(float) ||
      local.size() != 3 * sizeof(double)) {
    throw nb::value_error("poses (N, 7) float64, states (N,) uint8, origin (3,) float64, near (N, 7) float32");
  }
  std::size_t far_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double* pose = rows.data<double>() + 7 * i;
    float* local_pose = out.data<float>() + 7 * i;
    double distance = 0;
    for (std::size_t axis = 0; axis < 7; ++axis) {
      const double value = axis < 3 ? pose[axis] - local.data<double>()[axis] : pose[axis];
      local_pose[axis] = static_cast<float>(value);
      if (axis < 3 && std::isfinite(value)) distance = std::max(distance, std::abs(value));
    }
    const bool is_shown = states_memory.data<std::uint8_t>()[i] <= static_cast<std::uint8_t>(State::held);
    if (is_shown && distance > limit && static_cast<Py_ssize_t>(i) != fixed) ++far_count;
  }
  return far_count;
}

}  // namespace

void define_poses(nb::module_& module) {
  using nb::arg;
  nb::class_<PoseTable>(module, "PoseTable", "Many frames that are looked up together repeatedly.")
      .def(nb::init<nb::handle_t<BufferObject>, nb::str, nb::list, nb::list>(), arg("buffer"), arg("fixed"),
           arg("frames"), arg("roots"))
      .def("look_up", nb::overload_cast<Stamp, Stamp, nb::handle, nb::handle>(&PoseTable::look_up), arg("stamp"),
           arg("hold"), arg("poses"), arg("states"), nb::lock_self(), "Compute the poses of all frames at one time.");
  module.def("poses_near", &poses_near, arg("poses"), arg("states"), arg("origin"), arg("fixed"), arg("limit"),
             arg("near"), "Write poses as float32 relative to an origin; return how many are far from it.");
}

}  // namespace coframe::bindings
