// SPDX-License-Identifier: Apache-2.0
// Frames by name and by number, each with its history. One thread writes (Buffer sees to that), any number read without
// a lock; what they read is good if revision() did not change meanwhile.
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
  // What became of the samples that were told of it, since the buffer exists.
  struct Counts {
    RelaxedAtomic<std::uint64_t> stored;
    RelaxedAtomic<std::uint64_t> late;                   // of these, put before newer ones
    RelaxedAtomic<std::uint64_t> repeated;               // exact repetitions, which change nothing
    RelaxedAtomic<std::uint64_t> old;                    // refused as older than the cache
    RelaxedAtomic<std::uint64_t> self, nan, quaternion;  // refused for these reasons

    void add(Insertion outcome);
    void refuse(unsigned refusals);
    void copy(const Counts& other);
  };

  std::string name;
  History history;  // of kind none: the root of a tree
  RelaxedAtomic<AuthorityId> authority;
  RelaxedAtomic<bool> known{false};  // false again once it was removed
  Counts counts;
  std::atomic<std::uint32_t> watchers{0};  // who wants to hear of insertions; see WaitQueue
};

struct TransformValues {
  double translation[3];
  double rotation[4];  // x, y, z, w
};

// tf2 takes one leading slash off the names of incoming transforms.
inline std::string_view without_slash(std::string_view name) {
  if (!name.empty() && name.front() == '/') name.remove_prefix(1);
  return name;
}

// What an insertion has done.
struct Inserted {
  unsigned refusals = 0;  // Refusal bits
  FrameId child = 0;      // where something was stored
  bool new_names = false;
  bool rewired = false;  // a frame that had a parent has or had another, or changed between static and dynamic
};

class Tree {
 public:
  explicit Tree(Stamp cache_length);
  // Becomes what `other` is at this moment; the samples are shared.
  Tree(const Tree& other);
  Tree& operator=(const Tree&) = delete;
  ~Tree();

  // 0 when there is no such frame. "NO_PARENT" is a frame of that name in tf2 as well, and has the number 0.
  FrameId find(std::string_view name) const;
  std::size_t frame_count() const { return frames_.size(); }  // with NO_PARENT
  const std::string& name(FrameId id) const { return frame(id).name; }
  History::View history(FrameId id) const { return frame(id).history.view(); }
  // For a number from anywhere, as samples of a file may tell: NO_PARENT where nothing has it.
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
  // Changes whenever a path that was found before may run differently.
  std::uint64_t version() const { return version_.load(std::memory_order_acquire); }

  // The rest is for the one writer.

  AuthorityId authority(std::string_view name);
  // A frame as it was in another tree, with nothing in its history yet; nullptr where there is one of that name.
  Frame* restore_frame(std::string_view name);
  HistoryContext context() { return {cache_length_, *pool_, revision_}; }
  // What must live as long as the samples.
  void keep(std::shared_ptr<const void> memory) { memory_ = std::move(memory); }
  std::size_t authority_count() const { return authorities_.size(); }
  // For a frame whose newest transform came from `from`.
  void change_authority(FrameId id, AuthorityId from, AuthorityId to) {
    if (frames_[id].authority == from) frames_[id].authority = to;
  }

  // Checks as tf2's setTransform does and stores.
  Inserted insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                  bool is_static, AuthorityId authority);
  // The part of insert() behind the names; for callers who know the numbers of two different frames. What was done is
  // told where it is wanted: a copy on the way costs a fifth of it all.
  void insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
              AuthorityId authority, Inserted& inserted);
  // Stores what goes on behind the newest sample of a dynamic frame that keeps its parent; returns how many from the
  // start on did. The rows, x, y, z, qx, qy, qz, qw, are known to be good.
  std::size_t append_run(std::string_view parent, std::string_view child, const Stamp* stamps, const double* rows,
                         std::size_t count, AuthorityId authority);
  void clear();
  // Forgets a frame, its link to its parent and those of its children to it.
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
  std::shared_ptr<ChunkPool> pool_;  // with the snapshots
  Revision revision_;
  StableVector<Frame> frames_;
  NameTable frame_numbers_;
  StableVector<std::string> authorities_;
  NameTable authority_numbers_;
  std::atomic<std::uint64_t> version_{1};
};

// Why the names or values of a transform are refused; 0 if they are not.
unsigned check_names(std::string_view parent, std::string_view child);
unsigned check_values(const TransformValues& values);

// The lines that tf2 logs for a refused transform; `pose` as it was checked.
struct LogLine {
  bool is_error;  // else a warning
  std::string text;
};
std::vector<LogLine> refusal_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp,
                                   const TransformValues& values, std::string_view authority);

}  // namespace coframe
