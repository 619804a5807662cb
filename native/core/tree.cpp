// SPDX-License-Identifier: Apache-2.0
#include "core/tree.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>

#include "core/back_off.hpp"
#include "core/error.hpp"
#include "core/unfinished_change.hpp"

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

// tf2 checks the quaternion after normalising it, so only a quaternion that cannot be normalized is rejected, by both
// checks.
unsigned check_values(const Pose& pose) {
  const double sum = pose.q[0] + pose.p[0] + pose.p[1] + pose.p[2];
  if (sum == sum) return 0;  // otherwise one of them is NaN, or they are infinite
  unsigned refusals = 0;
  if (std::isnan(pose.q[0])) refusals |= kNan | kDenormalizedQuaternion;
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
  if (refusals & kDenormalizedQuaternion) quaternion.add(1);
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

void TreeCounts::set(const Counts& counts) {
  messages = counts.messages;
  malformed = counts.malformed;
  stored = counts.stored;
  refused = counts.refused;
  old = counts.old;
  over_limit = counts.over_limit;
}

namespace {

// Frames and versions of data that replace others must not be mistaken for theirs.
std::uint64_t new_version() {
  static std::atomic<std::uint64_t> next{1};
  return next.fetch_add(1) << 40;
}

// Fills the entries of histories on the heap that have no chunk.
Chunk* no_chunk() {
  static Chunk chunk;
  return &chunk;
}

}  // namespace

void initialize(TreeData& data, Memory& memory, Stamp cache_length, std::uint64_t version) {
  data.cache_length = cache_length;
  data.version.store(version);
  data.revision.start_at(version);
  data.frames.append(memory, [&](Frame& frame) { frame.name.set(memory, "NO_PARENT"); });
  data.frame_numbers.add(memory, "NO_PARENT", 0);
  data.authorities.append(memory, [&](Name& name) { name.set(memory, "no recorded authority"); });
}

std::unique_ptr<Tree::Storage> Tree::heap_storage(std::shared_ptr<ChunkPool> pool, Stamp cache_length) {
  auto storage = std::make_unique<Storage>();
  storage->memory = std::make_shared<HeapMemory>();
  storage->pool = std::move(pool);
  storage->data = storage->memory->make<TreeData>();
  storage->parts.emplace(HistoryStorage{*storage->memory, *storage->pool, no_chunk(), nullptr});
  initialize(*storage->data, *storage->memory, cache_length, new_version());
  return storage;
}

std::unique_ptr<Tree::Storage> Tree::shared_storage(SharedTreeData shared) {
  auto storage = std::make_unique<Storage>();
  storage->memory = std::move(shared.memory);
  storage->data = shared.data;
  storage->shared = true;
  storage->access = std::move(shared.access);
  storage->keep(std::move(shared.mapped));
  storage->authority = std::move(shared.authority);
  if (!storage->memory) return storage;
  storage->pool = std::make_shared<ChunkPool>(*storage->memory, storage->data->chunks);
  if (!storage->data->nothing.load()) storage->data->nothing.store(storage->memory->make<Chunk>());
  storage->parts.emplace(
      HistoryStorage{*storage->memory, *storage->pool, storage->data->nothing.load(), &storage->data->interrupted});
  return storage;
}

void Tree::use(std::unique_ptr<Storage> storage) {
  storages_.push_back(std::move(storage));
  storage_.store(storages_.back().get(), std::memory_order_release);
  data_.store(storages_.back()->data, std::memory_order_release);
}

Tree::Tree(Stamp cache_length) { use(heap_storage(std::make_shared<ChunkPool>(), cache_length)); }

Tree::Tree(SharedTreeData shared) { use(shared_storage(std::move(shared))); }

Tree::Tree(const Tree& other) {
  const bool with_samples = other.shared();
  use(heap_storage(with_samples ? std::make_shared<ChunkPool>() : other.storage().pool, other.cache_length()));
  if (!with_samples) keep(other.storage().mapped);
  copy_from(other, with_samples);
  along_screws_ = other.along_screws_;
}

Tree::~Tree() {
  for (const auto& storage : storages_) {
    if (storage->shared) continue;
    TreeData& tree = *storage->data;
    for (FrameId id = 0; id < tree.frames.size(); ++id) tree.frames[id].history.release(storage->histories());
  }
}

void Tree::switch_to(SharedTreeData shared) { use(shared_storage(std::move(shared))); }

bool Tree::become_private() {
  try {
    Tree copy(*this);
    use(std::move(copy.storages_.back()));
    copy.storages_.clear();
    return true;
  } catch (const LostMemory&) {
    return false;
  }
}

// The writer is another process, which cannot be locked out, and which may change the tree faster than all samples of a
// frame can be copied. Then the oldest ones are left out, and finally all.
void Tree::copy_shared(History& history, const Tree& other, FrameId id) {
  constexpr int kComplete = 20, kMaxAttempts = 10'000;  // attempts
  std::size_t max_samples = SIZE_MAX;
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    const std::uint64_t revision = other.start_reading();
    if (attempt >= kComplete)
      max_samples = std::max<std::size_t>(std::min(max_samples, other.history(id).size()) / 2, 1);
    history.copy(context(), other.frame(id).history, max_samples);
    if (other.unchanged(revision)) return;
    history.reset(context(), HistoryKind::none);
  }
}

