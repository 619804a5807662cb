// SPDX-License-Identifier: Apache-2.0
// Lookups at one time, with and without waiting.
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <chrono>
#include <optional>

#include "bindings/bindings.hpp"
#include "bindings/buffer_parts.hpp"
#include "bindings/failure.hpp"
#include "bindings/fast_call.hpp"
#include "bindings/transform.hpp"
#include "core/unfinished_change.hpp"

namespace coframe::bindings {

nb::object raise_for(BufferObject& self, Failure&& failure, nb::handle target, nb::handle source) {
  return raise_failure({std::move(failure), self.core, nb::borrow(target), nb::borrow(source)});
}

std::optional<Extrapolation> extrapolation_of(nb::handle limit, bool hold) {
  if (limit.is_none()) return std::nullopt;
  Extrapolation extrapolation;
  extrapolation.method = hold ? Extrapolation::Method::hold : Extrapolation::Method::twist;
  extrapolation.limit = to_duration(limit);
  if (extrapolation.limit < 0) throw nb::value_error("extrapolate must not be negative");
  return extrapolation;
}

namespace {

// Waits without the GIL for a change of shared data that makes the lookup succeed.
bool wait_for_shared(const Buffer& core, LookupQuery& query, std::int64_t timeout_ns, LookupResult& result,
                     Failure& failure) {
  using clock = std::chrono::steady_clock;
  return wait_with_signals(timeout_ns, [&](std::int64_t slice) {
    const auto end = clock::now() + std::chrono::nanoseconds(slice);
    for (;;) {
      const std::uint64_t seen_changes = core.changes();
      if (core.lookup_by_name(query, result, failure)) return true;
      const std::int64_t remaining_ns = (end - clock::now()) / std::chrono::nanoseconds(1);
      if (remaining_ns <= 0) return false;
      core.wait_for_change(seen_changes, remaining_ns);
    }
  });
}

// Tries immediately, then waits without the GIL for an insertion that makes the lookup succeed.
bool lookup_by_name_waiting(BufferObject& self, LookupQuery& query, std::int64_t timeout_ns, LookupResult& result,
                            Failure& failure) {
  const ChangeTimeout limit(timeout_ns);
  if (self.core->lookup_by_name(query, result, failure)) return true;
  if (timeout_ns <= 0) return false;
  if (self.core->following()) return wait_for_shared(*self.core, query, timeout_ns, result, failure);
  const auto wait = std::make_shared<Wait>(query);
  const ScopedWait queued(self.core->wait_queue(), wait);
  if (wait_with_signals(timeout_ns, [&](std::int64_t slice) { return wait->wait_for(slice); })) {
    result = wait->result();
    return true;
  }
  return self.core->lookup_by_name(query, result, failure);  // also updates what is missing
}

nb::object lookup_waiting(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamp,
                          std::int64_t timeout_ns, std::optional<Extrapolation>& extrapolation) {
  LookupQuery query = query_of(self, target, source, stamp);
  LookupResult result;
  Failure failure;
  if (lookup_by_name_waiting(self, query, timeout_ns, result, failure)) {
    return make_transform(result.pose, result.stamp, target, source);
  }
  if (extrapolation && self.core->lookup_by_name(query, result, failure, &*extrapolation)) {
    return make_transform(result.pose, result.stamp, target, source, extrapolation->furthest);
  }
  return raise_for(self, std::move(failure), target, source);
}

// The most frequent kind of query: two frames and a stamp that is an int or None.
struct PlainQuery {
  FrameId target = 0, source = 0;
  Stamp stamp = 0;

