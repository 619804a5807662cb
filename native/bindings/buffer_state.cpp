// SPDX-License-Identifier: Apache-2.0
// What a buffer contains: frames, edges, counters, and tf2's texts of the tree.
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <optional>
#include <set>

#include "bindings/bindings.hpp"
#include "bindings/buffer_parts.hpp"
#include "core/dump.hpp"

namespace coframe::bindings {

namespace {

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

}  // namespace

void define_state(nb::class_<BufferObject>& cls) {
  cls.def("_frame_tuples", &frame_tuples)
      .def("_edge_at", &edge_at, nb::arg("child"), nb::arg("stamp"))
      .def("_edge_tuples", &edge_tuples, nb::arg("children") = nb::none())
      .def(
          "frame_names", [](const BufferObject& self) { return self.core->frame_names(); },
          R"doc(Return the names of all frames in the order in which the buffer received them, a child before its parent.)doc")
      .def(
          "frame_exists",
          [](const BufferObject& self, std::string_view name) {
            return name == "NO_PARENT" || self.core->find(name) != 0;
          },
          nb::arg("name"), R"doc(Return whether the buffer has received a transform that names the frame.)doc")
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
          nb::arg("now") = 0, R"doc(Return tf2's graphviz text of the tree.

Args:
    now: Current time in nanoseconds, for ages and a legend; 0 omits them.)doc")
      .def_prop_ro(
          "statistics", &statistics,
          R"doc(Counters: ``messages``, ``malformed`` (ingested as bytes); ``stored``, ``refused``, ``old`` (transforms).)doc");
}

}  // namespace coframe::bindings