void Tree::copy_from(const Tree& other, bool with_samples) {
  TreeData& tree = data();
  Memory& memory = *storage().memory;
  const auto copy = [&](Frame& frame, const Frame& other_frame, FrameId id) {
    if (with_samples) {
      copy_shared(frame.history, other, id);
    } else {
      frame.history.share(storage().histories(), other_frame.history);
    }
    frame.authority = other_frame.authority.get();
    frame.known = other_frame.known.get();
    frame.counts.copy(other_frame.counts);
  };
  copy(tree.frames[0], other.frame(0), 0);
  // Samples that were copied can have frames that are added in the meantime.
  for (FrameId id = 1; id < other.frame_count(); ++id) {
    const Frame& other_frame = other.frame(id);
    tree.frames.append(memory, [&](Frame& frame) {
      frame.name.set(memory, other_frame.name);
      copy(frame, other_frame, id);
    });
    tree.frame_numbers.add(memory, other_frame.name, id);
  }
  for (AuthorityId id = 1; id < other.authority_count(); ++id) {
    const std::string name = other.authority_name(id);
    tree.authorities.append(memory, [&](Name& copy) { copy.set(memory, name); });
    tree.authority_numbers.add(memory, name, id);
  }
  tree.counts.set(other.counts().get());
}

std::uint64_t Tree::wait_for_writer() const {
  constexpr int kPatience = 600;  // turns, about 5 ms: a writer that lives is faster, unless it is suspended
  const auto start = std::chrono::steady_clock::now();
  for (int turn = 0;; ++turn) {
    check_memory();
    const std::uint64_t now = data().revision.number();
    if (now % 2 == 0) return now;
    back_off(turn);
    if (turn < kPatience || turn % 16 != 0 || (access() && access()->complete_change())) continue;
    if ((std::chrono::steady_clock::now() - start) / std::chrono::nanoseconds(1) < ChangeTimeout::current()) continue;
    throw UnfinishedChange(access() ? access()->unfinished_change()
                                    : "a thread of this process is suspended in the middle of a change of the buffer");
  }
}

bool Tree::has_room_for_names(std::size_t bytes) {
  // The tables and the vector of the frames double their size at most.
  constexpr std::size_t kPerFrame = 2 * (sizeof(Frame) + sizeof(Name) + 64), kFixed = 64 * kPerFrame;
  return storage().memory->has_room(kFixed + kPerFrame * frame_count() + 2 * bytes);
}

// If there is no room, the longest history loses its oldest samples.
bool Tree::make_room(const History& history) {
  const HistoryStorage& parts = storage().histories();
  while (!history.has_room(parts)) {
    History* longest_history = nullptr;
    std::uint64_t max_chunks = 1;
    for (FrameId id = 0; id < frame_count(); ++id) {
      History& other = data().frames[id].history;
      if (other.chunk_count() > max_chunks) {
        max_chunks = other.chunk_count();
        longest_history = &other;
      }
    }
    if (!longest_history) return false;
    longest_history->drop_oldest_chunk(parts.pool);
  }
  return true;
}

