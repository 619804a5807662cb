// SPDX-License-Identifier: Apache-2.0
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

inline Pose canonical_pose(const TransformValues& values) {
  Pose pose;
  for (int i = 0; i < 3; ++i) pose.p[i] = values.translation[i];
  for (int i = 0; i < 4; ++i) pose.q[i] = values.rotation[i];
  canonicalise(pose.q);
  return pose;
}

// tf2 checks the quaternion after normalising it, so only a quaternion that cannot be normalised is rejected, by both
// checks.
unsigned check_values(const Pose& pose) {
  const double sum = pose.q[0] + pose.p[0] + pose.p[1] + pose.p[2];
  if (sum == sum) return 0;  // otherwise one of them is NaN, or they are infinite
  unsigned refusals = 0;
  if (std::isnan(pose.q[0])) refusals |= kNan | kDenormalisedQuaternion;
  for (double value : pose.p) {
    if (std::isnan(value)) refusals |= kNan;
  }
  return refusals;
}

}  // namespace

void Frame::Counts::add(Insertion outcome) {
  switch (outcome) {
    case Insertion::repeated: repeated.add(1); break;
    case Insertion::refused_as_old: old.add(1); break;
    case Insertion::put_before_newer: late.add(1); [[fallthrough]];
    case Insertion::appended: stored.add(1); break;
  }
}

void Frame::Counts::refuse(unsigned refusals) {
  if (refusals & kSelfTransform) self.add(1);
  if (refusals & kNan) nan.add(1);
  if (refusals & kDenormalisedQuaternion) quaternion.add(1);
}

void Frame::Counts::copy(const Counts& other) {
  stored = other.stored.get();
  late = other.late.get();
  repeated = other.repeated.get();
  old = other.old.get();
  self = other.self.get();
  nan = other.nan.get();
  quaternion = other.quaternion.get();
}

Tree::Tree(Stamp cache_length) : cache_length_(cache_length), pool_(std::make_shared<ChunkPool>()) {
  frames_.append([](Frame& frame) { frame.name = "NO_PARENT"; });
  frame_numbers_.add("NO_PARENT", 0);
  authorities_.append([](std::string& name) { name = "no recorded authority"; });
}

Tree::Tree(const Tree& other) : cache_length_(other.cache_length_), memory_(other.memory_), pool_(other.pool_) {
  for (FrameId id = 0; id < other.frame_count(); ++id) {
    const Frame& theirs = other.frame(id);
    frames_.append([&](Frame& frame) {
      frame.name = theirs.name;
      frame.history.share(theirs.history);
      frame.authority = theirs.authority.get();
      frame.known = theirs.known.get();
      frame.counts.copy(theirs.counts);
    });
    frame_numbers_.add(theirs.name, id);
  }
  for (AuthorityId id = 0; id < other.authorities_.size(); ++id) {
    authorities_.append([&](std::string& name) { name = other.authorities_[id]; });
    authority_numbers_.add(other.authorities_[id], id);
  }
}

Tree::~Tree() {
  for (FrameId id = 0; id < frame_count(); ++id) frames_[id].history.release(*pool_);
}

std::uint32_t Tree::find_number(std::string_view name) const {
  return frame_numbers_.find(name, [this](FrameId id) { return std::string_view(frames_[id].name); });
}

FrameId Tree::find(std::string_view name) const {
  const std::uint32_t id = find_number(name);
  return id == NameTable::kNone || !frames_[id].known ? 0 : id;
}

FrameId Tree::find_or_add(std::string_view name, bool& is_new) {
  std::uint32_t id = find_number(name);
  if (id == NameTable::kNone) {
    id = static_cast<FrameId>(frames_.append([&](Frame& frame) { frame.name = name; }));
    frame_numbers_.add(name, id);
  }
  if (id != 0 && !frames_[id].known) {
    frames_[id].known = true;
    is_new = true;
  }
  return id;
}

Frame* Tree::restore_frame(std::string_view name) {
  if (find_number(name) != NameTable::kNone) return nullptr;
  const auto id = static_cast<FrameId>(frames_.append([&](Frame& frame) { frame.name = name; }));
  frame_numbers_.add(name, id);
  raise_version();
  return &frames_[id];
}

AuthorityId Tree::authority(std::string_view name) {
  const std::uint32_t found =
      authority_numbers_.find(name, [this](AuthorityId id) { return std::string_view(authorities_[id]); });
  if (found != NameTable::kNone) return found;
  const auto id = static_cast<AuthorityId>(authorities_.append([&](std::string& text) { text = name; }));
  authority_numbers_.add(name, id);
  return id;
}

Inserted Tree::insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                      bool is_static, AuthorityId authority) {
  const Pose pose = canonical_pose(values);
  Inserted inserted;
  inserted.refusals = check_values(pose) | check_names(parent, child);
  parent = without_slash(parent);
  child = without_slash(child);
  if (inserted.refusals != 0) {
    if (const FrameId id = find(child)) frames_[id].counts.refuse(inserted.refusals);
    return inserted;
  }
  const FrameId child_id = find_or_add(child, inserted.new_names);  // the child first: tf2's order of creation
  const FrameId parent_id = find_or_add(parent, inserted.new_names);
  store(frames_[child_id], child_id, stamp, {pose, parent_id}, is_static, authority, inserted);
  return inserted;
}

