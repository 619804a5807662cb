// The light object that a look-up returns; coframe.Transform is a Python class on top of it.
#pragma once

#include <nanobind/nanobind.h>

#include "core/history.hpp"
#include "core/pose.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

struct TransformObject {
  Pose pose;
  Stamp stamp = 0;
  bool has_stamp = false;
  nb::object target, source;  // str or None
  nb::object batch;           // None, or (translations, quaternions, stamps) as arrays
  Stamp beyond = 0;           // nanoseconds beyond the data that it was extrapolated
};

// An instance of the registered Python class.
nb::object make_transform(const Pose& pose, Stamp stamp, nb::handle target, nb::handle source, Stamp beyond = 0);

}  // namespace coframe::bindings