void Tree::recover() {
  TreeData& tree = data();
  if (History* history = tree.interrupted.history.load()) history->complete(context(), tree.interrupted);
  storage().pool->rebuild([&] {
    for (FrameId id = 0; id < frame_count(); ++id) tree.frames[id].history.hold_chunks();
  });
  for (FrameId id = 0; id < frame_count(); ++id) tree.frames[id].history.repair();
  tree.interrupted.kind.store(Interrupted::Kind::none);
  raise_version();
  tree.revision.complete();
}

std::uint32_t Tree::find_number(std::string_view name) const {
  const TreeData& tree = data();
  return tree.frame_numbers.find(name, [&tree](FrameId id) { return tree.frames[id].name.view(); });
}

FrameId Tree::find(std::string_view name) const {
  const std::uint32_t id = find_number(name);
  return id == NameTable::kNone || !frame(id).known ? 0 : id;
}

FrameId Tree::add_frame(std::string_view name) {
  TreeData& tree = data();
  Memory& memory = *storage().memory;
  const std::size_t id = tree.frames.append(memory, [&](Frame& frame) { frame.name.set(memory, name); });
  tree.frame_numbers.add(memory, name, static_cast<FrameId>(id));
  return static_cast<FrameId>(id);
}

FrameId Tree::find_or_add(std::string_view name, bool& is_new) {
  std::uint32_t id = find_number(name);
  if (id == NameTable::kNone) {
    id = add_frame(name);
  }
  Frame& frame = data().frames[id];
  if (id != 0 && !frame.known) {
    frame.known = true;
    is_new = true;
  }
  return id;
}

Frame* Tree::restore_frame(std::string_view name) {
  if (find_number(name) != NameTable::kNone) return nullptr;
  const FrameId id = add_frame(name);
  raise_version();
  return &data().frames[id];
}

AuthorityId Tree::authority(std::string_view name) {
  TreeData& tree = data();
  Memory& memory = *storage().memory;
  const std::uint32_t found =
      tree.authority_numbers.find(name, [&](AuthorityId id) { return tree.authorities[id].view(); });
  if (found != NameTable::kNone) return found;
  if (!has_room_for_names(name.size())) return 0;
  const std::size_t id = tree.authorities.append(memory, [&](Name& text) { text.set(memory, name); });
  tree.authority_numbers.add(memory, name, static_cast<AuthorityId>(id));
  return static_cast<AuthorityId>(id);
}

Inserted Tree::insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                      bool is_static, AuthorityId authority) {
  const Pose pose = canonical_pose(values);
  Inserted inserted;
  inserted.refusals = check_values(pose) | check_names(parent, child);
  parent = without_slash(parent);
  child = without_slash(child);
  if (inserted.refusals != 0) {
    if (const FrameId id = find(child)) data().frames[id].counts.refuse(inserted.refusals);
    return inserted;
  }
  const FrameId child_id = find_or_add(child, inserted.new_names);  // the child first: tf2's order of creation
  const FrameId parent_id = find_or_add(parent, inserted.new_names);
  store(data().frames[child_id], child_id, stamp, {pose, parent_id}, is_static, authority, inserted);
  return inserted;
}

void Tree::insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                  AuthorityId authority, Inserted& inserted) {
  const Sample sample{canonical_pose(values), parent};
  Frame& frame = data().frames[child];
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
  restore_known(child, frame, inserted);
  restore_known(parent, data().frames[parent], inserted);
  store(frame, child, stamp, sample, is_static, authority, inserted);
}

// The frame may have been removed since its id was found.
void Tree::restore_known(FrameId id, Frame& frame, Inserted& inserted) {
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
  if (child_id == 0 || parent_id == 0 || child_id == parent_id || shared()) return 0;
  Frame& frame = data().frames[child_id];
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
  if (!is_static && shared() && !make_room(history)) {
    inserted.refusals = kTooManyFrames;
    return;
  }
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
  for (FrameId id = 0; id < frame_count(); ++id) data().frames[id].history.clear(context());
  raise_version();
}

void Tree::remove(FrameId frame) {
  data().frames[frame].known = false;
  data().frames[frame].history.reset(context(), HistoryKind::none);
  for (FrameId id = 0; id < frame_count(); ++id) {
    if (data().frames[id].history.mentions(frame)) data().frames[id].history.reset(context(), HistoryKind::none);
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
  if (refusals & kDenormalizedQuaternion) {
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
                                   child_name.c_str(), to_seconds(stamp), who.c_str())});
  }
  return lines;
}

}  // namespace coframe