void Tree::insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                  AuthorityId authority, Inserted& inserted) {
  const Sample sample{canonical_pose(values), parent};
  Frame& frame = frames_[child];
  inserted = {};
  if (const unsigned refusals = check_values(sample.pose)) {
    frame.counts.refuse(refusals);
    inserted.refusals = refusals;
    return;
  }
  // The frames of a history with samples must be known.
  if (!is_static && frame.history.append_newer(context(), stamp, sample)) {
    frame.counts.add(Insertion::appended);
    frame.authority = authority;
    inserted.child = child;
    return;
  }
  know_again(child, frame, inserted);
  know_again(parent, frames_[parent], inserted);
  store(frame, child, stamp, sample, is_static, authority, inserted);
}

// The frame may have been removed since its id was found.
void Tree::know_again(FrameId id, Frame& frame, Inserted& inserted) {
  if (id == 0 || frame.known) return;
  frame.known = true;
  inserted.new_names = true;
}

unsigned check_names(std::string_view parent, std::string_view child) {
  parent = without_slash(parent);
  child = without_slash(child);
  unsigned refusals = 0;
  if (parent == child) refusals |= kSelfTransform;
  if (child.empty()) refusals |= kNoChildFrame;
  if (parent.empty()) refusals |= kNoParentFrame;
  return refusals;
}

unsigned check_values(const TransformValues& values) { return check_values(canonical_pose(values)); }

std::size_t Tree::append_run(std::string_view parent, std::string_view child, const Stamp* stamps, const double* rows,
                             std::size_t count, AuthorityId authority) {
  const FrameId child_id = find(without_slash(child)), parent_id = find(without_slash(parent));
  if (child_id == 0 || parent_id == 0 || child_id == parent_id) return 0;
  Frame& frame = frames_[child_id];
  const History::View before = frame.history.view();
  if (before.empty() || before.is_static() || before.parent() != parent_id) return 0;
  if (!frame.history.one_parent()) return 0;  // dropped samples may matter to waiters
  const std::size_t stored = frame.history.append_run(context(), stamps, rows, count, parent_id);
  if (stored == 0) return 0;
  frame.counts.stored.add(stored);
  frame.authority = authority;
  return stored;
}

void Tree::store(Frame& frame, FrameId child, Stamp stamp, const Sample& sample, bool is_static, AuthorityId authority,
                 Inserted& inserted) {
  History& history = frame.history;
  prepare(history, is_static, inserted);
  const History::View before = history.view();
  const bool had_one_parent = history.one_parent();
  const FrameId newest_before = before.parent(), oldest_before = had_one_parent ? 0 : before.parent_at(0);
  const Insertion outcome = history.insert(context(), stamp, sample);
  frame.counts.add(outcome);
  const History::View now = history.view();
  const bool changes_the_past = (outcome == Insertion::put_before_newer && !history.one_parent()) ||
                                (!had_one_parent && now.parent_at(0) != oldest_before);
  if (newest_before != 0 && (changes_the_past || now.parent() != newest_before)) inserted.rewired = true;
  if (outcome == Insertion::refused_as_old) {
    inserted.refusals = kOldData;
    return;
  }
  if (now.parent() != newest_before || history.one_parent() != had_one_parent) raise_version();
  frame.authority = authority;
  inserted.child = child;
}

// A frame that changes between static and dynamic loses its samples, as in tf2.
void Tree::prepare(History& history, bool is_static, Inserted& inserted) {
  const History::View before = history.view();
  if (before.exists() && before.is_static() == is_static) return;
  inserted.rewired = before.exists();
  history.reset(context(), is_static ? HistoryKind::fixed : HistoryKind::dynamic);
  raise_version();
}

void Tree::clear() {
  for (FrameId id = 0; id < frame_count(); ++id) frames_[id].history.clear(context());
  raise_version();
}

void Tree::remove(FrameId frame) {
  frames_[frame].known = false;
  frames_[frame].history.reset(context(), HistoryKind::none);
  for (FrameId id = 0; id < frame_count(); ++id) {
    if (frames_[id].history.mentions(frame)) frames_[id].history.reset(context(), HistoryKind::none);
  }
  raise_version();
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
    lines.push_back({true, format("TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id \"%s\" from "
                                  "authority \"%s\" because of an invalid quaternion in the transform (%f %f %f %f)",
                                  child_name.c_str(), who.c_str(), pose.q[0], pose.q[1], pose.q[2], pose.q[3])});
  }
  if (refusals & kTooManyFrames) {
    lines.push_back(
        {true, format("Ignoring transform for child_frame_id \"%s\" from authority \"%s\" because its frames "
                      "are new and the buffer has as many names as it stores from other nodes",
                      child_name.c_str(), who.c_str())});
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
