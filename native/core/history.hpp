// The samples of one frame in time order, in chunks, searched and not walked. tf2's TimeCache and StaticCache.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/pose.hpp"

namespace coframe {

using FrameId = std::uint32_t;      // 0 is tf2's NO_PARENT
using AuthorityId = std::uint32_t;  // 0 is "no recorded authority"
using Stamp = std::int64_t;         // nanoseconds; 0 asks for the latest

inline constexpr Stamp kKeepAll = -1;  // a cache length without end

// One cache line: a pose and the frame it is told in.
struct alignas(64) Sample {
  Pose pose;
  FrameId parent = 0;
};
static_assert(sizeof(Sample) == 64);

// What a sample's search came to.
enum class Found { ok, empty, only_other, too_new, too_old };

class History {
 public:
  History(bool is_static, Stamp cache_length) : is_static_(is_static), cache_length_(cache_length) {}

  bool is_static() const { return is_static_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  Stamp time(std::size_t i) const { return chunks_[slot(i) / kChunk]->stamps[slot(i) % kChunk]; }
  const Sample& sample(std::size_t i) const {
    return is_static_ ? fixed_ : chunks_[slot(i) / kChunk]->samples[slot(i) % kChunk];
  }
  // Stamps of both ends; 0 for a static or empty history, as tf2 has it.
  Stamp oldest() const { return is_static_ || empty() ? 0 : time(0); }
  Stamp newest() const { return is_static_ || empty() ? 0 : time(size_ - 1); }
  // The frame the newest sample is told in; 0 when empty.
  FrameId parent() const { return empty() ? 0 : sample(size_ - 1).parent; }
  // True while every sample has the same parent: paths through this history may then be remembered.
  bool one_parent() const { return one_parent_; }

  // Stores a sample as tf2 does: prunes by the newest stamp before this one, refuses what is older than the cache
  // length (false), takes an exact repetition silently, puts equal stamps behind each other.
  bool insert(Stamp stamp, const Sample& sample);
  // Forgets all samples of a dynamic history; static ones stay.
  void clear();

  // The pose at `stamp` and the frame it is told in. No extrapolation, ever.
  Found at(Stamp stamp, Pose& pose, FrameId& parent) const;

 private:
  // Large enough that inserting seldom allocates, small enough for a tree of a thousand frames.
  static constexpr std::size_t kChunk = 256;
  struct Chunk {
    std::array<Stamp, kChunk> stamps;
    std::array<Sample, kChunk> samples;
  };

  std::size_t slot(std::size_t i) const { return head_ + i; }
  Stamp& time_slot(std::size_t i) { return chunks_[slot(i) / kChunk]->stamps[slot(i) % kChunk]; }
  Sample& sample_slot(std::size_t i) { return chunks_[slot(i) / kChunk]->samples[slot(i) % kChunk]; }
  void append_slot();
  void drop_older_than(Stamp stamp);
  bool repeats(std::size_t end, Stamp stamp, const Sample& sample) const;
  std::size_t first_after(Stamp stamp) const;
  Found take(std::size_t i, Pose& pose, FrameId& parent) const;

  std::vector<std::unique_ptr<Chunk>> chunks_;
  Sample fixed_;  // the one sample of a static history
  std::size_t head_ = 0;  // slots before the first sample in the first chunk
  std::size_t size_ = 0;
  bool is_static_;
  bool one_parent_ = true;
  Stamp cache_length_;
};

}  // namespace coframe
