// Trees of transforms on their way into another one: messages in, messages out, each edge from one source only.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/cdr.hpp"
#include "core/arrival_period.hpp"
#include "core/stamp_delay.hpp"
#include "core/renaming.hpp"

namespace coframe {

// Not for several threads at once. Times are nanoseconds of any one clock that never goes back.
class Relay {
 public:
  using SourceId = std::uint32_t;
  using WriterId = std::uint64_t;
  static constexpr SourceId kNobody = 0xffffffff;
  // Whoever sends may invent names and writers: more are not taken in.
  static constexpr std::size_t kMaxEdges = 65536;
  static constexpr std::size_t kMaxWriters = 1024;

  enum class Direction : std::uint8_t {
    merge,  // names get the prefix
    split,  // of one robot's frames the prefix goes; other robots' frames are left out
  };

  // A frame, whoever tells of it: one source is listened to.
  struct Claim {
    std::string child;         // as it is written
    SourceId source;           // who was first
    SourceId rival = kNobody;  // who else tells of it, something else
    std::uint64_t contested = 0;  // transforms of rivals, which are left out
    std::int64_t received_at = 0;
    std::uint32_t edge = 0;    // the newest one's place
  };

  struct Edge {
    std::uint32_t claim;  // the place of the child's
    std::string parent;   // as it is written
    WriterId writer = 0;  // who told of it last
    std::uint64_t passed = 0, thinned = 0;
    Stamp newest = 0;
    std::int64_t received_at = 0;
    std::int64_t due = 0;      // when the rate lets the next one pass
    TransformValues values{};  // the last ones
  };

  struct Writer {
    std::uint64_t messages = 0, malformed = 0;
    std::uint64_t refused = 0;  // transforms with bad names or values, or of one edge too many
    std::int64_t received_at = 0;
    ArrivalPeriod period;
    StampDelay delay;
    NameProblems name_problems;
    std::vector<ExpectedNames> expected;  // `child` is 1 + the edge's place; 0: not for this relay
  };

  // `period`: of each edge at most one transform in so long; 0: all. Of static edges the last transforms are kept, and
  // all of them are written as soon as one of them changes.
  Relay(bool is_static, std::int64_t period) : is_static_(is_static), period_(period) {}

  SourceId add_source(Renaming renaming, Direction direction);
  // Takes a message in; a malformed one is counted. `wall` is the system clock's time.
  void add(SourceId source, WriterId writer, const std::uint8_t* data, std::size_t size, std::int64_t now,
           std::int64_t wall);
  // One message of what was taken in since the last one; empty if nothing is to be written.
  std::string take();
  void forget_writer(SourceId source, WriterId writer) { sources_[source].writers.erase(writer); }

  std::size_t sources() const { return sources_.size(); }
  const std::deque<Edge>& edges() const { return edges_; }
  const Claim& claim(const Edge& edge) const { return claims_[edge.claim]; }
  const std::unordered_map<WriterId, Writer>& writers(SourceId source) const { return sources_[source].writers; }

 private:
  // A source that was silent for so long has lost its edges to whoever else tells of them.
  static constexpr std::int64_t kPatience = 2'000'000'000;
  static constexpr std::size_t kMaxRemembered = 1024;  // transforms of one message

  struct Source {
    Renaming renaming;
    Direction direction;
    std::unordered_map<WriterId, Writer> writers;
  };

  Writer& writer_of(Source& source, WriterId writer);
  std::uint32_t place_of(const Source& source, Writer& writer, std::size_t index, const TransformView& view);
  std::uint32_t find_or_add(const std::string& parent, const std::string& child);
  bool is_listened_to(std::uint32_t place, SourceId source, const TransformView& view, std::int64_t now);
  bool is_due(Edge& edge, std::int64_t now) const;
  void write(const Edge& edge);

  bool is_static_;
  std::int64_t period_;
  std::vector<Source> sources_;
  std::deque<Claim> claims_;  // views of names are written: they stay where they are
  std::deque<Edge> edges_;
  std::unordered_map<std::string, std::uint32_t> claim_of_;               // by child
  std::unordered_map<std::string, std::uint32_t> edge_of_;                // by parent, NUL, child
  std::vector<TransformView> decoded_, written_;
  bool is_news_ = false;  // a static edge has changed
};

}  // namespace coframe
