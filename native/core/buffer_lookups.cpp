// SPDX-License-Identifier: Apache-2.0
// Single lookups, by ids and by names.
#include "core/buffer.hpp"

#include <utility>

namespace coframe {

namespace {

bool fail_name(ErrorCode code, Argument argument, std::string_view name, Failure& failure) {
  failure = Failure{};
  failure.code = code;
  failure.argument = argument;
  failure.name = name;
  return false;
}

}  // namespace

// A sample at the latest common time may be pruned after that time was chosen and before the sample is read. A failure
// that repeats unchanged has another cause.
template <class Lookup>
bool Buffer::retry_until_stable(bool for_latest, const Failure& failure, Lookup&& lookup) const {
  std::pair<Stamp, Stamp> before{};
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    if (consistent(lookup)) return true;
    const std::pair now(failure.requested, failure.earliest);
    const bool dropped = failure.code == ErrorCode::too_old || failure.code == ErrorCode::only_other;
    if (!for_latest || !dropped || now == before) break;
    before = now;
  }
  return false;
}

bool Buffer::lookup_by_id(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const {
  const PathLease paths(paths_);
  return lookup_by_id(paths.get(), target, source, stamp, pose, failure);
}

bool Buffer::lookup_by_walking(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const {
  return lookup_by_id(nullptr, target, source, stamp, pose, failure);
}

bool Buffer::lookup_by_id(PathCache* paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                          Failure& failure) const {
  const Stamp requested_stamp = stamp;
  return retry_until_stable(requested_stamp == 0, failure, [&] {
    stamp = requested_stamp;
    return lookup_in_tree(tree_, paths, target, source, stamp, pose, failure);
  });
}

bool Buffer::lookup_cached_path(PathCache& paths, FrameId target, FrameId source, Stamp& stamp, Pose& pose) const {
  const std::uint64_t revision = tree_.start_reading();
  Stamp found_stamp = stamp;
  if (!lookup_path_in_tree(tree_, paths, target, source, found_stamp, pose) || !tree_.unchanged(revision)) return false;
  stamp = found_stamp;
  return true;
}

bool Buffer::lookup_full_by_id(FrameId target, Stamp& target_stamp, FrameId source, Stamp source_stamp, FrameId fixed,
                               Pose& pose, Failure& failure) const {
  const Stamp target_asked = target_stamp;
  const PathLease paths(paths_);
  return retry_until_stable(target_asked == 0 || source_stamp == 0, failure, [&] {
    Pose step;
    Stamp source_time = source_stamp;
    target_stamp = target_asked;
    if (!lookup_in_tree(tree_, paths.get(), fixed, source, source_time, pose, failure)) return false;
    if (!lookup_in_tree(tree_, paths.get(), target, fixed, target_stamp, step, failure)) return false;
    compose(step, pose);
    canonicalise(pose.q);
    return true;
  });
}

bool Buffer::extrapolate_by_id(Extrapolation& extrapolation, FrameId target, FrameId source, Stamp& stamp, Pose& pose,
                               Failure& failure) const {
  const Stamp requested_stamp = stamp;
  return consistent([&] {
    stamp = requested_stamp;
    return extrapolate_in_tree(tree_, extrapolation, target, source, stamp, pose, failure);
  });
}

// Finds the id of a frame, or fails with what is wrong with its name.
bool Buffer::resolve(std::string_view name, Argument argument, FrameId& frame, Failure& failure) const {
  if (name.empty()) return fail_name(ErrorCode::empty_name, argument, name, failure);
  if (name.front() == '/') return fail_name(ErrorCode::leading_slash, argument, name, failure);
  if (frame == 0 || !knows(frame)) frame = find(name);
  return frame != 0 || fail_name(ErrorCode::unknown_frame, argument, name, failure);
}

bool Buffer::resolve_both(LookupQuery& query, Failure& failure) const {
  return resolve(query.target, Argument::target_frame, query.target_id, failure) &&
         resolve(query.source, Argument::source_frame, query.source_id, failure);
}

bool Buffer::lookup_by_name(LookupQuery& query, LookupResult& result, Failure& failure,
                            Extrapolation* extrapolation) const {
  result.stamp = query.stamp;
  if (!query.time_travel && query.target == query.source) {  // also for a frame that does not exist
    result.pose = Pose{};
    const FrameId frame = find(query.target);
    return frame == 0 || lookup_by_id(frame, frame, result.stamp, result.pose, failure);
  }
  if (!resolve_both(query, failure)) return false;
  const FrameId target = query.target_id, source = query.source_id;
  if (extrapolation) return extrapolate_by_id(*extrapolation, target, source, result.stamp, result.pose, failure);
  if (!query.time_travel) return lookup_by_id(target, source, result.stamp, result.pose, failure);
  return resolve(query.fixed, Argument::fixed_frame, query.fixed_id, failure) &&
         lookup_full_by_id(target, result.stamp, source, query.source_stamp, query.fixed_id, result.pose, failure);
}

bool Buffer::can_lookup(LookupQuery& query, Failure& failure) const {
  LookupResult ignored;
  if (!query.time_travel) return lookup_by_name(query, ignored, failure);
  if (!resolve_both(query, failure)) return false;
  if (!resolve(query.fixed, Argument::fixed_frame, query.fixed_id, failure)) return false;
  Stamp target_stamp = query.stamp, source_stamp = query.source_stamp;
  return lookup_by_id(query.target_id, query.fixed_id, target_stamp, ignored.pose, failure) &&
         lookup_by_id(query.fixed_id, query.source_id, source_stamp, ignored.pose, failure);
}

bool Buffer::latest_common_time(LookupQuery& query, Stamp& stamp, Failure& failure) const {
  return resolve_both(query, failure) && consistent([&] {
           return coframe::latest_common_time(tree_, query.target_id, query.source_id, stamp, failure);
         });
}

bool Buffer::chain(FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames, Failure& failure) const {
  return consistent([&] { return coframe::chain(tree_, target, source, stamp, frames, failure); });
}

}  // namespace coframe
