// Many frames at one time, seen from one of them: what a viewer draws, 30 times a second.
#include <nanobind/nanobind.h>

#include <algorithm>
#include <limits>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

// How an answer was come by.
enum class Told : std::uint8_t {
  exactly,
  held,         // a link has no sample at that time, and was taken to stand still beyond its samples
  not_at_all,   // NaN
  in_own_tree,  // not connected with the fixed frame: seen from the root of the frame's own tree
};

bool look_up(BufferObject& self, nb::handle target, nb::handle source, Stamp stamp, Stamp hold, Pose& pose,
             Stamp& beyond) {
  beyond = 0;
  const FrameId target_id = self.frame(target.ptr()), source_id = self.frame(source.ptr());
  Stamp when = stamp;
  if (target_id != 0 && source_id != 0 && target_id != source_id &&
      self.core->quick_lookup(self.paths, target_id, source_id, when, pose)) {
    return true;
  }
  Question question = question_of(self, target, source, nb::none());
  question.stamp = stamp;
  Extrapolation extrapolation{Extrapolation::Method::hold, hold, 0};
  Answer answer;
  Failure failure;
  if (!self.core->answer(question, answer, failure, &extrapolation)) return false;
  pose = answer.pose;
  beyond = extrapolation.furthest;
  return true;
}

Told look_up_somehow(BufferObject& self, nb::handle fixed, nb::handle root, nb::handle frame, Stamp stamp, Stamp hold,
                     Pose& pose) {
  Stamp beyond;
  if (root.is_none()) {
    if (!look_up(self, fixed, frame, stamp, hold, pose, beyond)) return Told::not_at_all;
    return beyond == 0 ? Told::exactly : Told::held;
  }
  return look_up(self, root, frame, stamp, hold, pose, beyond) ? Told::in_own_tree : Told::not_at_all;
}

void poses_into(BufferObject& self, nb::handle fixed, nb::list frames, nb::list roots, Stamp stamp, Stamp hold,
                nb::handle poses, nb::handle told) {
  constexpr int kFlags = PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS;
  const Memory rows(poses, kFlags), states(told, kFlags);
  const std::size_t count = frames.size();
  if (roots.size() != count || rows.size() != count * 7 * sizeof(double) || states.size() != count) {
    throw nb::value_error("roots, poses (N, 7) float64 and told (N,) uint8 must be as many as there are frames");
  }
  for (std::size_t i = 0; i < count; ++i) {
    Pose pose;
    const Told how = look_up_somehow(self, fixed, roots[i], frames[i], stamp, hold, pose);
    double* row = rows.data<double>() + 7 * i;
    std::copy_n(pose.p, 3, row);
    std::copy_n(pose.q, 4, row + 3);
    if (how == Told::not_at_all) std::fill_n(row, 7, std::numeric_limits<double>::quiet_NaN());
    states.data<std::uint8_t>()[i] = static_cast<std::uint8_t>(how);
  }
}

}  // namespace

void define_poses(nb::module_& module) {
  using nb::arg;
  module.def("poses_into", &poses_into, arg("buffer"), arg("fixed"), arg("frames"), arg("roots"), arg("stamp"),
             arg("hold"), arg("poses"), arg("told"), "Many frames at one time, seen from one of them.");
}

}  // namespace coframe::bindings
