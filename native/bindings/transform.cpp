// SPDX-License-Identifier: Apache-2.0
#include "bindings/transform.hpp"

#include <cmath>
#include <new>

#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

struct TransformObject {
  PyObject_HEAD
  Pose pose;
  Stamp stamp;
  Stamp extrapolated;  // nanoseconds of extrapolation beyond the data
  bool has_stamp;
  PyObject* target;  // str or None
  PyObject* source;
  PyObject* batch;        // None, or a tuple of arrays
  PyObject* uncertainty;  // None, or (covariance, names of the edges that count as exact)
};

PyTypeObject* transform_class = nullptr;  // the registered class, never released

TransformObject* self_of(PyObject* object) { return reinterpret_cast<TransformObject*>(object); }

PyObject* or_none(PyObject* object) { return Py_NewRef(object ? object : Py_None); }

// Arguments: 7 numbers, target, source, stamp, batch, and optionally the extrapolation and the uncertainty.
int initialize(PyObject* object, PyObject* arguments, PyObject* keywords) {
  if (keywords && PyDict_GET_SIZE(keywords) != 0) {
    PyErr_SetString(PyExc_TypeError, "the values of a transform are given by position");
    return -1;
  }
  double v[7];
  PyObject *target, *source, *stamp, *batch, *uncertainty = Py_None;
  long long extrapolated = 0;
  if (!PyArg_ParseTuple(arguments, "dddddddOOOO|LO", &v[0], &v[1], &v[2], &v[3], &v[4], &v[5], &v[6], &target, &source,
                        &stamp, &batch, &extrapolated, &uncertainty)) {
    return -1;
  }
  const long long nanoseconds = stamp == Py_None ? 0 : PyLong_AsLongLong(stamp);
  if (nanoseconds == -1 && PyErr_Occurred()) return -1;
  TransformObject* self = self_of(object);
  self->pose = Pose{{v[3], v[4], v[5], v[6]}, {v[0], v[1], v[2]}};
  self->stamp = nanoseconds;
  self->extrapolated = extrapolated;
  self->has_stamp = stamp != Py_None;
  Py_XSETREF(self->target, Py_NewRef(target));
  Py_XSETREF(self->source, Py_NewRef(source));
  Py_XSETREF(self->batch, Py_NewRef(batch));
  Py_XSETREF(self->uncertainty, Py_NewRef(uncertainty));
  return 0;
}

void deallocate_transform(PyObject* object) {
  TransformObject* self = self_of(object);
  PyTypeObject* type = Py_TYPE(object);
  Py_XDECREF(self->target);
  Py_XDECREF(self->source);
  Py_XDECREF(self->batch);
  Py_XDECREF(self->uncertainty);
  type->tp_free(object);
  Py_DECREF(type);
}

PyObject* get_values(PyObject* object, void*) {
  const PyObject* batch = self_of(object)->batch;
  if (batch && batch != Py_None) return PyObject_CallMethod(object, "__array__", nullptr);
  const Pose& pose = self_of(object)->pose;
  return Py_BuildValue("(ddddddd)", pose.p[0], pose.p[1], pose.p[2], pose.q[0], pose.q[1], pose.q[2], pose.q[3]);
}

PyObject* get_stamp(PyObject* object, void*) {
  const TransformObject* self = self_of(object);
  return self->has_stamp ? PyLong_FromLongLong(self->stamp) : Py_NewRef(Py_None);
}

PyObject* get_extrapolated(PyObject* object, void*) { return PyLong_FromLongLong(self_of(object)->extrapolated); }
PyObject* get_target(PyObject* object, void*) { return or_none(self_of(object)->target); }
PyObject* get_source(PyObject* object, void*) { return or_none(self_of(object)->source); }
PyObject* get_batch(PyObject* object, void*) { return or_none(self_of(object)->batch); }
PyObject* get_uncertainty(PyObject* object, void*) { return or_none(self_of(object)->uncertainty); }

PyGetSetDef transform_properties[] = {
    {"values", get_values, nullptr, "(x, y, z, qx, qy, qz, qw) as floats; of a batch: an array (..., 7).", nullptr},
    {"stamp", get_stamp, nullptr, "Nanoseconds, or None.", nullptr},
    {"target", get_target, nullptr, "The frame that the values are expressed in, or None.", nullptr},
    {"source", get_source, nullptr, "The frame whose pose the values are, or None.", nullptr},
    {"_extrapolated", get_extrapolated, nullptr, "Nanoseconds of extrapolation beyond the data of an edge.", nullptr},
    {"_batch", get_batch, nullptr, "None, or (translations, quaternions, stamps, extrapolated) as arrays.", nullptr},
    {"_uncertainty", get_uncertainty, nullptr, "None, or (covariance, names of the edges that count as exact).",
     nullptr},
    {nullptr, nullptr, nullptr, nullptr, nullptr}};

PyType_Slot transform_slots[] = {
    {Py_tp_doc, const_cast<char*>("One pose with its frames and stamp, or a batch of them.")},
    {Py_tp_init, reinterpret_cast<void*>(&initialize)},
    {Py_tp_new, reinterpret_cast<void*>(&PyType_GenericNew)},
    {Py_tp_dealloc, reinterpret_cast<void*>(&deallocate_transform)},
    {Py_tp_getset, transform_properties},
    {0, nullptr}};

