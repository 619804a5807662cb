// SPDX-License-Identifier: Apache-2.0
// Relays transform trees into another one: messages in, messages out, each edge from one source only.
#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/arrival_period.hpp"
#include "core/cdr.hpp"
#include "core/renaming.hpp"
#include "core/stamp_delay.hpp"
#include "core/thinning.hpp"

namespace coframe {

// Not thread-safe. Times are nanoseconds of any monotonic clock.
class Relay {
 public:
  using SourceId = std::uint32_t;
  using WriterId = std::uint64_t;
  static constexpr SourceId kNoSource = 0xffffffff;
  // Limits, because publishers may use any number of names.
  static constexpr std::size_t kMaxEdges = 65536;
  static constexpr std::size_t kMaxWriters = 1024;
  static constexpr std::size_t kMaxPending = 1 << 18;  // transforms that may be sent later, of all edges
  // With a maximum error, the maximum time between two transforms of a robot that does not move. Subscribers take an
  // edge for stale after a second.
  static constexpr std::int64_t kHeartbeat = 500'000'000;
  static constexpr std::int64_t kNever = std::numeric_limits<std::int64_t>::max();

  enum class Direction : std::uint8_t {
    merge,  // add the prefix
    split,  // remove the prefix of one robot's frames; omit the frames of other robots
  };

  // A frame that one source owns, whichever sources publish it.
  struct Claim {
    std::string child;            // as it is written
    SourceId source;              // the first source
    SourceId rival = kNoSource;   // another source that publishes something different
    std::uint64_t contested = 0;  // transforms of other sources, which are dropped
    std::int64_t received_at = 0;
    std::uint32_t edge = 0;  // index of the newest edge
  };

  struct Edge {
    std::uint32_t claim;                    // index of the child's claim
    std::string parent;                     // as it is written
    WriterId writer = 0;                    // the last publisher
    std::uint64_t passed = 0, thinned = 0;  // of thinned edges, the pending ones are not counted
    Stamp newest = 0;
    std::int64_t received_at = 0;
    std::int64_t due = 0;      // when the next transform may pass at the given rate
    TransformValues values{};  // the last ones
    Thinning thinning;
    bool is_waiting = false;  // listed in waiting_
  };

  struct Writer {
    std::uint64_t messages = 0, malformed = 0;
    std::uint64_t refused = 0;     // transforms with invalid names or values
    std::uint64_t over_limit = 0;  // transforms of edges for which there was no room
    std::int64_t received_at = 0;
    ArrivalPeriod period;
    StampDelay delay;
    NameProblems name_problems;
    std::vector<ExpectedNames> expected;  // `child` is 1 + the index of the edge; 0: not relayed
  };

  // `period` is the minimum time between two transforms of an edge; 0: relay all. With `most`, a transform is sent only
  // if interpolation would otherwise be wrong by more than that, and `period` is the maximum time between two
  // transforms of a robot that moves. For static edges the last transforms are kept, and all of them are written as
  // soon as one changes.
  Relay(bool is_static, std::int64_t period, std::optional<MaxError> most = {})
      : is_static_(is_static), period_(period), max_error_(most) {}

  SourceId add_source(Renaming renaming, Direction direction);
  // Adds a message. Malformed messages are counted. `wall_time` is the time of the system clock.
  void add(SourceId source, WriterId writer, const std::uint8_t* data, std::size_t size, std::int64_t now,
           std::int64_t wall_time);
  // Returns one message with everything to send since the last call; empty if there is nothing to write.
  std::string take(std::int64_t now);
  // When take() has something to write although nothing is added; kNever if it has not.
  std::int64_t next_due() const { return next_due_; }
  void forget_writer(SourceId source, WriterId writer) { sources_[source].writers.erase(writer); }

  std::size_t sources() const { return sources_.size(); }
  const std::deque<Edge>& edges() const { return edges_; }
  const Claim& claim(const Edge& edge) const { return claims_[edge.claim]; }
  const std::unordered_map<WriterId, Writer>& writers(SourceId source) const { return sources_[source].writers; }

 private:
  // A source that has not published for this long loses its edges to other sources that publish them.
  static constexpr std::int64_t kOwnershipTimeout = 2'000'000'000;
  static constexpr std::size_t kMaxRemembered = 1024;  // transforms of one message

  struct Source {
    Renaming renaming;
    Direction direction;
    std::unordered_map<WriterId, Writer> writers;
    std::int64_t moved_at = std::numeric_limits<std::int64_t>::min() / 2;  // when an edge was last found to move
  };

  Writer& writer_of(Source& source, WriterId writer);
  std::uint32_t place_of(const Source& source, Writer& writer, std::size_t index, const TransformView& view);
  std::uint32_t find_or_add(const std::string& parent, const std::string& child);
  bool claim_edge(std::uint32_t place, SourceId source, const TransformView& view, std::int64_t now);
  bool is_due(Edge& edge, std::int64_t now) const;
  void thin(std::uint32_t place, Source& source, std::int64_t now);
  void flush(Edge& edge);
  void flush_due(std::int64_t now);
  void write_due(Edge& edge, std::size_t pending_before, std::size_t added_count);
  void write(const Edge& edge, Stamp stamp, const TransformValues& values);

  bool is_static_;
  std::int64_t period_;
  std::optional<MaxError> max_error_;
  std::vector<Source> sources_;
  std::deque<Claim> claims_;  // a deque, because messages are written from views of the names
  std::deque<Edge> edges_;
  std::unordered_map<std::string, std::uint32_t> claim_of_;  // by child
  std::unordered_map<std::string, std::uint32_t> edge_of_;   // by parent, NUL, child
  std::vector<TransformView> decoded_, written_;
  bool is_news_ = false;                // true: a static edge has changed
  std::vector<std::uint32_t> waiting_;  // edges with pending transforms
  std::vector<TimedTransform> due_;     // empty between calls
  std::size_t pending_ = 0;             // transforms of all edges
  std::int64_t next_due_ = kNever;
};

}  // namespace coframe
