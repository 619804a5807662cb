// SPDX-License-Identifier: Apache-2.0
// Frames by name and by id, each with its history. One thread writes (Buffer ensures that), any number of threads read
// without a lock; what they read is consistent if revision() did not change meanwhile.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/history.hpp"
#include "core/name_table.hpp"
#include "core/stable_vector.hpp"

namespace coframe {

using AuthorityId = std::uint32_t;  // 0 is "no recorded authority"

inline constexpr int kMaxDepth = 1000;  // tf2's MAX_GRAPH_DEPTH

struct Frame {
  // What happened to the samples of the frame since the buffer was created.
  struct Counts {
    RelaxedAtomic<std::uint64_t> stored;
    RelaxedAtomic<std::uint64_t> late;                   // of these, inserted before newer ones
    RelaxedAtomic<std::uint64_t> repeated;               // exact repetitions, which change nothing
    RelaxedAtomic<std::uint64_t> old;                    // rejected as older than the cache
    RelaxedAtomic<std::uint64_t> self, nan, quaternion;  // rejected for these reasons

    void add(Insertion outcome);
    void refuse(unsigned refusals);
    void copy(const Counts& other);
  };

  std::string name;
  History history;  // kind none: the root of a tree
  RelaxedAtomic<AuthorityId> authority;
  RelaxedAtomic<bool> known{false};  // false after the frame was removed
  Counts counts;
  std::atomic<std::uint32_t> watchers{0};  // the waiters to notify of insertions; see WaitQueue
};

struct TransformValues {
  double translation[3];
  double rotation[4];  // x, y, z, w
};

// tf2 removes one leading slash from the names of inserted transforms.
inline std::string_view without_slash(std::string_view name) {
  if (!name.empty() && name.front() == '/') name.remove_prefix(1);
  return name;
}

// The effects of an insertion.
struct Inserted {
  unsigned refusals = 0;  // Refusal bits
  FrameId child = 0;      // 0 if nothing was stored
  bool new_names = false;
  bool rewired = false;  // the parent of a frame changed, or it changed between static and dynamic
};

class Tree {
 public:
  explicit Tree(Stamp cache_length);
  // Copies the current state of `other`. The samples are shared.
  Tree(const Tree& other);
  Tree& operator=(const Tree&) = delete;
  ~Tree();

  // Returns 0 if there is no such frame. In tf2, "NO_PARENT" also is a frame name, with the id 0.
  FrameId find(std::string_view name) const;
  std::size_t frame_count() const { return frames_.size(); }  // including NO_PARENT
  const std::string& name(FrameId id) const { return frame(id).name; }
  History::View history(FrameId id) const { return frame(id).history.view(); }
  History::Span span(FrameId id) const { return frame(id).history.span(); }
  // Accepts any number, also from the samples of a damaged file; returns NO_PARENT for an unknown one.
  const Frame& frame(FrameId id) const {
    const Frame* frame = frames_.find(id);
    return frame ? *frame : frames_[0];
  }
  Frame& frame(FrameId id) {
    Frame* frame = frames_.find(id);
    return frame ? *frame : frames_[0];
  }

  const std::string& authority_name(AuthorityId id) const { return authorities_[id]; }
  Stamp cache_length() const { return cache_length_; }
  const Revision& revision() const { return revision_; }
  // Changes whenever a known path may have changed.
  std::uint64_t version() const { return version_.load(std::memory_order_acquire); }

  // The methods below are for the only writer.

  AuthorityId authority(std::string_view name);
  // Adds a frame of another tree, with an empty history; returns nullptr if the name exists already.
  Frame* restore_frame(std::string_view name);
  HistoryContext context() { return {cache_length_, *pool_, revision_}; }
  // Keeps `memory` alive as long as the samples.
  void keep(std::shared_ptr<const void> memory) { memory_ = std::move(memory); }
  std::size_t authority_count() const { return authorities_.size(); }
  // Changes the authority of a frame whose newest transform came from `from`.
  void change_authority(FrameId id, AuthorityId from, AuthorityId to) {
    if (frames_[id].authority == from) frames_[id].authority = to;
  }

  // Performs the checks of tf2's setTransform and stores the transform.
  Inserted insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                  bool is_static, AuthorityId authority);
  // The part of insert() after the names are resolved, for callers that know the ids of two different frames.
  // `inserted` is written in place, because a copy would cost a fifth of the whole insertion.
  void insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
              AuthorityId authority, Inserted& inserted);
  // Appends the leading rows that are newer than the newest sample of a dynamic frame and keep its parent; returns how
  // many were stored. The rows, x, y, z, qx, qy, qz, qw, must be valid.
  std::size_t append_run(std::string_view parent, std::string_view child, const Stamp* stamps, const double* rows,
                         std::size_t count, AuthorityId authority);
  void clear();
  // Removes a frame, the edge to its parent and the edges of its children to it.
  void remove(FrameId frame);

 private:
  FrameId find_or_add(std::string_view name, bool& is_new);
  std::uint32_t find_number(std::string_view name) const;
  void prepare(History& history, bool is_static, Inserted& inserted);
  void know_again(FrameId id, Frame& frame, Inserted& inserted);
  void store(Frame& frame, FrameId child, Stamp stamp, const Sample& sample, bool is_static, AuthorityId authority,
             Inserted& inserted);
  void raise_version() { version_.fetch_add(1, std::memory_order_release); }

  Stamp cache_length_;
  std::shared_ptr<const void> memory_;
  std::shared_ptr<ChunkPool> pool_;  // shared with the snapshots
  Revision revision_;
  StableVector<Frame> frames_;
  NameTable frame_numbers_;
  StableVector<std::string> authorities_;
  NameTable authority_numbers_;
  std::atomic<std::uint64_t> version_{1};
};

// Why the names or values of a transform are rejected, as bits; 0 if they are valid.
unsigned check_names(std::string_view parent, std::string_view child);
unsigned check_values(const TransformValues& values);

// The lines that tf2 logs for a rejected transform. `values` are the values that were checked.
struct LogLine {
  bool is_error;  // false: a warning
  std::string text;
};
std::vector<LogLine> refusal_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp,
                                   const TransformValues& values, std::string_view authority);

}  // namespace coframe