  // Returns false for every other query.
  bool read(FrameId target_frame, FrameId source_frame, PyObject* when) {
    target = target_frame;
    source = source_frame;
    if (target == 0 || source == 0 || target == source) return false;
    return !when || when == Py_None || to_int64_if_exact(when, stamp);
  }
};

PyObject* lookup_cached_path(BufferObject& self, PlainQuery& query, PyObject* target, PyObject* source) {
  Pose pose;
  if (!self.lookup_cached_path(query.target, query.source, query.stamp, pose)) return nullptr;
  return make_transform(pose, query.stamp, target, source).release().ptr();
}

// Returns the transform or sets the exception of the failed lookup. Returns nullptr without an exception if a frame
// no longer exists.
PyObject* lookup_by_walking(BufferObject& self, PlainQuery& query, PyObject* target, PyObject* source) {
  if (!self.core->knows(query.target) || !self.core->knows(query.source)) return nullptr;
  Pose pose;
  Failure failure;
  if (!self.core->lookup_by_walking(query.target, query.source, query.stamp, pose, failure)) {
    return raise_for(self, std::move(failure), target, source).release().ptr();
  }
  return make_transform(pose, query.stamp, target, source).release().ptr();
}

bool check_cached_path(BufferObject& self, const PlainQuery& query) {
  return self.check_cached_path(query.target, query.source, query.stamp);
}

// The fastest path: the arguments are (target, source[, stamp]) and the ids of the names are cached. Returns nullptr
// without an exception for all other arguments, and if `lookup` has no result.
template <class Lookup>
PyObject* call_with_cached_ids(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords,
                               Lookup&& lookup) {
  if (keywords || count < 2 || count > 3 || !nb::inst_ready(object)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = *nb::inst_ptr<BufferObject>(object);
    PlainQuery query;
    const FrameId target = self.frames.known(arguments[0]), source = self.frames.known(arguments[1]);
    return query.read(target, source, count == 3 ? arguments[2] : nullptr) ? lookup(self, query) : nullptr;
  });
}

nb::handle handle_or_none(PyObject* object) { return object ? nb::handle(object) : nb::handle(Py_None); }

// Calls the Python method that raises if the transform is interpolated over a longer gap.
void check_gap(nb::handle buffer, nb::handle target, nb::handle source, nb::handle transform, nb::handle max_gap) {
  if (max_gap.is_none() || !transform.is_valid()) return;
  buffer.attr("_check_gap")(target, source, transform.attr("stamp"), max_gap);
}

PyObject* lookup_general(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<10> signature(
      "lookup",
      {"target", "source", "stamp", "timeout", "extrapolate", "hold", "max_gap", "fixed", "source_time", "covariance"},
      2, 3);
  PyObject* values[10];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&] {
    BufferObject& self = buffer_of(object);
    if (values[7] || values[8] || is_true(values[9])) {
      const auto value = [&](int i) { return handle_or_none(values[i]); };
      const bool hold = is_true(values[5]), covariance = is_true(values[9]);
      const nb::object method = nb::handle(object).attr("_lookup_composed");
      return method(value(0), value(1), value(2), value(3), value(4), hold, value(6), value(7), value(8), covariance)
          .release()
          .ptr();
    }
    // Invalid values are rejected even if the arguments are not needed.
    const std::int64_t timeout = to_duration(handle_or_none(values[3]));
    const ChangeTimeout limit(timeout);
    std::optional<Extrapolation> extrapolation = extrapolation_of(handle_or_none(values[4]), is_true(values[5]));
    // A lookup that succeeds immediately needs neither waiting nor extrapolation.
    const auto checked = [&](nb::object found) {
      check_gap(object, values[0], values[1], found, handle_or_none(values[6]));
      return found.release().ptr();
    };
    PlainQuery query;
    if (query.read(self.frame(values[0]), self.frame(values[1]), values[2])) {
      if (PyObject* found = lookup_cached_path(self, query, values[0], values[1])) return checked(nb::steal(found));
    }
    return checked(lookup_waiting(self, values[0], values[1], handle_or_none(values[2]), timeout, extrapolation));
  });
}

PyObject* py_lookup(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  const auto lookup = [&](BufferObject& self, PlainQuery& query) {
    PyObject* found = lookup_cached_path(self, query, arguments[0], arguments[1]);
    return found ? found : lookup_by_walking(self, query, arguments[0], arguments[1]);
  };
  PyObject* found = call_with_cached_ids(object, arguments, count, keywords, lookup);
  return found || PyErr_Occurred() ? found : lookup_general(object, arguments, count, keywords);
}

nb::object py_lookup_full(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                          nb::handle source_stamp, nb::handle fixed, nb::handle timeout) {
  LookupQuery query = full_query_of(self, target, target_stamp, source, source_stamp, fixed);
  LookupResult result;
  Failure failure;
  if (!lookup_by_name_waiting(self, query, to_duration(timeout), result, failure)) {
    return raise_for(self, std::move(failure), target, source);
  }
  return make_transform(result.pose, result.stamp, target, source);
}

