#include "core/tree.hpp"

#include <cmath>
#include <cstdio>

#include "core/error.hpp"

namespace coframe {

namespace {

template <class... Values>
std::string format(const char* pattern, Values... values) {
  const int length = std::snprintf(nullptr, 0, pattern, values...);
  std::string text(static_cast<std::size_t>(length), '\0');
  std::snprintf(text.data(), text.size() + 1, pattern, values...);
  return text;
}

Pose canonical_pose(const TransformValues& values) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.p[i] = values.translation[i];
  for (int i = 0; i < 4; ++i) pose.q[i] = values.rotation[i];
  canonicalise(pose.q);
  return pose;
}

// tf2 checks the quaternion after normalising it: only what cannot be normalised is refused, and by both rules.
unsigned check_values(const Pose& pose) {
  unsigned refusals = 0;
  if (std::isnan(pose.q[0])) refusals |= kNan | kDenormalisedQuaternion;
  for (double value : pose.p) {
    if (std::isnan(value)) refusals |= kNan;
  }
  return refusals;
}

}  // namespace

Tree::Tree(Stamp cache_length) : cache_length_(cache_length) {
  frames_.emplace_back().name = "NO_PARENT";
  frame_ids_.emplace("NO_PARENT", 0);
  authorities_.emplace_back("no recorded authority");
}

FrameId Tree::find(std::string_view name) const {
  const auto found = frame_ids_.find(name);
  return found == frame_ids_.end() ? 0 : found->second;
}

FrameId Tree::find_or_add(std::string_view name) {
  const auto found = frame_ids_.find(name);
  if (found != frame_ids_.end()) return found->second;
  const auto id = static_cast<FrameId>(frames_.size());
  frames_.emplace_back().name = name;
  frame_ids_.emplace(name, id);
  return id;
}

AuthorityId Tree::authority(std::string_view name) {
  const auto found = authority_ids_.find(name);
  if (found != authority_ids_.end()) return found->second;
  const auto id = static_cast<AuthorityId>(authorities_.size());
  authorities_.emplace_back(name);
  authority_ids_.emplace(name, id);
  return id;
}

unsigned Tree::insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                      bool is_static, AuthorityId authority) {
  parent = without_slash(parent);
  child = without_slash(child);
  const Pose pose = canonical_pose(values);
  unsigned refusals = check_values(pose);
  if (parent == child) refusals |= kSelfTransform;
  if (child.empty()) refusals |= kNoChildFrame;
  if (parent.empty()) refusals |= kNoParentFrame;
  if (refusals != 0) return refusals;
  const FrameId child_id = find_or_add(child);  // the child first: tf2's order of creation
  const FrameId parent_id = find_or_add(parent);
  return store(parent_id, child_id, stamp, pose, is_static, authority);
}

unsigned Tree::insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                      AuthorityId authority) {
  const Pose pose = canonical_pose(values);
  const unsigned refusals = check_values(pose);
  return refusals != 0 ? refusals : store(parent, child, stamp, pose, is_static, authority);
}

unsigned Tree::store(FrameId parent, FrameId child, Stamp stamp, const Pose& pose, bool is_static,
                     AuthorityId authority) {
  History& history = history_of(child, is_static);
  const FrameId parent_before = history.parent();
  const bool one_parent_before = history.one_parent();
  if (!history.insert(stamp, Sample{pose, parent})) return kOldData;
  if (history.parent() != parent_before || history.one_parent() != one_parent_before) ++version_;
  frames_[child].authority = authority;
  return 0;
}

// A frame that changes between static and dynamic starts anew, as in tf2.
History& Tree::history_of(FrameId child, bool is_static) {
  std::unique_ptr<History>& history = frames_[child].history;
  if (!history || history->is_static() != is_static) {
    history = std::make_unique<History>(is_static, cache_length_);
    ++version_;
  }
  return *history;
}

void Tree::clear() {
  for (Frame& frame : frames_) {
    if (frame.history) frame.history->clear();
  }
  ++version_;
}

std::vector<LogLine> refusal_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp,
                                   const TransformValues& values, std::string_view authority) {
  const std::string parent_name(without_slash(parent)), child_name(without_slash(child)), who(authority);
  const Pose pose = canonical_pose(values);
  const auto numbers = [&](const char* pattern) {
    return format(pattern, child_name.c_str(), who.c_str(), pose.p[0], pose.p[1], pose.p[2], pose.q[0], pose.q[1],
                  pose.q[2], pose.q[3]);
  };
  std::vector<LogLine> lines;
  if (refusals & kSelfTransform) {
    lines.push_back({true, format("TF_SELF_TRANSFORM: Ignoring transform from authority \"%s\" with frame_id and  "
                                  "child_frame_id \"%s\" because they are the same",
                                  who.c_str(), child_name.c_str())});
  }
  if (refusals & kNoChildFrame) {
    lines.push_back({true, format("TF_NO_CHILD_FRAME_ID: Ignoring transform from authority \"%s\" because "
                                  "child_frame_id not set ",
                                  who.c_str())});
  }
  if (refusals & kNoParentFrame) {
    lines.push_back({true, format("TF_NO_FRAME_ID: Ignoring transform with child_frame_id \"%s\"  from authority "
                                  "\"%s\" because frame_id not set",
                                  child_name.c_str(), who.c_str())});
  }
  if (refusals & kNan) {
    lines.push_back({true, numbers("TF_NAN_INPUT: Ignoring transform for child_frame_id \"%s\" from authority \"%s\" "
                                   "because of a nan value in the transform (%f %f %f) (%f %f %f %f)")});
  }
  if (refusals & kDenormalisedQuaternion) {
    lines.push_back({true, numbers("TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id \"%s\" from "
                                   "authority \"%s\" because of an invalid quaternion in the transform "
                                   "(%f %f %f) (%f %f %f %f)")});
  }
  if (refusals & kOldData) {
    lines.push_back({false, format("TF_OLD_DATA ignoring data from the past for frame %s at time %.6f according to "
                                   "authority %s\nPossible reasons are listed at "
                                   "http://wiki.ros.org/tf/Errors%%20explained",
                                   child_name.c_str(), static_cast<double>(stamp) * 1e-9, who.c_str())});
  }
  return lines;
}

}  // namespace coframe