PyType_Spec transform_spec = {"coframe._core.Transform", sizeof(TransformObject), 0,
                              Py_TPFLAGS_DEFAULT | Py_TPFLAGS_BASETYPE, transform_slots};

}  // namespace

nb::object make_transform(const Pose& pose, Stamp stamp, nb::handle target, nb::handle source, Stamp extrapolated) {
  PyObject* object = static_cast<PyObject*>(PyObject_Malloc(static_cast<std::size_t>(transform_class->tp_basicsize)));
  if (!object) throw std::bad_alloc();
  PyObject_Init(object, transform_class);
  TransformObject* self = self_of(object);
  self->pose = pose;
  self->stamp = stamp;
  self->extrapolated = extrapolated;
  self->has_stamp = true;
  self->target = Py_NewRef(target.ptr());
  self->source = Py_NewRef(source.ptr());
  self->batch = Py_NewRef(Py_None);
  self->uncertainty = Py_NewRef(Py_None);
  return nb::steal(object);
}

nb::object make_transform(const Pose& pose, nb::handle target, nb::handle source) {
  nb::object transform = make_transform(pose, 0, target, source);
  self_of(transform.ptr())->has_stamp = false;
  return transform;
}

bool read_transform(PyObject* object, GivenTransform& given) {
  if (Py_TYPE(object) != transform_class) return false;
  const TransformObject* self = self_of(object);
  if (self->batch != Py_None || self->uncertainty != Py_None) return false;
  given = {self->pose, self->stamp, self->has_stamp, self->target, self->source};
  return true;
}

namespace {

bool is_same(PyObject* a, PyObject* b) {
  if (a == b) return true;
  const int is_equal = PyObject_RichCompareBool(a, b, Py_EQ);
  if (is_equal < 0) throw nb::python_error();
  return is_equal == 1;
}

void normalize_rotation(Pose& pose) {
  const double scale = 1.0 / std::sqrt(dot(pose.q, pose.q));
  for (double& number : pose.q) number *= scale;
}

nb::object made_transform(const Pose& pose, bool has_stamp, Stamp stamp, PyObject* target, PyObject* source) {
  return has_stamp ? make_transform(pose, stamp, target, source) : make_transform(pose, target, source);
}

// Composes two single transforms without covariances; None for others, and if the inner frames differ.
nb::object compose_single(nb::handle a, nb::handle b) {
  GivenTransform first, second;
  if (!read_transform(a.ptr(), first) || !read_transform(b.ptr(), second)) return nb::none();
  if (first.source != Py_None && second.target != Py_None && !is_same(first.source, second.target)) return nb::none();
  Pose pose = second.pose;
  compose(first.pose, pose);
  normalize_rotation(pose);
  // Two different stamps leave none.
  const bool has_stamp = first.has_stamp != second.has_stamp || (first.has_stamp && first.stamp == second.stamp);
  return made_transform(pose, has_stamp, first.has_stamp ? first.stamp : second.stamp, first.target, second.source);
}

// Inverts a single transform without covariance; None for others.
nb::object invert_single(nb::handle transform) {
  GivenTransform given;
  if (!read_transform(transform.ptr(), given)) return nb::none();
  Pose pose;
  compose_inverse(given.pose, pose);
  normalize_rotation(pose);
  return made_transform(pose, given.has_stamp, given.stamp, given.source, given.target);
}

// CPython adds garbage collection to every class defined in Python, and a destructor for what such a class may add.
// This one adds nothing (__slots__ = ()) and cannot be part of a reference cycle: both are removed before the first
// instance exists, which halves the time of a lookup.
void make_light(PyTypeObject* type) {
  type->tp_flags &= ~Py_TPFLAGS_HAVE_GC;
  type->tp_traverse = nullptr;
  type->tp_clear = nullptr;
  type->tp_free = PyObject_Free;
  type->tp_dealloc = &deallocate_transform;
  PyType_Modified(type);
}

}  // namespace

void define_transform(nb::module_& module) {
  const nb::object type = nb::steal(PyType_FromSpec(&transform_spec));
  if (!type.is_valid()) throw nb::python_error();
  module.attr("Transform") = type;
  auto* base = reinterpret_cast<PyTypeObject*>(type.inc_ref().ptr());  // for as long as the process lives
  module.def(
      "register_transform_class",
      [base](nb::type_object cls) {
        auto* given = reinterpret_cast<PyTypeObject*>(cls.ptr());
        if (!PyType_IsSubtype(given, base) || given->tp_basicsize != base->tp_basicsize) {
          throw nb::type_error("the class must be a subclass of Transform with __slots__ = ()");
        }
        make_light(given);
        transform_class = reinterpret_cast<PyTypeObject*>(cls.release().ptr());
      },
      nb::arg("cls"), "Register the class of lookup results, a subclass of Transform with __slots__ = ().");
  module.def("compose_single", &compose_single, nb::arg("a"), nb::arg("b"),
             "Compose two single transforms; None for batches, covariances and different inner frames.");
  module.def("invert_single", &invert_single, nb::arg("transform"),
             "Invert a single transform; None for batches and covariances.");
  module.def(
      "new_transform",
      [](nb::args values) {
        nb::object transform = nb::steal(PyType_GenericAlloc(transform_class, 0));
        if (!transform.is_valid() || initialize(transform.ptr(), values.ptr(), nullptr) != 0) throw nb::python_error();
        return transform;
      },
      "Return a transform of the registered class with exactly these values, the arguments of Transform().");
}

}  // namespace coframe::bindings
