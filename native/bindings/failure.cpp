#include "bindings/failure.hpp"

#include <nanobind/stl/string.h>

#include "bindings/bindings.hpp"

namespace coframe::bindings {

namespace {

nb::handle errors_module;  // coframe.errors, owned by sys.modules

const char* code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::none: return "none";
    case ErrorCode::empty_name: return "empty_name";
    case ErrorCode::leading_slash: return "leading_slash";
    case ErrorCode::unknown_frame: return "unknown_frame";
    case ErrorCode::loop: return "loop";
    case ErrorCode::not_connected: return "not_connected";
    case ErrorCode::only_other: return "only_other";
    case ErrorCode::too_new: return "too_new";
    case ErrorCode::too_old: return "too_old";
    case ErrorCode::no_data: return "no_data";
  }
  return "none";
}

const char* exception_name(const FailureObject& object) {
  switch (object.failure.code) {
    case ErrorCode::empty_name:
    case ErrorCode::leading_slash: return "InvalidArgumentException";
    case ErrorCode::unknown_frame: return "LookupException";
    // tf2's Python binding has only the base class for what the latest common time meets in the tree.
    case ErrorCode::loop:
      return object.speaker == Speaker::latest_common_time ? "TransformException" : "LookupException";
    case ErrorCode::not_connected:
      return object.speaker == Speaker::latest_common_time ? "TransformException" : "ConnectivityException";
    default: return "ExtrapolationException";
  }
}

bool has_window(ErrorCode code) {
  return code == ErrorCode::only_other || code == ErrorCode::too_new || code == ErrorCode::too_old;
}

bool has_edge(ErrorCode code) { return has_window(code) || code == ErrorCode::no_data; }

nb::object stamp_or_none(bool applies, Stamp stamp) { return applies ? nb::object(nb::int_(stamp)) : nb::none(); }

// A frame of the failed leg, which in a look-up over a fixed frame need not be one of those asked for.
nb::object frame_name(const FailureObject& object, FrameId frame, const nb::object& asked) {
  if (frame == 0) return asked;
  const std::string name = object.buffer->name(frame);
  return nb::str(name.data(), name.size());
}

nb::object edge(const FailureObject& object) {
  if (!has_edge(object.failure.code)) return nb::none();
  const FrameId child = object.failure.edge;
  const auto [parent, name] = object.buffer->read([&](const Tree& tree) {
    const History::View history = tree.history(child);
    return std::pair(history.exists() ? tree.name(history.parent()) : std::string(), tree.name(child));
  });
  return nb::make_tuple(parent, name);
}

nb::object roots(const FailureObject& object) {
  const Failure& failure = object.failure;
  if (failure.code != ErrorCode::not_connected) return nb::none();
  return nb::make_tuple(object.buffer->name(failure.target_end), object.buffer->name(failure.source_end));
}

// Of all frames, as of now; "" for those that have none.
nb::dict parents(const FailureObject& object) {
  nb::dict all;
  for (const FrameSummary& frame : object.buffer->frames()) all[nb::str(frame.name.data(), frame.name.size())] = frame.parent;
  return all;
}

}  // namespace

std::string text_of(const FailureObject& object) {
  return object.buffer->read([&](const Tree& tree) {
    switch (object.speaker) {
      case Speaker::can_transform: return can_transform_text(object.failure, tree);
      case Speaker::latest_common_time: return latest_common_time_text(object.failure, tree);
      default: return lookup_text(object.failure, tree);
    }
  });
}

nb::object raise_failure(FailureObject failure) {
  const CallingPython call;
  nb::object cls = errors_module.attr(exception_name(failure));
  PyErr_SetObject(cls.ptr(), nb::cast(std::move(failure)).ptr());
  return nb::object();
}

void raise_decode_error(const DecodeFailure& failure) {
  const std::string text =
      "tf2_msgs/msg/TFMessage at byte " + std::to_string(failure.offset) + ": " + failure.reason;
  PyErr_SetString(nb::object(errors_module.attr("DecodeError")).ptr(), text.c_str());
  throw nb::python_error();
}

void define_failure(nb::module_& module) {
  nb::class_<FailureObject>(module, "Failure", "The facts of a failed look-up; str() gives tf2's text.")
      .def("__str__", &text_of)
      .def_prop_ro("code", [](const FailureObject& self) { return code_name(self.failure.code); })
      .def_prop_ro(
          "target", [](const FailureObject& self) { return frame_name(self, self.failure.target, self.target); },
          nb::sig("def target(self) -> str"))
      .def_prop_ro(
          "source", [](const FailureObject& self) { return frame_name(self, self.failure.source, self.source); },
          nb::sig("def source(self) -> str"))
      .def_prop_ro(
          "requested",
          [](const FailureObject& self) { return stamp_or_none(has_edge(self.failure.code), self.failure.requested); },
          nb::sig("def requested(self) -> int | None"))
      .def_prop_ro(
          "earliest",
          [](const FailureObject& self) { return stamp_or_none(has_window(self.failure.code), self.failure.earliest); },
          nb::sig("def earliest(self) -> int | None"))
      .def_prop_ro(
          "latest",
          [](const FailureObject& self) { return stamp_or_none(has_window(self.failure.code), self.failure.latest); },
          nb::sig("def latest(self) -> int | None"))
      .def_prop_ro("edge", &edge, nb::sig("def edge(self) -> tuple[str, str] | None"))
      .def_prop_ro("roots", &roots, nb::sig("def roots(self) -> tuple[str, str] | None"))
      .def_prop_ro("name", [](const FailureObject& self) { return self.failure.name; })
      .def_prop_ro("parents", &parents, nb::sig("def parents(self) -> dict[str, str]"));
  module.def(
      "register_errors", [](nb::object errors) { errors_module = errors.release(); }, nb::arg("errors"),
      "Failures are raised as the exceptions of this module.");
}

}  // namespace coframe::bindings
