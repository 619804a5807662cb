// SPDX-License-Identifier: Apache-2.0
// Frames by name and by id, each with its history. One thread writes (Buffer ensures that), any number of threads read
// without a lock; what they read is consistent if revision() did not change in the meantime.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/tree_data.hpp"

namespace coframe {

inline constexpr int kMaxDepth = 1000;  // tf2's MAX_GRAPH_DEPTH

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
  explicit Tree(SharedTreeData shared);
  // Copies the current state of `other`. The samples are shared, those of shared data copied, frame by frame.
  Tree(const Tree& other);
  Tree& operator=(const Tree&) = delete;
  ~Tree();

  // Returns 0 if there is no such frame. In tf2, "NO_PARENT" also is a frame name, with the id 0.
  FrameId find(std::string_view name) const;
  std::size_t frame_count() const { return data().frames.size(); }  // including NO_PARENT
  std::string name(FrameId id) const { return std::string(frame(id).name.view()); }
  History::View history(FrameId id) const { return frame(id).history.view(); }
  History::Span span(FrameId id) const { return frame(id).history.span(); }
  // Accepts any number, including from the samples of a damaged file; returns NO_PARENT for an unknown one.
  const Frame& frame(FrameId id) const {
    const TreeData& tree = data();
    const Frame* frame = tree.frames.find(id);
    return frame ? *frame : tree.frames[0];
  }
  Frame& frame(FrameId id) { return const_cast<Frame&>(std::as_const(*this).frame(id)); }

  std::string authority_name(AuthorityId id) const {
    const std::string& all = storage().authority;
    return all.empty() ? std::string(data().authorities[id].view()) : all;
  }
  Stamp cache_length() const { return data().cache_length; }
  const TreeCounts& counts() const { return data().counts; }
  // Changes whenever a known path may have changed.
  std::uint64_t version() const { return data().version.load(std::memory_order_acquire); }
  const Atomic<std::uint64_t>& changes() const { return data().changes; }

  // Waits while a change is in progress. What is read from now on is consistent if unchanged() returns true afterwards.
  // Throws UnfinishedChange if the change does not end.
  std::uint64_t start_reading() const {
    const std::uint64_t now = data().revision.number();
    return now % 2 == 0 ? now : wait_for_writer();
  }
  bool unchanged(std::uint64_t since) const { return data().revision.unchanged(since); }

  // Throws LostMemory if another program has truncated the file with the data.
  void check_memory() const {
    if (const GuardedMemory* mapped = storage().mapped.get()) mapped->check();
  }

  // Whether the data are those of another writer, which cannot be locked out.
  bool read_only() const { return !storage().memory; }
  bool shared() const { return storage().shared; }
  // Whether poses are interpolated along screws, with a constant twist of the child, instead of like in tf2.
  bool along_screws() const { return along_screws_; }
  void set_along_screws(bool along_screws) { along_screws_ = along_screws; }  // before the first lookup
  bool outdated() const { return data().outdated.load(std::memory_order_acquire) != 0; }

  // nullptr for data that are not shared.
  SharedAccess* access() const { return storage().access.get(); }

  // Continues with shared data instead of its own, which must not contain a frame. Other threads may be reading.
  void switch_to(SharedTreeData shared);
  // Continues with a copy of the shared data on the heap, with the same ids. Other threads may be reading. Returns
  // false if the data are lost.
  bool become_private();

  // The methods below are for the only writer.

  AuthorityId authority(std::string_view name);
  // Adds a frame of another tree, with an empty history; returns nullptr if the name already exists.
  Frame* restore_frame(std::string_view name);
  HistoryContext context() {
    TreeData& tree = data();
    return {tree.cache_length, storage().histories(), tree.revision};
  }
  TreeCounts& counts() { return data().counts; }
  void count_change() {
    Atomic<std::uint64_t>& changes = data().changes;
    changes.store(changes.load(std::memory_order_relaxed) + 1, std::memory_order_release);
  }
  void set_outdated(bool outdated) { data().outdated.store(outdated, std::memory_order_release); }
  // Keeps `memory`, which contains the samples, and fails once it is lost. It may point to nothing and own the samples.
  void keep(std::shared_ptr<GuardedMemory> memory) { storage().keep(std::move(memory)); }
  std::size_t authority_count() const { return data().authorities.size(); }
  // Changes the authority of a frame whose newest transform came from `from`.
  void change_authority(FrameId id, AuthorityId from, AuthorityId to) {
    Frame& changed = data().frames[id];
    if (changed.authority == from) changed.authority = to;
  }
  // Returns whether there is room for the names of a few more frames.
  bool has_room_for_names(std::size_t bytes);
  // For a writer that continues the work of one that died, before its first change: completes the change that was in
  // progress, and repairs what is derived from the samples.
  void recover();

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
  // Where this process keeps the data.
  struct Storage {
    std::shared_ptr<Memory> memory;   // nullptr: read only
    std::shared_ptr<ChunkPool> pool;  // shared with the snapshots
    TreeData* data;
    bool shared;
    std::shared_ptr<SharedAccess> access;
    std::string authority;  // of all transforms; empty: the recorded ones
    std::shared_ptr<GuardedMemory> mapped;
    std::optional<HistoryStorage> parts;  // of a writer

    Storage() = default;
    Storage(const Storage&) = delete;
    Storage& operator=(const Storage&) = delete;
    ~Storage() {
      if (mapped) mapped->remove(data->revision);
    }
    void keep(std::shared_ptr<GuardedMemory> memory) {
      mapped = std::move(memory);
      if (mapped) mapped->add(data->revision);
    }
    const HistoryStorage& histories() const { return *parts; }
  };

  static std::unique_ptr<Storage> heap_storage(std::shared_ptr<ChunkPool> pool, Stamp cache_length);
  static std::unique_ptr<Storage> shared_storage(SharedTreeData shared);
  void use(std::unique_ptr<Storage> storage);
  const TreeData& data() const { return *data_.load(std::memory_order_acquire); }
  TreeData& data() { return *data_.load(std::memory_order_acquire); }
  Storage& storage() const { return *storage_.load(std::memory_order_acquire); }

  std::uint64_t wait_for_writer() const;
  void copy_from(const Tree& other, bool with_samples);
  void copy_shared(History& history, const Tree& other, FrameId id);
  FrameId add_frame(std::string_view name);
  FrameId find_or_add(std::string_view name, bool& is_new);
  std::uint32_t find_number(std::string_view name) const;
  void prepare(History& history, bool is_static, Inserted& inserted);
  void restore_known(FrameId id, Frame& frame, Inserted& inserted);
  bool make_room(const History& history);
  void store(Frame& frame, FrameId child, Stamp stamp, const Sample& sample, bool is_static, AuthorityId authority,
             Inserted& inserted);
  void raise_version() { data().version.fetch_add(1, std::memory_order_release); }

  // Readers may be using data that were replaced, so all are kept.
  std::vector<std::unique_ptr<Storage>> storages_;
  std::atomic<Storage*> storage_{nullptr};
  std::atomic<TreeData*> data_{nullptr};
  bool along_screws_ = false;
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
