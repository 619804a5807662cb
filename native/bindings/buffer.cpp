// SPDX-License-Identifier: Apache-2.0
#include "bindings/buffer.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <chrono>
#include <optional>
#include <set>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/failure.hpp"
#include "bindings/fast_call.hpp"
#include "bindings/transform.hpp"
#include "core/dump.hpp"

namespace coframe::bindings {

namespace {

// Waits without the GIL for a change of shared data that makes the lookup succeed.
bool wait_for_shared(const Buffer& core, LookupQuery& query, std::int64_t timeout_ns, LookupResult& result,
                     Failure& failure) {
  using clock = std::chrono::steady_clock;
  return wait_with_signals(timeout_ns, [&](std::int64_t slice) {
    const auto end = clock::now() + std::chrono::nanoseconds(slice);
    for (;;) {
      const std::uint64_t seen = core.changes();
      if (core.lookup_by_name(query, result, failure)) return true;
      const std::int64_t left = (end - clock::now()) / std::chrono::nanoseconds(1);
      if (left <= 0) return false;
      core.wait_for_change(seen, left);
    }
  });
}

// Tries at once, then waits without the GIL for an insertion that makes the lookup succeed.
bool lookup_by_name_waiting(BufferObject& self, LookupQuery& query, std::int64_t timeout_ns, LookupResult& result,
                            Failure& failure) {
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

// Larger batches release the GIL; for smaller ones releasing it costs more than it gains.
constexpr std::size_t kLargeBatch = 20'000;

nb::object raise_for(BufferObject& self, Failure&& failure, nb::handle target, nb::handle source) {
  return raise_failure({std::move(failure), self.core, nb::borrow(target), nb::borrow(source)});
}

// Returns nothing if extrapolation is not requested.
std::optional<Extrapolation> extrapolation_of(nb::handle limit, bool hold) {
  if (limit.is_none()) return std::nullopt;
  Extrapolation extrapolation;
  extrapolation.method = hold ? Extrapolation::Method::hold : Extrapolation::Method::twist;
  extrapolation.limit = to_duration(limit);
  if (extrapolation.limit < 0) throw nb::value_error("extrapolate must not be negative");
  return extrapolation;
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
    return !when || when == Py_None || quick_int64(when, stamp);
  }
};

PyObject* lookup_cached_path(BufferObject& self, PlainQuery& query, PyObject* target, PyObject* source) {
  Pose pose;
  if (!self.lookup_cached_path(query.target, query.source, query.stamp, pose)) return nullptr;
  return make_transform(pose, query.stamp, target, source).release().ptr();
}

// Returns the transform or sets the exception of the failed lookup. Returns nullptr without an exception if a frame
// does not exist any more.
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

bool is_true(PyObject* object) {
  const int truth = object ? PyObject_IsTrue(object) : 0;
  if (truth < 0) throw nb::python_error();
  return truth != 0;
}

PyObject* lookup_general(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<6> signature("lookup", {"target", "source", "stamp", "timeout", "extrapolate", "hold"}, 2, 3);
  PyObject* values[6];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&] {
    BufferObject& self = buffer_of(object);
    // Invalid values are rejected even if the arguments are not needed.
    const std::int64_t timeout = to_duration(handle_or_none(values[3]));
    std::optional<Extrapolation> extrapolation = extrapolation_of(handle_or_none(values[4]), is_true(values[5]));
    // A lookup that succeeds at once needs neither waiting nor extrapolation.
    PlainQuery query;
    if (query.read(self.frame(values[0]), self.frame(values[1]), values[2])) {
      if (PyObject* found = lookup_cached_path(self, query, values[0], values[1])) return found;
    }
    return lookup_waiting(self, values[0], values[1], handle_or_none(values[2]), timeout, extrapolation)
        .release()
        .ptr();
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

double* rows(const Memory& memory, std::size_t columns, std::size_t count) {
  if (memory.size() != columns * count * sizeof(double)) {
    throw nb::value_error("the arrays must have as many rows as there are stamps");
  }
  return memory.data<double>();
}

Batch::Missing missing_of(std::string_view on_error) {
  if (on_error == "raise") return Batch::Missing::stop;
  if (on_error == "nan") return Batch::Missing::nan;
  if (on_error == "clip") return Batch::Missing::clip;
  throw nb::value_error("on_error must be \"raise\", \"nan\" or \"clip\"");
}

// Arrays with the same number of rows: stamps (in and out), poses (N, 7), and optionally twists (N, 6) and the
// extrapolation (N,). Returns the first row without a transform, and raises for it unless it is filled with NaN.
std::size_t lookup_rows(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamps, nb::handle poses,
                        nb::handle twists, nb::handle beyond, std::string_view on_error, unsigned threads,
                        nb::handle extrapolate, bool hold) {
  constexpr int kFlags = PyBUF_WRITABLE | PyBUF_C_CONTIGUOUS;
  const Memory times(stamps, kFlags), places(poses, kFlags);
  std::optional<Memory> rates, distances;
  const std::size_t count = times.size() / sizeof(Stamp);
  Batch batch{count, times.data<Stamp>(), rows(places, 7, count), nullptr, nullptr, missing_of(on_error)};
  if (!twists.is_none()) batch.twists = rows(rates.emplace(twists, kFlags), 6, count);
  if (!beyond.is_none()) batch.beyond = reinterpret_cast<Stamp*>(rows(distances.emplace(beyond, kFlags), 1, count));
  const LookupQuery query = query_of(self, target, source, nb::none());
  const std::optional<Extrapolation> extrapolation = extrapolation_of(extrapolate, hold);
  Failure failure;
  std::size_t missing;
  const auto run = [&] {
    missing = self.core->lookup_many(query, extrapolation ? &*extrapolation : nullptr, batch, threads, failure);
  };
  if (count > kLargeBatch || threads > 1) {
    const WithoutGil release;
    run();
  } else {
    run();
  }
  if (missing < count && batch.missing != Batch::Missing::nan) {
    raise_for(self, std::move(failure), target, source);
    throw nb::python_error();
  }
  return missing;
}

nb::bytes stamps_between(BufferObject& self, nb::handle target, nb::handle source, Stamp first, Stamp last) {
  LookupQuery query = query_of(self, target, source, nb::none());
  std::vector<Stamp> stamps;
  Failure failure;
  if (!self.core->stamps_between(query, first, last, stamps, failure)) {
    raise_for(self, std::move(failure), target, source);
    throw nb::python_error();
  }
  return nb::bytes(stamps.data(), stamps.size() * sizeof(Stamp));
}

// Returns (refusals, stored rows, first rejected row).
nb::tuple set_rows(BufferObject& self, std::string_view parent, std::string_view child, nb::handle stamps,
                   nb::handle poses, bool is_static, nb::handle authority) {
  const Memory times(stamps, PyBUF_C_CONTIGUOUS), places(poses, PyBUF_C_CONTIGUOUS);
  const std::size_t count = times.size() / sizeof(Stamp);
  const Track track{parent, child, count, times.data<const Stamp>(), rows(places, 7, count)};
  self.stop_sharing();
  const AuthorityId who = self.authority(authority.ptr());
  std::size_t stored, bad_row;
  unsigned refusals;
  const auto run = [&] { refusals = self.core->insert_many(track, is_static, who, stored, bad_row); };
  if (count > kLargeBatch) {
    const WithoutGil release;
    run();
  } else {
    run();
  }
  return nb::make_tuple(refusals, stored, bad_row);
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

nb::tuple frame_tuple(const FrameSummary& f) {
  return nb::make_tuple(f.name, f.parent, f.is_static, f.samples, f.oldest, f.newest, f.rate, f.authority);
}

nb::tuple edge_tuple(const EdgeSummary& e) {
  const nb::tuple intervals = nb::make_tuple(e.mean_interval, e.interval_deviation, e.longest_interval);
  const nb::tuple counts = nb::make_tuple(e.stored, e.late, e.repeated, e.old, e.self, e.nan, e.quaternion);
  return nb::make_tuple(frame_tuple(e.frame), intervals, counts);
}

nb::list edge_tuples(const BufferObject& self, const std::optional<std::vector<std::string>>& children) {
  nb::list edges;
  if (!children) {
    for (const EdgeSummary& edge : self.core->edges()) edges.append(edge_tuple(edge));
    return edges;
  }
  std::set<FrameId> frames;  // in the order of all frames
  for (const std::string& child : *children) frames.insert(self.core->find(child));
  frames.erase(0);
  for (const FrameId frame : frames) {
    if (const auto edge = self.core->edge(frame)) edges.append(edge_tuple(*edge));
  }
  return edges;
}

PyObject* py_set_values(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<12> signature(
      "_set_values", {"parent", "child", "stamp", "x", "y", "z", "qx", "qy", "qz", "qw", "static", "authority"}, 12,
      12);
  PyObject* values[12];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = buffer_of(object);
    double v[7];
    for (int i = 0; i < 7; ++i) {
      v[i] = PyFloat_AsDouble(values[3 + i]);
      if (v[i] == -1.0 && PyErr_Occurred()) return nullptr;
    }
    const Stamp stamp = to_int64(values[2]);
    const bool is_static = is_true(values[10]);
    const TransformValues transform{{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
    return PyLong_FromUnsignedLong(self.insert([&] {
      const FrameId parent = self.frame(values[0]), child = self.frame(values[1]);
      const AuthorityId authority = self.authority(values[11]);
      const bool known = parent != 0 && child != 0 && parent != child;
      return known ? self.core->insert(parent, child, stamp, transform, is_static, authority)
                   : self.core->insert(text(values[0]), text(values[1]), stamp, transform, is_static, authority);
    }));
  });
}

// The usual case of coframe.Buffer.set(): two known frames, which equal the transform's own frames if it has any, and a
// stamp.
PyObject* py_set_plain(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<5> signature("_set_plain", {"parent", "child", "transform", "stamp", "static"}, 5, 5);
  PyObject* values[5];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&]() -> PyObject* {
    BufferObject& self = buffer_of(object);
    const FrameId parent = self.frames.known(values[0]), child = self.frames.known(values[1]);
    GivenTransform given;
    const auto is = [](PyObject* name, PyObject* wanted) { return name == Py_None || name == wanted; };
    const bool is_plain = parent != 0 && child != 0 && parent != child && values[4] == Py_False &&
                          read_transform(values[2], given) && is(given.target, values[0]) &&
                          is(given.source, values[1]) && !self.core->frozen();
    const bool has_time = values[3] == Py_None ? given.has_stamp : quick_int64(values[3], given.stamp);
    if (!is_plain || !has_time) return Py_NewRef(Py_None);
    const double *p = given.pose.p, *q = given.pose.q;
    const TransformValues transform{{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
    return PyLong_FromUnsignedLong(
        self.insert([&] { return self.core->insert(parent, child, given.stamp, transform, false, 0); }));
  });
}

nb::list py_insert_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp, double x,
                         double y, double z, double qx, double qy, double qz, double qw, std::string_view authority) {
  nb::list lines;
  for (const LogLine& line : refusal_texts(refusals, parent, child, stamp, {{x, y, z}, {qx, qy, qz, qw}}, authority)) {
    lines.append(nb::make_tuple(line.is_error ? "error" : "warning", line.text));
  }
  return lines;
}

PyObject* py_ingest(PyObject* object, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<3> signature("ingest", {"cdr", "static", "authority"}, 1, 1);
  PyObject* values[3];
  if (!signature.parse(arguments, count, keywords, values)) return nullptr;
  return guarded([&] {
    BufferObject& self = buffer_of(object);
    const bool is_static = is_true(values[1]);
    self.stop_sharing();
    const AuthorityId authority = values[2] ? self.authority(values[2]) : 0;
    const Memory bytes(values[0], PyBUF_SIMPLE);
    std::size_t stored;
    DecodeFailure failure;
    {
      const nb::ft_lock_guard lock(self.ingesting);
      failure =
          self.core->ingest(self.stream(is_static, authority), bytes.data<const std::uint8_t>(), bytes.size(), stored);
    }
    if (failure.reason) raise_decode_error(failure);
    return PyLong_FromSize_t(stored);
  });
}

nb::list frame_tuples(const BufferObject& self) {
  nb::list frames;
  for (const FrameSummary& frame : self.core->frames()) frames.append(frame_tuple(frame));
  return frames;
}

const char* found_name(Found found) {
  switch (found) {
    case Found::ok: return "ok";
    case Found::empty: return "no_data";
    case Found::only_other: return "only_other";
    case Found::too_new: return "too_new";
    case Found::too_old: return "too_old";
  }
  return "";
}

// Returns the state of an edge at a time: (result of the search, the parent then or else the last one, the stamps
// before and after). None for a frame without a history.
nb::object edge_at(const BufferObject& self, std::string_view child, Stamp stamp) {
  struct EdgeState {
    bool exists;
    Found found;
    std::string parent;
    Stamp before, after;
  };
  const EdgeState state = self.core->read([&](const Tree& tree) {
    const History::View history = tree.history(tree.find(child));
    Pose pose;
    FrameId parent = history.parent();
    const Found found = history.exists() ? history.at(stamp, pose, parent) : Found::empty;
    Stamp before = history.newest(), after = before;
    if (found == Found::ok && !history.is_static() && stamp != 0) {
      const std::size_t next = history.first_after(stamp);
      before = history.time(next == 0 ? 0 : next - 1);
      after = before == stamp ? before : history.time(std::min(next, history.size() - 1));
    }
    return EdgeState{history.exists(), found, parent == 0 ? std::string() : tree.name(parent), before, after};
  });
  if (!state.exists) return nb::none();
  return nb::make_tuple(found_name(state.found), state.parent, state.before, state.after);
}

nb::dict statistics(const BufferObject& self) {
  const Counts counts = self.core->counts();
  nb::dict named;
  named["messages"] = counts.messages;
  named["malformed"] = counts.malformed;
  named["stored"] = counts.stored;
  named["refused"] = counts.refused;
  named["old"] = counts.old;
  named["over_limit"] = counts.over_limit;
  return named;
}

nb::bytes encode(const BufferObject& self, bool is_static) {
  const std::string message = self.core->encode(is_static);
  return nb::bytes(message.data(), message.size());
}

void add_frequent_methods(nb::handle cls) {
  add_method(cls, "lookup", &py_lookup,
             "lookup($self, /, target, source, stamp=None, *, timeout=None, extrapolate=None, hold=False)\n--\n\n"
             R"doc(Return the transform at `stamp` that transforms data from `source` into `target`.

Args:
    target: The target frame.
    source: The source frame.
    stamp: Time of the lookup: nanoseconds, datetime64, an aware datetime, or a Time; 0 or None means the
        latest time at which all edges between the frames have data.
    timeout: How long to wait for the transform, such as ``"100ms"``; None and 0 do not wait. Other Python
        threads run meanwhile.
    extrapolate: How far the lookup may extrapolate beyond the samples of an edge, such as ``"50ms"``, after
        waiting has not helped; None does not extrapolate, as tf2.
    hold: Whether extrapolation holds the last pose instead of continuing with the last twist.

Returns:
    A single transform: translation in metres, unit quaternion x, y, z, w, and the time of the lookup in
    ``stamp``. Its ``extrapolated`` is the length of the extrapolation in nanoseconds.

Raises:
    LookupException: A frame does not exist, or the tree contains a loop.
    ConnectivityException: The frames are in different trees.
    ExtrapolationException: An edge has no sample at that time.
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
  add_method(cls, "_set_values", &py_set_values,
             "_set_values($self, /, parent, child, stamp, x, y, z, qx, qy, qz, qw, static, authority)\n--\n\n"
             "Store a transform from numbers; return 0, or the reasons for refusal as bits (see insert_texts).");
  add_method(cls, "_set_plain", &py_set_plain,
             "_set_plain($self, /, parent, child, transform, stamp, static)\n--\n\n"
             "Do as _set_values() for a dynamic Transform between known frames; return None for any other case.");
  add_method(cls, "ingest", &py_ingest,
             "ingest($self, /, cdr, *, static=False, authority='no recorded authority')\n--\n\n"
             R"doc(Store the transforms of a serialized tf2_msgs/msg/TFMessage, all of them or none.

Args:
    cdr: The message as CDR bytes.
    static: Whether the transforms are static, as on /tf_static.
    authority: Name of the publisher, as reports show it.

Returns:
    The number of stored transforms.

Raises:
    DecodeError: The bytes are not a TFMessage; `statistics` counts such messages.)doc");
}

}  // namespace

void define_buffer(nb::module_& module) {
  using nb::arg;
  // None is accepted here, because the functions themselves report what a frame name or a stamp must be.
  const auto any = [](const char* name) { return nb::arg(name).none(); };
  nb::class_<BufferObject> cls(module, "Buffer",
                               "The native buffer; coframe.Buffer is the public class derived from it.",
                               nb::is_weak_referenceable());
  cls.def(nb::init<Stamp>(), arg("cache_ns"))
      .def_prop_ro(
          "cache_ns", [](const BufferObject& self) { return self.core->cache_length(); },
          R"doc(Length of the cache for dynamic transforms in nanoseconds; negative if the buffer keeps everything.)doc")
      .def("_lookup_full", &py_lookup_full, any("target"), any("target_stamp"), any("source"), any("source_stamp"),
           any("fixed"), nb::kw_only(), arg("timeout") = nb::none())
      .def("_lookup_rows", &lookup_rows, any("target"), any("source"), arg("stamps"), arg("poses"), any("twists"),
           any("beyond"), arg("on_error"), arg("threads"), arg("extrapolate") = nb::none(), arg("hold") = false)
      .def("_stamps_between", &stamps_between, any("target"), any("source"), arg("first"), arg("last"))
      .def("_set_rows", &set_rows, arg("parent"), arg("child"), arg("stamps"), arg("poses"), arg("static"),
           arg("authority"))
      .def("_can_transform_full", &py_can_transform_full, any("target"), any("target_stamp"), any("source"),
           any("source_stamp"), any("fixed"), nb::kw_only(), arg("timeout") = nb::none())
      .def("_why_not", &why_not, any("target"), any("source"), arg("stamp") = nb::none())
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
    TransformException: As :meth:`lookup`.)doc")
      .def(
          "encode", &encode, nb::kw_only(), arg("static"),
          R"doc(Return the newest sample of every static, or of every dynamic, frame as the CDR bytes of one TFMessage.)doc")
      .def(
          "clear",
          [](BufferObject& self) {
            self.stop_sharing();
            self.core->clear();
          },
          R"doc(Remove all dynamic samples; frames stay known, and static transforms stay, as in tf2.)doc")
      .def(
          "remove_frame",
          [](BufferObject& self, std::string_view name) {
            self.stop_sharing();
            return self.core->remove_frame(name);
          },
          arg("name"), R"doc(Remove a frame with the edges to its parent and to its children, also static ones.

Returns:
    Whether the frame existed.)doc")
      .def(
          "freeze",
          [](BufferObject& self) {
            self.stop_sharing();
            self.core->freeze();
          },
          R"doc(Make the buffer read-only: from now on it stores nothing and removes nothing.)doc")
      .def_prop_ro(
          "frozen", [](const BufferObject& self) { return self.core->frozen(); },
          R"doc(Whether the buffer is read-only.)doc")
      .def(
          "_become_snapshot", [](BufferObject& self, const BufferObject& other) { self.core = other.core->snapshot(); },
          arg("other"))
      .def("_stop_following", [](BufferObject& self) { self.core->stop_following(); })
      .def(
          "_on_local_change", [](BufferObject& self, nb::object call) { self.on_local_change = std::move(call); },
          any("call"))
      .def_prop_ro("_following", [](const BufferObject& self) { return self.core->following(); })
      .def("_frame_tuples", &frame_tuples)
      .def("_edge_at", &edge_at, arg("child"), arg("stamp"))
      .def("_edge_tuples", &edge_tuples, arg("children") = nb::none())
      .def(
          "frame_names", [](const BufferObject& self) { return self.core->frame_names(); },
          R"doc(Return the names of all frames in the order in which the buffer received them, a child before its parent.)doc")
      .def(
          "frame_exists",
          [](const BufferObject& self, std::string_view name) {
            return name == "NO_PARENT" || self.core->find(name) != 0;
          },
          arg("name"), R"doc(Return whether the buffer has received a transform that names the frame.)doc")
      .def(
          "all_frames_as_string", [](const BufferObject& self) { return self.core->read(frames_as_string); },
          R"doc(Return tf2's text of the tree, with one line per frame.)doc")
      .def(
          "all_frames_as_yaml", [](const BufferObject& self) { return self.core->read(frames_as_yaml); },
          R"doc(Return tf2's YAML of the tree; unlike in tf2, it is valid YAML for every frame name.)doc")
      .def(
          "all_frames_as_dot",
          [](const BufferObject& self, Stamp now) {
            return self.core->read([now](const Tree& tree) { return frames_as_dot(tree, now); });
          },
          arg("now") = 0, R"doc(Return tf2's graphviz text of the tree.

Args:
    now: Current time in nanoseconds, for ages and a legend; 0 omits them.)doc")
      .def_prop_ro(
          "statistics", &statistics,
          R"doc(Counters: ``messages``, ``malformed`` (ingested as bytes); ``stored``, ``refused``, ``old`` (transforms).)doc")
      .def_prop_ro("_changes", [](const BufferObject& self) { return self.core->changes(); });
  add_frequent_methods(cls);
  module.def(
      "register_buffer_class", [](nb::type_object_t<BufferObject> cls) { add_frequent_methods(cls); }, arg("cls"),
      "Add the most frequent methods to a subclass of Buffer as its own, because CPython calls methods of the "
      "object's own class faster.");
  module.def("insert_texts", &py_insert_texts, arg("refusals"), arg("parent"), arg("child"), arg("stamp"), arg("x"),
             arg("y"), arg("z"), arg("qx"), arg("qy"), arg("qz"), arg("qw"), arg("authority"),
             "Return tf2's log lines for a transform that _set_values rejected: (level, text).");
}

}  // namespace coframe::bindings
