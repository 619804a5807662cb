#include "core/buffer.hpp"

#include <chrono>

#include "core/dump.hpp"

namespace coframe {

unsigned Buffer::insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                        bool is_static, std::string_view authority) {
  unsigned refusals;
  {
    WriteLock lock(mutex_);
    refusals = tree_.insert(parent, child, stamp, values, is_static, tree_.authority(authority));
    count(refusals);
  }
  notify();
  return refusals;
}

TransformStream Buffer::open_stream(bool is_static, std::string_view authority) {
  WriteLock lock(mutex_);
  TransformStream stream;
  stream.is_static = is_static;
  stream.authority = tree_.authority(authority);
  return stream;
}

void Buffer::rename(TransformStream& stream, std::string_view authority) {
  WriteLock lock(mutex_);
  const AuthorityId before = stream.authority;
  stream.authority = tree_.authority(authority);
  for (const TransformStream::Names& names : stream.expected) {
    tree_.change_authority(names.child_id, before, stream.authority);
  }
}

DecodeFailure Buffer::ingest(TransformStream& stream, const std::uint8_t* data, std::size_t size,
                             std::size_t& stored) {
  stored = 0;
  const DecodeFailure failure = decode_tf_message(data, size, stream.decoded);
  {
    WriteLock lock(mutex_);
    ++counts_.messages;
    if (failure.reason) ++counts_.malformed;
    for (std::size_t i = 0; i < stream.decoded.size(); ++i) stored += store(stream, i, stream.decoded[i]);
  }
  if (stored > 0) notify();
  if (stream.decoded.capacity() > TransformStream::kMaxRemembered) stream.decoded = {};
  return failure;
}

bool Buffer::store(TransformStream& stream, std::size_t index, const TransformView& view) {
  if (index < stream.expected.size()) {
    const TransformStream::Names& names = stream.expected[index];
    if (names.child == view.child && names.parent == view.parent) {
      return count(tree_.insert(names.parent_id, names.child_id, view.stamp, view.values, stream.is_static,
                                stream.authority));
    }
  }
  if (!is_utf8(view.parent) || !is_utf8(view.child)) return count(kNoChildFrame);
  const unsigned refusals =
      tree_.insert(view.parent, view.child, view.stamp, view.values, stream.is_static, stream.authority);
  if (refusals == 0 && index < TransformStream::kMaxRemembered) {
    if (stream.expected.size() <= index) stream.expected.resize(index + 1);
    stream.expected[index] = {std::string(view.parent), std::string(view.child),
                              tree_.find(without_slash(view.parent)), tree_.find(without_slash(view.child))};
  }
  return count(refusals);
}

// True for a stored transform.
bool Buffer::count(unsigned refusals) {
  ++(refusals == 0 ? counts_.stored : refusals & kOldData ? counts_.old : counts_.refused);
  return refusals == 0;
}

void Buffer::clear() {
  {
    WriteLock lock(mutex_);
    tree_.clear();
  }
  notify();
}

FrameId Buffer::find(std::string_view name) const {
  ReadLock lock(mutex_);
  return tree_.find(name);
}

std::string Buffer::name(FrameId frame) const {
  ReadLock lock(mutex_);
  return tree_.name(frame);
}

bool Buffer::lookup(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const {
  ReadLock lock(mutex_);
  return coframe::lookup(tree_, paths_, target, source, stamp, pose, failure);
}

bool Buffer::lookup_full(FrameId target, Stamp& target_stamp, FrameId source, Stamp source_stamp, FrameId fixed,
                         Pose& pose, Failure& failure) const {
  ReadLock lock(mutex_);
  Pose step;
  if (!coframe::lookup(tree_, paths_, fixed, source, source_stamp, pose, failure)) return false;
  if (!coframe::lookup(tree_, paths_, target, fixed, target_stamp, step, failure)) return false;
  compose(step, pose);
  canonicalise(pose.q);
  return true;
}

bool Buffer::latest_common_time(FrameId target, FrameId source, Stamp& stamp, Failure& failure) const {
  ReadLock lock(mutex_);
  return coframe::latest_common_time(tree_, target, source, stamp, failure);
}

bool Buffer::chain(FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames,
                   Failure& failure) const {
  ReadLock lock(mutex_);
  return coframe::chain(tree_, target, source, stamp, frames, failure);
}

std::vector<FrameSummary> Buffer::frames() const {
  ReadLock lock(mutex_);
  std::vector<FrameSummary> all;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) {
    const Frame& frame = tree_.frame(id);
    const History* history = frame.history.get();
    if (!history || history->empty()) {
      all.push_back({frame.name, "", "", false, 0, 0, 0, 0.0});
      continue;
    }
    all.push_back({frame.name, tree_.name(history->parent()), tree_.authority_name(frame.authority),
                   history->is_static(), history->size(), history->oldest(), history->newest(),
                   history->is_static() ? 0.0 : average_rate(*history)});
  }
  return all;
}

std::vector<std::string> Buffer::frame_names() const {
  ReadLock lock(mutex_);
  std::vector<std::string> names;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) names.push_back(tree_.name(id));
  return names;
}

std::string Buffer::encode(bool is_static) const {
  ReadLock lock(mutex_);
  std::vector<TransformView> views;
  for (FrameId id = 1; id < tree_.frame_count(); ++id) {
    const History* history = tree_.history(id);
    if (!history || history->empty() || history->is_static() != is_static) continue;
    const Pose& pose = history->sample(history->size() - 1).pose;
    views.push_back({tree_.name(history->parent()), tree_.name(id), history->newest(),
                     {{pose.p[0], pose.p[1], pose.p[2]}, {pose.q[0], pose.q[1], pose.q[2], pose.q[3]}}});
  }
  return encode_tf_message(views);
}

Counts Buffer::counts() const {
  ReadLock lock(mutex_);
  return counts_;
}

// The order matters: a waiter announces itself before it reads changes_, a writer raises changes_ before it looks
// for waiters; so one of the two always sees the other.
void Buffer::notify() {
  changes_.fetch_add(1);
  if (waiting_.load() == 0) return;
  std::lock_guard lock(wait_mutex_);
  changed_.notify_all();
}

bool Buffer::wait_for_change(std::uint64_t seen, std::int64_t timeout_ns) const {
  std::unique_lock lock(wait_mutex_);
  waiting_.fetch_add(1);
  const bool changed = changed_.wait_for(lock, std::chrono::nanoseconds(timeout_ns),
                                         [&] { return changes_.load() != seen; });
  waiting_.fetch_sub(1);
  return changed;
}

}  // namespace coframe
