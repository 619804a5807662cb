// SPDX-License-Identifier: Apache-2.0
#include "core/relay.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace coframe {
namespace {

// Computes the names of an edge in the output; false if the edge does not belong to this source's robot.
bool renamed(const Renaming& renaming, Relay::Direction direction, const TransformView& view, std::string& parent,
             std::string& child) {
  if (direction == Relay::Direction::merge) {
    parent = renaming(view.parent);
    child = renaming(view.child);
    return true;
  }
  child = without_slash(view.child);
  parent = without_slash(view.parent);
  renaming.strip(view.parent, parent);  // it may be a shared frame
  return renaming.strip(view.child, child) || renaming.keeps(child);
}

bool same(const TransformValues& a, const TransformValues& b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

Relay::SourceId Relay::add_source(Renaming renaming, Direction direction) {
  sources_.push_back({std::move(renaming), direction, {}});
  return static_cast<SourceId>(sources_.size() - 1);
}

void Relay::add(SourceId source, WriterId writer, const std::uint8_t* data, std::size_t size, std::int64_t now,
                std::int64_t wall_time) {
  Writer& from = writer_of(sources_.at(source), writer);
  ++from.messages;
  from.received_at = now;
  from.period.add(now);
  if (decode_tf_message(data, size, decoded_, from.expected).reason) {
    ++from.malformed;
    return;
  }
  Stamp newest = 0;
  for (std::size_t i = 0; i < decoded_.size(); ++i) {
    const TransformView& view = decoded_[i];
    newest = std::max(newest, view.stamp);
    const std::uint32_t place = view.as_expected ? from.expected[i].child : place_of(sources_[source], from, i, view);
    if (place == 0) continue;
    if (check_values(view.values) != 0) {
      ++from.refused;
      continue;
    }
    if (!claim_edge(place - 1, source, view, now)) continue;
    Edge& edge = edges_[place - 1];
    is_news_ |= edge.passed == 0 || !same(edge.values, view.values);
    edge.writer = writer;
    edge.newest = view.stamp;
    edge.received_at = now;
    edge.values = view.values;
    if (is_static_) {
      ++edge.passed;
    } else if (max_error_) {
      thin(place - 1, sources_[source], now);
    } else if (is_due(edge, now)) {
      ++edge.passed;
      write(edge, view.stamp, view.values);
    } else {
      ++edge.thinned;
    }
  }
  if (!is_static_ && newest != 0) from.delay.add(wall_time - newest);
  if (decoded_.capacity() > kMaxRemembered) decoded_ = std::vector<TransformView>();
}

std::string Relay::take(std::int64_t now) {
  if (is_static_ && std::exchange(is_news_, false)) {
    for (const Claim& claim : claims_) {
      const Edge& edge = edges_[claim.edge];
      if (edge.passed > 0) write(edge, edge.newest, edge.values);
    }
  }
  if (max_error_) flush_due(now);
  if (written_.empty()) return {};
  std::string message = encode_tf_message(written_);
  written_.clear();
  if (written_.capacity() > kMaxRemembered) written_ = std::vector<TransformView>();
  return message;
}

Relay::Writer& Relay::writer_of(Source& source, WriterId writer) {
  if (source.writers.size() >= kMaxWriters && !source.writers.contains(writer)) source.writers.clear();
  return source.writers[writer];
}

// Returns 1 + the index of the edge; 0: not relayed.
std::uint32_t Relay::place_of(const Source& source, Writer& writer, std::size_t index, const TransformView& view) {
  std::string parent, child;
  std::uint32_t place = 0;
  if (!is_utf8(view.parent) || !is_utf8(view.child)) {
    ++writer.refused;
    return 0;
  }
  writer.name_problems.note(source.renaming, view.parent);
  writer.name_problems.note(source.renaming, view.child);
  if (renamed(source.renaming, source.direction, view, parent, child)) {
    if (check_names(parent, child) != 0) {
      ++writer.refused;
      return 0;
    }
    place = find_or_add(parent, child);
    if (place == 0) {
      ++writer.over_limit;
      return 0;
    }
  }
  if (index < kMaxRemembered) {
    if (writer.expected.size() <= index) writer.expected.resize(index + 1);
    writer.expected[index] = {std::string(view.name_bytes), 0, place};
  }
  return place;
}

std::uint32_t Relay::find_or_add(const std::string& parent, const std::string& child) {
  const std::string key = parent + '\0' + child;
  if (const auto known = edge_of_.find(key); known != edge_of_.end()) return known->second + 1;
  if (edges_.size() >= kMaxEdges) return 0;
  const auto [claim, is_new] = claim_of_.try_emplace(child, static_cast<std::uint32_t>(claims_.size()));
  if (is_new) claims_.push_back({.child = child, .source = kNoSource});
  const auto place = static_cast<std::uint32_t>(edges_.size());
  Edge& edge = edges_.emplace_back();
  edge.claim = claim->second;
  edge.parent = parent;
  edge_of_.emplace(key, place);
  return place + 1;
}

// A source keeps the frames that it published first until it stops publishing: two sources at once would make a frame
// jump, and a loop through another program would never end.
bool Relay::claim_edge(std::uint32_t place, SourceId source, const TransformView& view, std::int64_t now) {
  Claim& claim = claims_[edges_[place].claim];
  const bool is_free = claim.source == kNoSource || (!is_static_ && now - claim.received_at > kOwnershipTimeout);
  if (claim.source != source && !is_free) {
    const bool agrees = is_static_ && claim.edge == place && same(edges_[place].values, view.values);
    if (!agrees) {
      claim.rival = source;
      ++claim.contested;
    }
    return false;
  }
  if (max_error_ && claim.source != kNoSource && claim.edge != place) {  // another parent: there is no interpolation
    flush(edges_[claim.edge]);
    edges_[claim.edge].thinning.restart();
  }
  claim.source = source;
  claim.received_at = now;
  claim.edge = place;
  return true;
}

// Relative to when the last one was due, not to when it arrived: this keeps the average rate.
bool Relay::is_due(Edge& edge, std::int64_t now) const {
  if (period_ > 0) {
    if (now < edge.due) return false;
    edge.due = (now - edge.due < period_ ? edge.due : now) + period_;
  }
  return true;
}

void Relay::thin(std::uint32_t place, Source& source, std::int64_t now) {
  Edge& edge = edges_[place];
  const std::size_t before = edge.thinning.pending();
  if (edge.thinning.add(*max_error_, {edge.newest, now, edge.values}, due_)) {
    source.moved_at = now;
    next_due_ = now;  // the other edges of the robot may be due
  }
  write_due(edge, before, 1);
  if (edge.thinning.pending() == 0) return;
  if (pending_ > kMaxPending) {
    flush(edge);
  } else if (!std::exchange(edge.is_waiting, true)) {
    waiting_.push_back(place);
    next_due_ = std::min(next_due_, edge.thinning.sent_at() + period_);
  }
}

void Relay::flush(Edge& edge) {
  const std::size_t before = edge.thinning.pending();
  edge.thinning.flush(due_);
  write_due(edge, before, 0);
}

// All edges of a robot that moves are sent with the same period, because a lookup needs the newest transforms of all
// edges of a chain at a common time.
void Relay::flush_due(std::int64_t now) {
  if (now < next_due_) return;
  next_due_ = kNever;
  std::erase_if(waiting_, [&](std::uint32_t place) {
    Edge& edge = edges_[place];
    const bool is_moving = now - sources_[claim(edge).source].moved_at <= period_;
    const std::int64_t due = edge.thinning.sent_at() + (is_moving ? period_ : std::max(period_, kHeartbeat));
    if (due <= now) flush(edge);
    edge.is_waiting = edge.thinning.pending() > 0;
    if (edge.is_waiting) next_due_ = std::min(next_due_, due);
    return !edge.is_waiting;
  });
}

// Writes what Thinning found to be due, after `added_count` transforms were added to those that were pending before.
void Relay::write_due(Edge& edge, std::size_t pending_before, std::size_t added_count) {
  for (const TimedTransform& transform : due_) write(edge, transform.stamp, transform.values);
  const std::size_t pending = edge.thinning.pending();
  edge.passed += due_.size();
  edge.thinned += pending_before + added_count - due_.size() - pending;
  pending_ = pending_ - pending_before + pending;
  due_.clear();
}

void Relay::write(const Edge& edge, Stamp stamp, const TransformValues& values) {
  written_.push_back({.parent = edge.parent, .child = claims_[edge.claim].child, .stamp = stamp, .values = values});
}

}  // namespace coframe
