// SPDX-License-Identifier: Apache-2.0
// The light object that a look-up returns; coframe.Transform is a Python class on top of it. A class of CPython's own
// making, without the garbage collector's bookkeeping: making one is most of what a look-up costs.
#pragma once

#include <nanobind/nanobind.h>

#include "core/history.hpp"
#include "core/pose.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// An instance of the registered Python class. `beyond`: nanoseconds that it was extrapolated.
nb::object make_transform(const Pose& pose, Stamp stamp, nb::handle target, nb::handle source, Stamp beyond = 0);

// One without a stamp.
nb::object make_transform(const Pose& pose, nb::handle target, nb::handle source);

// What a transform that was given holds; the frames are borrowed, None where it names none.
struct GivenTransform {
  Pose pose;
  Stamp stamp = 0;
  bool has_stamp = false;
  PyObject *target = nullptr, *source = nullptr;
};

// False for what is no single transform of the registered class.
bool read_transform(PyObject* object, GivenTransform& given);

}  // namespace coframe::bindings
