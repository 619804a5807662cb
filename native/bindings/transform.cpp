#include "bindings/transform.hpp"

#include <nanobind/stl/optional.h>

#include <optional>

#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

nb::handle transform_class;  // owned by the Python module that registers it

nb::tuple values(const TransformObject& transform) {
  const Pose& pose = transform.pose;
  return nb::make_tuple(pose.p[0], pose.p[1], pose.p[2], pose.q[0], pose.q[1], pose.q[2], pose.q[3]);
}

void initialise(TransformObject* self, double x, double y, double z, double qx, double qy, double qz, double qw,
                nb::object target, nb::object source, std::optional<Stamp> stamp, nb::object batch) {
  new (self) TransformObject{Pose{{qx, qy, qz, qw}, {x, y, z}}, stamp.value_or(0),   stamp.has_value(),
                             std::move(target),                 std::move(source), std::move(batch)};
}

}  // namespace

nb::object make_transform(const Pose& pose, Stamp stamp, nb::handle target, nb::handle source, Stamp beyond) {
  nb::object instance = nb::inst_alloc(transform_class);
  new (nb::inst_ptr<TransformObject>(instance))
      TransformObject{pose, stamp, true, nb::borrow(target), nb::borrow(source), nb::none(), beyond};
  nb::inst_mark_ready(instance);
  return instance;
}

void define_transform(nb::module_& module) {
  nb::class_<TransformObject>(module, "Transform", "One pose with its frames and stamp, or a batch of them.")
      .def("__init__", &initialise, nb::arg("x"), nb::arg("y"), nb::arg("z"), nb::arg("qx"), nb::arg("qy"),
           nb::arg("qz"), nb::arg("qw"), nb::arg("target").none(), nb::arg("source").none(), nb::arg("stamp").none(),
           nb::arg("batch").none())
      .def_prop_ro("values", &values, "(x, y, z, qx, qy, qz, qw) as floats; of a batch: the identity.")
      .def_prop_ro(
          "stamp",
          [](const TransformObject& self) { return self.has_stamp ? nb::object(nb::int_(self.stamp)) : nb::none(); },
          nb::sig("def stamp(self) -> int | None"), "Nanoseconds, or None.")
      .def_prop_ro(
          "target", [](const TransformObject& self) { return self.target; },
          nb::sig("def target(self) -> str | None"), "The frame that the values are told in, or None.")
      .def_prop_ro(
          "source", [](const TransformObject& self) { return self.source; },
          nb::sig("def source(self) -> str | None"), "The frame that the values are of, or None.")
      .def_prop_ro("beyond", [](const TransformObject& self) { return self.beyond; },
                   "How many nanoseconds beyond the data of a link it was extrapolated; 0: not at all.")
      .def_prop_ro("batch", [](const TransformObject& self) { return self.batch; },
                   "None, or (translations, quaternions, stamps) as arrays.");
  module.def(
      "register_transform_class", [](nb::type_object cls) { transform_class = cls.release(); }, nb::arg("cls"),
      "Look-ups return instances of `cls`, a subclass of Transform.");
}

}  // namespace coframe::bindings
