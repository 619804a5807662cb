#include "bindings/buffer.hpp"

#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include "bindings/bindings.hpp"
#include "bindings/failure.hpp"
#include "bindings/transform.hpp"
#include "core/dump.hpp"

namespace coframe::bindings {

namespace {

nb::handle time_module;  // coframe.time: what is neither int nor None is converted there

std::string_view text(nb::handle name) {
  if (!PyUnicode_Check(name.ptr())) {
    PyErr_Format(PyExc_TypeError, "a frame name must be str, not %s", Py_TYPE(name.ptr())->tp_name);
    throw nb::python_error();
  }
  Py_ssize_t size;
  const char* data = PyUnicode_AsUTF8AndSize(name.ptr(), &size);
  if (!data) throw nb::python_error();
  return {data, static_cast<std::size_t>(size)};
}

std::int64_t to_int64(nb::handle number) {
  int overflow;
  const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
  if (overflow != 0) {
    PyErr_Format(PyExc_OverflowError, "%R does not fit 64-bit nanoseconds, which reach from 1677 to 2262",
                 number.ptr());
  }
  if (PyErr_Occurred()) throw nb::python_error();
  return value;
}

Stamp to_stamp(nb::handle stamp) {
  if (stamp.is_none()) return 0;
  if (PyLong_CheckExact(stamp.ptr())) return to_int64(stamp);
  const CallingPython call;
  return to_int64(time_module.attr("stamp_ns")(stamp));
}

std::int64_t to_duration(nb::handle duration) {
  if (duration.is_none()) return 0;
  const CallingPython call;
  return to_int64(time_module.attr("duration_ns")(duration));
}

// One question to the buffer: two frames, by name and, once they exist, by number.
struct Leg {
  BufferObject& buffer;
  nb::handle target, source;
  std::string_view target_name, source_name;
  FrameId target_id = 0, source_id = 0;

  Leg(BufferObject& buffer, nb::handle target, nb::handle source)
      : buffer(buffer), target(target), source(source) {
    target_id = buffer.names.find(target.ptr(), *buffer.core);
    source_id = buffer.names.find(source.ptr(), *buffer.core);
    target_name = text(target);
    source_name = text(source);
  }
};

bool fail_name(ErrorCode code, Argument argument, std::string_view name, Failure& failure) {
  failure = Failure{};
  failure.code = code;
  failure.argument = argument;
  failure.name = name;
  return false;
}

// A frame's number, or a failure that says what is wrong with its name. Needs no GIL.
bool resolve(const Buffer& buffer, std::string_view name, Argument argument, FrameId& frame, Failure& failure) {
  if (name.empty()) return fail_name(ErrorCode::empty_name, argument, name, failure);
  if (name.front() == '/') return fail_name(ErrorCode::leading_slash, argument, name, failure);
  if (frame == 0) frame = buffer.find(name);
  return frame != 0 || fail_name(ErrorCode::unknown_frame, argument, name, failure);
}

bool lookup(Leg& leg, Stamp& stamp, Pose& pose, Failure& failure) {
  const Buffer& buffer = *leg.buffer.core;
  if (leg.target_id == leg.source_id && leg.target_name == leg.source_name) {
    if (leg.target_id != 0) return buffer.lookup(leg.target_id, leg.source_id, stamp, pose, failure);
    pose = Pose{};  // any frame seen from itself, even one that nobody knows
    return true;
  }
  return resolve(buffer, leg.target_name, Argument::target_frame, leg.target_id, failure) &&
         resolve(buffer, leg.source_name, Argument::source_frame, leg.source_id, failure) &&
         buffer.lookup(leg.target_id, leg.source_id, stamp, pose, failure);
}

// Two legs over a fixed frame, each at its own time.
struct FullQuery {
  Leg leg;
  nb::handle fixed;
  std::string_view fixed_name;
  FrameId fixed_id;

  FullQuery(BufferObject& buffer, nb::handle target, nb::handle source, nb::handle fixed)
      : leg(buffer, target, source),
        fixed(fixed),
        fixed_name(text(fixed)),
        fixed_id(buffer.names.find(fixed.ptr(), *buffer.core)) {}