PyObject* can_transform_general(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<4> signature("can_transform", {"target", "source", "stamp", "timeout"}, 2, 3);
  PyObject* values[4];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&] {
    BufferObject& self = buffer_of(object);
    const std::int64_t timeout = to_duration(handle_or_none(values[3]));
    const ChangeTimeout limit(timeout);
    PlainQuery plain;
    if (plain.read(self.frame(values[0]), self.frame(values[1]), values[2]) && check_cached_path(self, plain)) {
      return Py_NewRef(Py_True);
    }
    LookupQuery query = query_of(self, values[0], values[1], handle_or_none(values[2]));
    LookupResult result;
    Failure failure;
    return PyBool_FromLong(lookup_by_name_waiting(self, query, timeout, result, failure));
  });
}

PyObject* py_can_transform(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  const auto lookup = [&](BufferObject& self, PlainQuery& query) {
    return check_cached_path(self, query) ? Py_NewRef(Py_True) : nullptr;
  };
  PyObject* found = call_with_cached_ids(object, arguments, count, keywords, lookup);
  return found || PyErr_Occurred() ? found : can_transform_general(object, arguments, count, keywords);
}

bool py_can_transform_full(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                           nb::handle source_stamp, nb::handle fixed, nb::handle timeout) {
  LookupQuery query = full_query_of(self, target, target_stamp, source, source_stamp, fixed);
  LookupResult result;
  Failure failure;
  return lookup_by_name_waiting(self, query, to_duration(timeout), result, failure);
}

std::string reason(BufferObject& self, LookupQuery query) {
  Failure failure;
  if (self.core->can_lookup(query, failure)) return "";
  return text_of({std::move(failure), self.core, {}, {}, Tf2Function::can_transform});
}

std::string why_not(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamp) {
  return reason(self, query_of(self, target, source, stamp));
}

std::string why_not_full(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                         nb::handle source_stamp, nb::handle fixed) {
  return reason(self, full_query_of(self, target, target_stamp, source, source_stamp, fixed));
}

nb::object py_latest_common_time(BufferObject& self, nb::handle target, nb::handle source) {
  LookupQuery query = query_of(self, target, source, nb::none());
  Failure failure;
  Stamp stamp = 0;
  if (!self.core->latest_common_time(query, stamp, failure)) {
    return raise_failure(
        {std::move(failure), self.core, nb::borrow(target), nb::borrow(source), Tf2Function::latest_common_time});
  }
  return nb::int_(stamp);
}

nb::object py_chain(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                    nb::handle source_stamp, nb::handle fixed) {
  const Stamp target_time = to_stamp(target_stamp), source_time = to_stamp(source_stamp);
  const Buffer& buffer = *self.core;
  const FrameId target_id = buffer.find(text(target)), source_id = buffer.find(text(source)),
                fixed_id = buffer.find(text(fixed));
  std::vector<FrameId> frames, rest;
  Failure failure;
  bool ok = false;
  if (source_id != 0) {
    ok = buffer.chain(fixed_id, source_id, source_time, frames, failure);
  } else {
    failure.code = ErrorCode::unknown_frame;
    failure.argument = Argument::source_frame;
    failure.name = text(source);
  }
  if (ok && source_time != target_time) {
    ok = buffer.chain(target_id, fixed_id, target_time, rest, failure);
    if (!frames.empty() && !rest.empty() && frames.back() == rest.front()) frames.pop_back();
    frames.insert(frames.end(), rest.begin(), rest.end());
  }
  if (!ok) return raise_failure({std::move(failure), self.core, nb::borrow(target), nb::borrow(source)});
  nb::list names;
  for (const FrameId frame : frames) names.append(buffer.name(frame));
  return names;
}

}  // namespace

