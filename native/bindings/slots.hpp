// SPDX-License-Identifier: Apache-2.0
// Direct access to the values of Python classes with __slots__.
#pragma once

#include <nanobind/nanobind.h>
#include <structmember.h>  // PyMemberDef, before Python 3.12

namespace coframe::bindings {

namespace nb = nanobind;

// Returns where instances of `cls` hold the value of a slot. Throws a type_error for an attribute that is not a slot.
inline Py_ssize_t slot_offset(nb::handle cls, const char* name) {
  const nb::object descriptor = cls.attr(name);
  if (Py_TYPE(descriptor.ptr()) != &PyMemberDescr_Type) throw nb::type_error("a class with slots is wanted");
  return reinterpret_cast<PyMemberDescrObject*>(descriptor.ptr())->d_member->offset;
}

inline PyObject*& slot_at(PyObject* object, Py_ssize_t offset) {
  return *reinterpret_cast<PyObject**>(reinterpret_cast<char*>(object) + offset);
}

// Returns the value of a slot; invalid if the attribute was deleted.
inline nb::object read_slot(PyObject* object, Py_ssize_t offset) {
  const nb::ft_object_guard lock(object);
  return nb::borrow(slot_at(object, offset));
}

}  // namespace coframe::bindings
