// SPDX-License-Identifier: Apache-2.0
// The messages of publishers, from the wire and from recordings.
#include "core/buffer.hpp"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "core/ros1.hpp"

namespace coframe {

AuthorityId Buffer::authority(std::string_view name) {
  const std::lock_guard lock(writing_);
  if (following()) return 0;
  return tree_.authority(name);
}

TransformStream Buffer::open_stream(bool is_static, std::string_view authority,
                                    std::shared_ptr<const Renaming> renaming) {
  const std::lock_guard lock(writing_);
  TransformStream stream;
  stream.is_static = is_static;
  stream.renaming = std::move(renaming);
  stream.authority = following() ? 0 : tree_.authority(authority);
  return stream;
}

void Buffer::rename(TransformStream& stream, std::string_view authority) {
  const std::lock_guard lock(writing_);
  if (refusal_.load() != 0) return;
  const AuthorityId before = stream.authority;
  stream.authority = tree_.authority(authority);
  for (const ExpectedNames& names : stream.expected) tree_.change_authority(names.child, before, stream.authority);
}

DecodeFailure Buffer::ingest(TransformStream& stream, const std::uint8_t* data, std::size_t size, std::size_t& stored) {
  const DecodeFailure failure = ingest_without_notify(stream, data, size, stored);
  notify_ingested(stream);
  return failure;
}

DecodeFailure Buffer::ingest_without_notify(TransformStream& stream, const std::uint8_t* data, std::size_t size,
                                            std::size_t& stored) {
  stored = 0;
  const auto decode = stream.encoding == TransformStream::Encoding::cdr ? decode_tf_message : decode_ros1_tf_message;
  const DecodeFailure failure = decode(data, size, stream.decoded, stream.expected);
  const std::size_t transforms = stream.decoded.size();
  stream.inserted.resize(transforms);
  stream.newest = 0;
  for (const TransformView& view : stream.decoded) stream.newest = std::max(stream.newest, view.stamp);
  {
    const std::lock_guard lock(writing_);
    if (following()) {
      stream.inserted.assign(transforms, {.refusals = kShared});
      return failure;
    }
    TreeCounts& counts = tree_.counts();
    counts.messages.add(1);
    if (failure.reason) counts.malformed.add(1);
    for (std::size_t i = 0; i < transforms; ++i) {
      // Rejected old samples also change the tree: they create frames, and older samples may be pruned.
      store(stream, i, stream.decoded[i], stream.inserted[i]);
      if (count(stream.inserted[i].refusals)) ++stored;
    }
    if (transforms > 0) tree_.count_change();
  }
  return failure;
}

void Buffer::notify_ingested(TransformStream& stream) {
  notify(stream.inserted.data(), stream.inserted.size());
  if (stream.decoded.capacity() > TransformStream::kMaxRemembered) {
    stream.decoded = std::vector<TransformView>();  // unlike `= {}`, frees the memory
    stream.inserted = std::vector<Inserted>();
  }
}

void Buffer::store(TransformStream& stream, std::size_t index, const TransformView& view, Inserted& inserted) {
  if (const unsigned refusal = refusal_.load()) {
    inserted = {.refusals = refusal};
  } else if (view.as_expected) {
    const ExpectedNames& names = stream.expected[index];
    tree_.insert(names.parent, names.child, view.stamp, view.values, stream.is_static, stream.authority, inserted);
  } else {
    inserted = store_unexpected(stream, index, view);
  }
}

Inserted Buffer::store_unexpected(TransformStream& stream, std::size_t index, const TransformView& view) {
  if (!is_utf8(view.parent) || !is_utf8(view.child)) return {.refusals = kNoChildFrame};
  static const Renaming none;
  const Renaming& renaming = stream.renaming ? *stream.renaming : none;
  stream.name_problems.note(renaming, view.parent);
  stream.name_problems.note(renaming, view.child);
  if (!stream.renaming) return store_named(stream, index, view, view.parent, view.child);
  return store_named(stream, index, view, renaming(view.parent), renaming(view.child));
}

Inserted Buffer::store_named(TransformStream& stream, std::size_t index, const TransformView& view,
                             std::string_view parent, std::string_view child) {
  const std::size_t frames = tree_.frame_count();
  const bool is_full = frames >= kMaxFrames || received_name_bytes_ + parent.size() + child.size() > kMaxNameBytes ||
                       !tree_.has_room_for_names(parent.size() + child.size());
  if (is_full && (tree_.find(without_slash(parent)) == 0 || tree_.find(without_slash(child)) == 0)) {
    return {.refusals = kTooManyFrames};
  }
  const Inserted inserted = tree_.insert(parent, child, view.stamp, view.values, stream.is_static, stream.authority);
  if (tree_.frame_count() > frames) received_name_bytes_ += parent.size() + child.size();
  if (inserted.refusals == 0 && index < TransformStream::kMaxRemembered) {
    if (stream.expected.size() <= index) stream.expected.resize(index + 1);
    stream.expected[index] = {std::string(view.name_bytes), tree_.find(without_slash(parent)),
                              tree_.find(without_slash(child))};
  }
  return inserted;
}

}  // namespace coframe