void add_frequent_lookups(nb::handle cls) {
  add_method(cls, "lookup", &py_lookup,
             "lookup($self, /, target, source, stamp=None, *, timeout=None, extrapolate=None, hold=False, "
             "max_gap=None, fixed=None, source_time=None, covariance=False)\n--\n\n"
             R"doc(Return the transform at `stamp` that transforms data from `source` into `target`.

Args:
    target: The target frame.
    source: The source frame.
    stamp: Time of the lookup: nanoseconds, datetime64, an aware datetime, or a Time; 0 or None means the
        latest time at which all edges between the frames have data.
    timeout: How long to wait for the transform, such as ``"100ms"``; None and 0 do not wait. Other Python
        threads run in the meantime.
    extrapolate: How far the lookup may extrapolate beyond the samples of an edge, such as ``"50ms"``, after
        waiting has not helped; None does not extrapolate, as tf2.
    hold: Whether extrapolation holds the last pose instead of continuing with the last twist.
    max_gap: The longest interval between two samples of an edge that the lookup may interpolate over, such as
        ``"200ms"``; None interpolates over any, as tf2.
    fixed: A frame that does not move between `source_time` and `stamp`: the lookup returns the pose of `source` at
        `source_time` in `target` at `stamp`, like tf2's lookupTransform with six arguments.
    source_time: Time of `source`, by default `stamp`; needs `fixed`.
    covariance: Whether to compose the covariances of the edges. Edges without one count as exact and are listed in
        the `exact_edges` of the result.

Returns:
    A single transform: translation in meters, unit quaternion x, y, z, w, and the time of the lookup in
    ``stamp``. Its ``extrapolated`` is the length of the extrapolation in nanoseconds.

Raises:
    LookupException: A frame does not exist, or the tree contains a loop.
    ConnectivityException: The frames are in different trees.
    ExtrapolationException: An edge has no sample at that time, or that time lies in a gap above `max_gap`.
    InvalidArgumentException: A name is empty or has a leading slash.
    TypeError: A stamp or duration has a wrong type, such as a float of seconds.
    ValueError: A duration is an int below one microsecond, such as 2, or is text without a unit.

Example:
    >>> import coframe
    >>> buffer = coframe.Buffer()
    >>> for second in (1, 2):
    ...     _ = buffer.set("odom", "base", coframe.Transform([second, 0, 0]), second * 1_000_000_000)
    >>> buffer.lookup("odom", "base", 1_500_000_000).translation.tolist()
    [1.5, 0.0, 0.0])doc");
  add_method(cls, "can_transform", &py_can_transform,
             "can_transform($self, /, target, source, stamp=None, *, timeout=None)\n--\n\n"
             R"doc(Return whether :meth:`lookup` would succeed, or succeeds within `timeout`.

Args:
    target: The target frame.
    source: The source frame.
    stamp: Time of the lookup, as in :meth:`lookup`.
    timeout: How long to wait for the transform; None and 0 do not wait.)doc");
}

void define_lookups(nb::class_<BufferObject>& cls) {
  cls.def("_lookup_full", &py_lookup_full, any("target"), any("target_stamp"), any("source"), any("source_stamp"),
          any("fixed"), nb::kw_only(), nb::arg("timeout") = nb::none())
      .def("_can_transform_full", &py_can_transform_full, any("target"), any("target_stamp"), any("source"),
           any("source_stamp"), any("fixed"), nb::kw_only(), nb::arg("timeout") = nb::none())
      .def("_why_not", &why_not, any("target"), any("source"), nb::arg("stamp") = nb::none())
      .def("_why_not_full", &why_not_full, any("target"), any("target_stamp"), any("source"), any("source_stamp"),
           any("fixed"))
      .def("latest_common_time", &py_latest_common_time, any("target"), any("source"),
           R"doc(Return the newest time at which every edge between two frames has data.

Returns:
    Nanoseconds; 0 if all edges are static.

Raises:
    LookupException: A frame does not exist.
    TransformException: The frames are in different trees, or the tree contains a loop (tf2 chooses the class).)doc")
      .def("chain", &py_chain, any("target"), any("target_stamp"), any("source"), any("source_stamp"), any("fixed"),
           R"doc(Return the frames on the path from `source` through `fixed` to `target`.

Args:
    target: The target frame.
    target_stamp: Time of the target, as in :meth:`lookup`.
    source: The source frame.
    source_stamp: Time of the source, as in :meth:`lookup`.
    fixed: A frame that does not move between the two times.

Raises:
    TransformException: As :meth:`lookup`.)doc");
}

}  // namespace coframe::bindings