  bool resolve_names(Failure& failure) {
    const Buffer& buffer = *leg.buffer.core;
    return resolve(buffer, leg.target_name, Argument::target_frame, leg.target_id, failure) &&
           resolve(buffer, leg.source_name, Argument::source_frame, leg.source_id, failure) &&
           resolve(buffer, fixed_name, Argument::fixed_frame, fixed_id, failure);
  }
};

bool lookup_full(FullQuery& query, Stamp& target_stamp, Stamp source_stamp, Pose& pose, Failure& failure) {
  return query.resolve_names(failure) &&
         query.leg.buffer.core->lookup_full(query.leg.target_id, target_stamp, query.leg.source_id, source_stamp,
                                            query.fixed_id, pose, failure);
}

// Whether, not where: the target's leg is checked first here, as tf2 does.
bool can_transform_full(FullQuery& query, Stamp target_stamp, Stamp source_stamp, Failure& failure) {
  const Buffer& buffer = *query.leg.buffer.core;
  Pose pose;
  return query.resolve_names(failure) &&
         buffer.lookup(query.leg.target_id, query.fixed_id, target_stamp, pose, failure) &&
         buffer.lookup(query.fixed_id, query.leg.source_id, source_stamp, pose, failure);
}

// Tries now, and then after every change of the buffer until it works or the time is over.
template <class Try>
bool try_until(const Buffer& buffer, std::int64_t timeout_ns, Try&& attempt) {
  if (attempt()) return true;
  if (timeout_ns <= 0) return false;
  std::uint64_t seen = buffer.changes();
  if (attempt()) return true;  // what arrived between the two is not missed
  return wait_with_signals(timeout_ns, [&](std::int64_t slice) {
    if (!buffer.wait_for_change(seen, slice)) return false;
    seen = buffer.changes();
    return attempt();
  });
}

nb::object py_lookup(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamp,
                     nb::handle timeout) {
  Leg leg(self, target, source);
  const Stamp asked = to_stamp(stamp);
  Stamp found = asked;
  Pose pose;
  Failure failure;
  const bool ok = try_until(*self.core, to_duration(timeout), [&] {
    found = asked;
    return lookup(leg, found, pose, failure);
  });
  if (!ok) return raise_failure({std::move(failure), self.core, nb::borrow(target), nb::borrow(source)});
  return make_transform(pose, found, target, source);
}

nb::object py_lookup_full(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                          nb::handle source_stamp, nb::handle fixed, nb::handle timeout) {
  FullQuery query(self, target, source, fixed);
  const Stamp target_time = to_stamp(target_stamp), source_time = to_stamp(source_stamp);
  Stamp found = target_time;
  Pose pose;
  Failure failure;
  const bool ok = try_until(*self.core, to_duration(timeout), [&] {
    found = target_time;
    return lookup_full(query, found, source_time, pose, failure);
  });
  if (!ok) return raise_failure({std::move(failure), self.core, nb::borrow(target), nb::borrow(source)});
  return make_transform(pose, found, target, source);
}

bool can_transform(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamp, nb::handle timeout,
                   Failure& failure) {
  Leg leg(self, target, source);
  const Stamp asked = to_stamp(stamp);
  return try_until(*self.core, to_duration(timeout), [&] {
    Stamp found = asked;
    Pose pose;
    return lookup(leg, found, pose, failure);
  });
}

bool can_transform_full(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                        nb::handle source_stamp, nb::handle fixed, nb::handle timeout, Failure& failure) {
  FullQuery query(self, target, source, fixed);
  const Stamp target_time = to_stamp(target_stamp), source_time = to_stamp(source_stamp);
  return try_until(*self.core, to_duration(timeout),
                   [&] { return can_transform_full(query, target_time, source_time, failure); });
}

std::string why_not(BufferObject& self, nb::handle target, nb::handle source, nb::handle stamp) {
  Failure failure;
  if (can_transform(self, target, source, stamp, nb::none(), failure)) return "";
  return text_of({std::move(failure), self.core, {}, {}, Speaker::can_transform});
}

std::string why_not_full(BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
                         nb::handle source_stamp, nb::handle fixed) {
  Failure failure;
  if (can_transform_full(self, target, target_stamp, source, source_stamp, fixed, nb::none(), failure)) return "";
  return text_of({std::move(failure), self.core, {}, {}, Speaker::can_transform});
}

nb::object py_latest_common_time(BufferObject& self, nb::handle target, nb::handle source) {
  Leg leg(self, target, source);
  Failure failure;
  Stamp stamp = 0;
  const Buffer& buffer = *self.core;
  const bool ok = resolve(buffer, leg.target_name, Argument::target_frame, leg.target_id, failure) &&
                  resolve(buffer, leg.source_name, Argument::source_frame, leg.source_id, failure) &&
                  buffer.latest_common_time(leg.target_id, leg.source_id, stamp, failure);
  if (!ok) {
    return raise_failure(
        {std::move(failure), self.core, nb::borrow(target), nb::borrow(source), Speaker::latest_common_time});
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
  bool ok = source_id == 0
                ? fail_name(ErrorCode::unknown_frame, Argument::source_frame, text(source), failure)
                : buffer.chain(fixed_id, source_id, source_time, frames, failure);
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

unsigned set_values(BufferObject& self, nb::handle parent, nb::handle child, Stamp stamp, double x, double y, double z,
                    double qx, double qy, double qz, double qw, bool is_static, std::string_view authority) {
  return self.core->insert(text(parent), text(child), stamp, {{x, y, z}, {qx, qy, qz, qw}}, is_static, authority);
}

nb::list py_insert_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp, double x,
                         double y, double z, double qx, double qy, double qz, double qw, std::string_view authority) {
  nb::list lines;
  for (const LogLine& line :
       refusal_texts(refusals, parent, child, stamp, {{x, y, z}, {qx, qy, qz, qw}}, authority)) {
    lines.append(nb::make_tuple(line.is_error ? "error" : "warning", line.text));
  }
  return lines;
}

// Any object with the buffer protocol, held while its bytes are read.
class Bytes {
 public:
  explicit Bytes(nb::handle object) {
    if (PyObject_GetBuffer(object.ptr(), &view_, PyBUF_SIMPLE) != 0) throw nb::python_error();
  }
  Bytes(const Bytes&) = delete;
  Bytes& operator=(const Bytes&) = delete;
  ~Bytes() { PyBuffer_Release(&view_); }
  const std::uint8_t* data() const { return static_cast<const std::uint8_t*>(view_.buf); }
  std::size_t size() const { return static_cast<std::size_t>(view_.len); }

 private:
  Py_buffer view_;
};

std::size_t ingest(BufferObject& self, nb::handle message, bool is_static, std::string authority) {
  const Bytes bytes(message);
  const std::pair<bool, std::string> key(is_static, std::move(authority));
  auto stream = self.streams.find(key);
  if (stream == self.streams.end()) {
    stream = self.streams.emplace(key, self.core->open_stream(is_static, key.second)).first;
  }
  std::size_t stored;
  const DecodeFailure failure = self.core->ingest(stream->second, bytes.data(), bytes.size(), stored);
  if (failure.reason) raise_decode_error(failure);
  return stored;
}

nb::list frame_tuples(const BufferObject& self) {
  nb::list frames;
  for (const FrameSummary& f : self.core->frames()) {
    frames.append(nb::make_tuple(f.name, f.parent, f.is_static, f.samples, f.oldest, f.newest, f.rate, f.authority));
  }
  return frames;
}

nb::dict statistics(const BufferObject& self) {
  const Counts counts = self.core->counts();
  nb::dict named;
  named["messages"] = counts.messages;
  named["malformed"] = counts.malformed;
  named["stored"] = counts.stored;
  named["refused"] = counts.refused;
  named["old"] = counts.old;
  return named;
}

nb::bytes encode(const BufferObject& self, bool is_static) {
  const std::string message = self.core->encode(is_static);
  return nb::bytes(message.data(), message.size());
}

}  // namespace

FrameId NameCache::find(PyObject* name, const Buffer& buffer) {
  Entry& entry = entries_[(reinterpret_cast<std::uintptr_t>(name) >> 4) % entries_.size()];
  if (entry.name == name) return entry.frame;
  const FrameId frame = buffer.find(text(name));
  // Letting go of an instance of a subclass could run any code.
  if (frame != 0 && PyUnicode_CheckExact(name)) {
    Py_INCREF(name);
    Py_XDECREF(std::exchange(entry.name, name));
    entry.frame = frame;
  }
  return frame;
}

void define_buffer(nb::module_& module) {
  using nb::arg;
  // None is let through: what a frame name or a stamp must be is said by the functions themselves.
  const auto any = [](const char* name) { return nb::arg(name).none(); };
  nb::class_<BufferObject>(module, "Buffer", "The native buffer; coframe.Buffer is the public class on top of it.",
                           nb::is_weak_referenceable())
      .def(nb::init<Stamp>(), arg("cache_ns"))
      .def_prop_ro("cache_ns", [](const BufferObject& self) { return self.core->cache_length(); })
      .def("lookup", &py_lookup, any("target"), any("source"), arg("stamp") = nb::none(), nb::kw_only(),
           arg("timeout") = nb::none())
      .def("lookup_full", &py_lookup_full, any("target"), any("target_stamp"), any("source"),
           any("source_stamp"), any("fixed"), nb::kw_only(), arg("timeout") = nb::none())
      .def(
          "can_transform",
          [](BufferObject& self, nb::handle target, nb::handle source, nb::handle stamp, nb::handle timeout) {
            Failure failure;
            return can_transform(self, target, source, stamp, timeout, failure);
          },
          any("target"), any("source"), arg("stamp") = nb::none(), nb::kw_only(), arg("timeout") = nb::none())
      .def(
          "can_transform_full",
          [](BufferObject& self, nb::handle target, nb::handle target_stamp, nb::handle source,
             nb::handle source_stamp, nb::handle fixed, nb::handle timeout) {
            Failure failure;
            return can_transform_full(self, target, target_stamp, source, source_stamp, fixed, timeout, failure);
          },
          any("target"), any("target_stamp"), any("source"), any("source_stamp"), any("fixed"),
          nb::kw_only(), arg("timeout") = nb::none())
      .def("why_not", &why_not, any("target"), any("source"), arg("stamp") = nb::none())
      .def("why_not_full", &why_not_full, any("target"), any("target_stamp"), any("source"),
           any("source_stamp"), any("fixed"))
      .def("latest_common_time", &py_latest_common_time, any("target"), any("source"))
      .def("chain", &py_chain, any("target"), any("target_stamp"), any("source"), any("source_stamp"),
           any("fixed"))
      .def("set_values", &set_values, any("parent"), any("child"), arg("stamp"), arg("x"), arg("y"), arg("z"),
           arg("qx"), arg("qy"), arg("qz"), arg("qw"), arg("static"), arg("authority"))
      .def("ingest", &ingest, arg("cdr"), nb::kw_only(), arg("static") = false,
           arg("authority") = "no recorded authority")
      .def("encode", &encode, nb::kw_only(), arg("static"))
      .def("clear", [](BufferObject& self) { self.core->clear(); })
      .def("frame_tuples", &frame_tuples)
      .def("frame_names", [](const BufferObject& self) { return self.core->frame_names(); })
      .def("frame_exists",
           [](const BufferObject& self, std::string_view name) {
             return name == "NO_PARENT" || self.core->find(name) != 0;
           },
           arg("name"))
      .def("all_frames_as_string", [](const BufferObject& self) { return self.core->read(frames_as_string); })
      .def("all_frames_as_yaml", [](const BufferObject& self) { return self.core->read(frames_as_yaml); })
      .def(
          "all_frames_as_dot",
          [](const BufferObject& self, Stamp now) {
            return self.core->read([now](const Tree& tree) { return frames_as_dot(tree, now); });
          },
          arg("now") = 0)
      .def_prop_ro("statistics", &statistics)
      .def_prop_ro("changes", [](const BufferObject& self) { return self.core->changes(); })
      .def(
          "wait_for_change",
          [](BufferObject& self, std::uint64_t seen, std::int64_t timeout_ns) {
            wait_with_signals(timeout_ns,
                              [&](std::int64_t slice) { return self.core->wait_for_change(seen, slice); });
            return self.core->changes();
          },
          arg("seen"), arg("timeout_ns"));
  module.def("insert_texts", &py_insert_texts, arg("refusals"), arg("parent"), arg("child"), arg("stamp"), arg("x"),
             arg("y"), arg("z"), arg("qx"), arg("qy"), arg("qz"), arg("qw"), arg("authority"),
             "tf2's log lines for a transform that set_values refused: (level, text).");
  module.def(
      "register_time", [](nb::object time) { time_module = time.release(); }, arg("time"),
      "Stamps and durations that are not int are converted by this module.");
}

}  // namespace coframe::bindings
