// Frames by name and by number, each with its history. Not thread-safe: Buffer is.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/history.hpp"

namespace coframe {

struct Frame {
  std::string name;
  std::unique_ptr<History> history;  // none for the root of a tree
  AuthorityId authority = 0;
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

class Tree {
 public:
  explicit Tree(Stamp cache_length);

  // 0 when there is no such frame. "NO_PARENT" is a frame of that name in tf2 as well, and has the number 0.
  FrameId find(std::string_view name) const;
  FrameId find_or_add(std::string_view name);
  std::size_t frame_count() const { return frames_.size(); }  // with NO_PARENT
  const std::string& name(FrameId id) const { return frames_[id].name; }
  const History* history(FrameId id) const { return frames_[id].history.get(); }
  const Frame& frame(FrameId id) const { return frames_[id]; }

  AuthorityId authority(std::string_view name);
  // For a frame whose newest transform came from `from`.
  void change_authority(FrameId id, AuthorityId from, AuthorityId to) {
    if (frames_[id].authority == from) frames_[id].authority = to;
  }
  const std::string& authority_name(AuthorityId id) const { return authorities_[id]; }

  // Checks as tf2's setTransform does and stores; 0 or the reasons for refusal (Refusal bits).
  unsigned insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                  bool is_static, AuthorityId authority);
  // The part of insert() behind the names; for callers who know the numbers.
  unsigned insert(FrameId parent, FrameId child, Stamp stamp, const TransformValues& values, bool is_static,
                  AuthorityId authority);
  void clear();

  Stamp cache_length() const { return cache_length_; }
  // Changes whenever a path that was found before may run differently.
  std::uint64_t version() const { return version_; }

 private:
  struct Hash {
    using is_transparent = void;
    std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>{}(text); }
  };
  using Names = std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>>;

  History& history_of(FrameId child, bool is_static);
  unsigned store(FrameId parent, FrameId child, Stamp stamp, const Pose& pose, bool is_static, AuthorityId authority);

  Stamp cache_length_;
  std::deque<Frame> frames_;
  Names frame_ids_;
  std::vector<std::string> authorities_;
  Names authority_ids_;
  std::uint64_t version_ = 1;
};

// The lines that tf2 logs for a refused transform; `pose` as it was checked.
struct LogLine {
  bool is_error;  // else a warning
  std::string text;
};
std::vector<LogLine> refusal_texts(unsigned refusals, std::string_view parent, std::string_view child, Stamp stamp,
                                   const TransformValues& values, std::string_view authority);

}  // namespace coframe
