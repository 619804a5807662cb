// SPDX-License-Identifier: Apache-2.0
#include "bindings/failure.hpp"

#include <array>
#include <new>

#include "bindings/bindings.hpp"
#include "bindings/fast_call.hpp"
#include "core/unfinished_change.hpp"

namespace coframe::bindings {

namespace {

// A plain CPython type, like Transform: most failed lookups are caught and discarded.
struct Object {
  PyObject_HEAD
  FailureObject failure;
};

PyTypeObject* failure_class = nullptr;  // both for as long as the process lives
std::array<PyObject*, 9> exceptions{};  // in the order of Raised

enum Raised {
  kTransform,
  kLookup,
  kConnectivity,
  kExtrapolation,
  kInvalidArgument,
  kDecode,
  kTimeout,
  kFrozenFile,
  kWire
};

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

Raised exception_of(const FailureObject& object) {
  // tf2's Python binding raises only the base class for errors in the tree during get_latest_common_time.
  const bool is_time = object.function == Tf2Function::latest_common_time;
  switch (object.failure.code) {
    case ErrorCode::empty_name:
    case ErrorCode::leading_slash: return kInvalidArgument;
    case ErrorCode::unknown_frame: return kLookup;
    case ErrorCode::loop: return is_time ? kTransform : kLookup;
    case ErrorCode::not_connected: return is_time ? kTransform : kConnectivity;
    default: return kExtrapolation;
  }
}

bool has_window(ErrorCode code) {
  return code == ErrorCode::only_other || code == ErrorCode::too_new || code == ErrorCode::too_old;
}

bool has_edge(ErrorCode code) { return has_window(code) || code == ErrorCode::no_data; }

nb::object stamp_or_none(bool is_available, Stamp stamp) {
  return is_available ? nb::object(nb::int_(stamp)) : nb::none();
}

// A frame of the failed leg; with a fixed frame, it need not be one of the requested frames.
nb::object frame_name(const FailureObject& object, FrameId frame, const nb::object& requested_name) {
  if (frame == 0) return requested_name;
  const std::string name = object.buffer->name(frame);
  return nb::str(name.data(), name.size());
}

nb::object name_of(const std::string& name) { return nb::str(name.data(), name.size()); }

nb::object code(const FailureObject& object) { return nb::str(code_name(object.failure.code)); }
nb::object target(const FailureObject& object) { return frame_name(object, object.failure.target, object.target); }
nb::object source(const FailureObject& object) { return frame_name(object, object.failure.source, object.source); }
nb::object requested(const FailureObject& object) {
  return stamp_or_none(has_edge(object.failure.code), object.failure.requested);
}
nb::object earliest(const FailureObject& object) {
  return stamp_or_none(has_window(object.failure.code), object.failure.earliest);
}
nb::object latest(const FailureObject& object) {
  return stamp_or_none(has_window(object.failure.code), object.failure.latest);
}

nb::object edge(const FailureObject& object) {
  if (!has_edge(object.failure.code)) return nb::none();
  const FrameId child = object.failure.edge;
  const auto [parent, name] = object.buffer->read([&](const Tree& tree) {
    const History::View history = tree.history(child);
    return std::pair(history.exists() ? tree.name(history.parent()) : std::string(), tree.name(child));
  });
  return nb::make_tuple(name_of(parent), name_of(name));
}

nb::object roots(const FailureObject& object) {
  const Failure& failure = object.failure;
  if (failure.code != ErrorCode::not_connected) return nb::none();
  return nb::make_tuple(name_of(object.buffer->name(failure.target_end)),
                        name_of(object.buffer->name(failure.source_end)));
}

nb::object name(const FailureObject& object) { return name_of(object.failure.name); }

// Whether no further transforms are expected: the buffer is frozen, or keeps everything, as recordings do.
nb::object is_complete(const FailureObject& object) {
  return nb::bool_(object.buffer->frozen() || object.buffer->cache_length() < 0);
}

// The current parents of all frames; "" for frames without one.
nb::object parents(const FailureObject& object) {
  nb::dict parents_by_name;
  for (const FrameSummary& frame : object.buffer->frames())
    parents_by_name[name_of(frame.name)] = name_of(frame.parent);
  return parents_by_name;
}

FailureObject& failure_of(PyObject* object) { return reinterpret_cast<Object*>(object)->failure; }

template <nb::object (*Fact)(const FailureObject&)>
PyObject* get(PyObject* object, void*) {
  return guarded([&] { return Fact(failure_of(object)).release().ptr(); });
}

PyObject* describe(PyObject* object) {
  return guarded([&] { return name_of(text_of(failure_of(object))).release().ptr(); });
}

void deallocate_failure(PyObject* object) {
  PyTypeObject* type = Py_TYPE(object);
  failure_of(object).~FailureObject();
  type->tp_free(object);
  Py_DECREF(type);
}

PyGetSetDef failure_properties[] = {{"code", &get<&code>, nullptr, nullptr, nullptr},
                                    {"target", &get<&target>, nullptr, nullptr, nullptr},
                                    {"source", &get<&source>, nullptr, nullptr, nullptr},
                                    {"requested", &get<&requested>, nullptr, nullptr, nullptr},
                                    {"earliest", &get<&earliest>, nullptr, nullptr, nullptr},
                                    {"latest", &get<&latest>, nullptr, nullptr, nullptr},
                                    {"edge", &get<&edge>, nullptr, nullptr, nullptr},
                                    {"roots", &get<&roots>, nullptr, nullptr, nullptr},
                                    {"name", &get<&name>, nullptr, nullptr, nullptr},
                                    {"recorded", &get<&is_complete>, nullptr, nullptr, nullptr},
                                    {"parents", &get<&parents>, nullptr, nullptr, nullptr},
                                    {nullptr, nullptr, nullptr, nullptr, nullptr}};

PyType_Slot failure_slots[] = {
    {Py_tp_doc, const_cast<char*>("The facts of a failed lookup; str() returns tf2's text.")},
    {Py_tp_dealloc, reinterpret_cast<void*>(&deallocate_failure)},
    {Py_tp_str, reinterpret_cast<void*>(&describe)},
    {Py_tp_getset, failure_properties},
    {0, nullptr}};

PyType_Spec failure_spec = {"coframe._core.Failure", sizeof(Object), 0,
                            Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, failure_slots};

nb::object make_failure(FailureObject&& failure) {
  nb::object object = nb::steal(failure_class->tp_alloc(failure_class, 0));
  if (!object.is_valid()) throw nb::python_error();
  new (&failure_of(object.ptr())) FailureObject(std::move(failure));
  return object;
}

void register_errors(const nb::module_& errors) {
  constexpr std::array kNames{"TransformException",     "LookupException",          "ConnectivityException",
                              "ExtrapolationException", "InvalidArgumentException", "DecodeError",
                              "TimeoutException",       "FrozenFileError",          "WireError"};
  for (std::size_t i = 0; i < kNames.size(); ++i) exceptions[i] = nb::object(errors.attr(kNames[i])).release().ptr();
}

}  // namespace

std::string text_of(const FailureObject& object) {
  return object.buffer->read([&](const Tree& tree) {
    switch (object.function) {
      case Tf2Function::can_transform: return can_transform_text(object.failure, tree);
      case Tf2Function::latest_common_time: return latest_common_time_text(object.failure, tree);
      default: return lookup_text(object.failure, tree);
    }
  });
}

nb::object raise_failure(FailureObject&& failure) {
  failure.buffer->check_memory();  // the frames may only seem not to exist
  const CallingPython call;
  PyObject* exception = exceptions[exception_of(failure)];
  PyErr_SetObject(exception, make_failure(std::move(failure)).ptr());
  return nb::object();
}

void raise_decode_error(const DecodeFailure& failure) {
  const std::string text = "tf2_msgs/msg/TFMessage at byte " + std::to_string(failure.offset) + ": " + failure.reason;
  PyErr_SetString(exceptions[kDecode], text.c_str());
  throw nb::python_error();
}

void set_unfinished_change(const char* text) { PyErr_SetString(exceptions[kTimeout], text); }

void set_lost_memory(const LostMemory& error) {
  PyErr_SetString(exceptions[error.kind == LostMemory::Kind::shared ? kWire : kFrozenFile], error.what());
}

void define_failure(nb::module_& module) {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const UnfinishedChange& error) {
      set_unfinished_change(error.what());
    } catch (const LostMemory& error) {
      set_lost_memory(error);
    }
  });
  const nb::object type = nb::steal(PyType_FromSpec(&failure_spec));
  if (!type.is_valid()) throw nb::python_error();
  module.attr("Failure") = type;
  failure_class = reinterpret_cast<PyTypeObject*>(type.inc_ref().ptr());
  module.def("register_errors", &register_errors, nb::arg("errors"),
             "Register the module whose exceptions are raised for failures.");
}

}  // namespace coframe::bindings
