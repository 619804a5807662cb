// SPDX-License-Identifier: Apache-2.0
// The light object that a lookup returns; coframe.Transform is a Python class derived from it. It is a plain CPython
// type without garbage collection, because creating it takes most of the time of a lookup.
#pragma once

#include <nanobind/nanobind.h>

#include "core/history.hpp"
#include "core/pose.hpp"

namespace coframe::bindings {

namespace nb = nanobind;

// Creates an instance of the registered Python class. `extrapolated` is the extrapolation in nanoseconds.
nb::object make_transform(const Pose& pose, Stamp stamp, nb::handle target, nb::handle source, Stamp extrapolated = 0);

// Creates one without a stamp.
nb::object make_transform(const Pose& pose, nb::handle target, nb::handle source);

// The values of a Transform argument. The frames are borrowed references, None if it has none.
struct GivenTransform {
  Pose pose;
  Stamp stamp = 0;
  bool has_stamp = false;
  PyObject *target = nullptr, *source = nullptr;
};

// Returns false if the object is not a single transform of the registered class, or has a covariance.
bool read_transform(PyObject* object, GivenTransform& given);

}  // namespace coframe::bindings
