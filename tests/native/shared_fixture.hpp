// SPDX-License-Identifier: Apache-2.0
// A tree in a block of memory that tests copy, map twice and damage by ending its writer, and the operations on it.
#pragma once

#include <sys/mman.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "core/tree.hpp"

namespace shared_fixture {

using namespace coframe;

constexpr Stamp kSecond = 1'000'000'000, kStart = 1000 * kSecond, kTick = 10'000'000, kCache = 10 * kSecond;

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "Failed: %s\n", what.c_str());
  std::exit(1);
}

struct Header {
  std::size_t used = sizeof(Header);
  TreeData tree;
};

// Takes memory from a block in order.
class BlockMemory final : public Memory {
 public:
  BlockMemory(std::byte* block, std::size_t size) : block_(block), size_(size) {}
  void* take(std::size_t size, std::size_t alignment) override {
    const std::size_t start = (header().used + alignment - 1) / alignment * alignment;
    if (start + size > size_) throw std::bad_alloc();
    header().used = start + size;
    return block_ + start;
  }
  bool has_room(std::size_t size) override { return header().used + size + kAlignment <= size_; }

 private:
  Header& header() { return *reinterpret_cast<Header*>(block_); }
  std::byte* block_;
  std::size_t size_;
};

// A block of shared memory; copies of its content at other addresses are equally usable.
class Block {
 public:
  static constexpr std::size_t kSize = 8 << 20;
  Block()
      : start_(
            static_cast<std::byte*>(mmap(nullptr, kSize, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  Block(const Block&) = delete;
  ~Block() { munmap(start_, kSize); }

  void create() {
    new (start_) Header;
    BlockMemory memory(start_, kSize);
    initialize(header().tree, memory, kCache, 2);
  }
  void copy(const Block& other) { std::memcpy(start_, other.start_, other.used()); }
  std::size_t used() const { return reinterpret_cast<const Header*>(start_)->used; }
  std::byte* data() const { return start_; }
  SharedTreeData writer() const { return {&header().tree, std::make_shared<BlockMemory>(start_, kSize), nullptr}; }
  SharedTreeData reader() const { return {&header().tree, nullptr, nullptr}; }

 private:
  Header& header() const { return *reinterpret_cast<Header*>(start_); }
  std::byte* start_;
};

// The pose of every sample follows from its parent and its stamp, so a mixture of two is recognized.
inline TransformValues values_of(const std::string& parent, Stamp stamp) {
  const double x = static_cast<double>(stamp - kStart) * 1e-9;
  const double y = parent.back();
  const double angle = 0.01 * x + 0.5;
  return {{x, y, 0.5 * x + y}, {0.0, 0.0, std::sin(angle / 2), std::cos(angle / 2)}};
}

inline bool is_pose_at(const Pose& pose, const std::string& parent, Stamp stamp) {
  const TransformValues v = values_of(parent, stamp);
  for (int i = 0; i < 3; ++i) {
    if (std::abs(pose.p[i] - v.translation[i]) > 1e-9) return false;
  }
  const double sign = pose.q[2] * v.rotation[2] + pose.q[3] * v.rotation[3] < 0 ? -1 : 1;  // q and -q are one rotation
  for (int i = 0; i < 4; ++i) {
    if (std::abs(sign * pose.q[i] - v.rotation[i]) > 1e-9) return false;
  }
  return true;
}

inline Inserted put(Tree& tree, const std::string& parent, const std::string& child, Stamp stamp,
                    bool is_static = false) {
  return tree.insert(parent, child, stamp, values_of(parent, stamp), is_static, 0);
}

// A change of a tree, and what precedes it.
struct Operation {
  const char* name;
  std::function<void(Tree&)> prepare, change;
  bool may_be_empty = false;  // the frame loses its samples on the way, as in tf2
};

inline void fill(Tree& tree, int count, int first = 0) {
  for (int i = first; i < first + count; ++i) put(tree, "map", "base", kStart + i * kTick);
}

inline std::vector<Operation> operations() {
  return {
      {"append", [](Tree& t) { fill(t, 20); }, [](Tree& t) { fill(t, 1, 20); }},
      {"first sample", [](Tree& t) { put(t, "map", "other", kStart); }, [](Tree& t) { fill(t, 1); }},
      {"replace a short chunk", [](Tree& t) { fill(t, 32); }, [](Tree& t) { fill(t, 1, 32); }},
      {"insert into a short chunk that is full", [](Tree& t) { fill(t, 32); },
       [](Tree& t) { put(t, "map", "base", kStart + 30 * kTick + 1); }},
      {"append after a short chunk was cleared",
       [](Tree& t) {
         fill(t, 20);
         t.clear();
       },
       [](Tree& t) { fill(t, 1, 20); }},
      {"append to a new chunk", [](Tree& t) { fill(t, 256); }, [](Tree& t) { fill(t, 1, 256); }},
      {"append to a new chunk and directory", [](Tree& t) { fill(t, 512); }, [](Tree& t) { fill(t, 1, 512); }},
      {"append to a used chunk, and drop samples", [](Tree& t) { fill(t, 1280); }, [](Tree& t) { fill(t, 1, 1280); }},
      {"drop a chunk, and append to it",
       [](Tree& t) {
         fill(t, 511);
         fill(t, 1, 1300);
       },
       [](Tree& t) { fill(t, 1, 1301); }},
      {"drop many samples", [](Tree& t) { fill(t, 300); }, [](Tree& t) { fill(t, 2, 1260); }},
      {"insert before newer samples", [](Tree& t) { fill(t, 20); },
       [](Tree& t) { put(t, "map", "base", kStart + 17 * kTick + 1); }},
      {"insert before samples of another chunk", [](Tree& t) { fill(t, 258); },
       [](Tree& t) { put(t, "map", "base", kStart + 250 * kTick + 1); }},
      {"insert before a full chunk", [](Tree& t) { fill(t, 256); },
       [](Tree& t) { put(t, "map", "base", kStart + 253 * kTick + 1); }},
      {"insert before all samples", [](Tree& t) { fill(t, 6); }, [](Tree& t) { put(t, "map", "base", kStart - 1); }},
      {"repeat a sample", [](Tree& t) { fill(t, 20); }, [](Tree& t) { fill(t, 1, 19); }},
      {"change the parent", [](Tree& t) { fill(t, 20); }, [](Tree& t) { put(t, "odom", "base", kStart + 20 * kTick); }},
      {"insert another parent before newer samples", [](Tree& t) { fill(t, 20); },
       [](Tree& t) { put(t, "odom", "base", kStart + 18 * kTick + 1); }},
      {"first static", [](Tree& t) { put(t, "map", "other", kStart); },
       [](Tree& t) { put(t, "map", "base", kStart, true); }},
      {"change a static", [](Tree& t) { put(t, "map", "base", kStart, true); },
       [](Tree& t) { put(t, "odom", "base", kStart + kSecond, true); }},
      {"static becomes dynamic", [](Tree& t) { put(t, "map", "base", kStart, true); }, [](Tree& t) { fill(t, 1, 3); },
       true},
      {"dynamic becomes static", [](Tree& t) { fill(t, 300); },
       [](Tree& t) { put(t, "map", "base", kStart + kSecond, true); }, true},
      {"clear", [](Tree& t) { fill(t, 300); }, [](Tree& t) { t.clear(); }, true},
  };
}

// The samples of one frame: stamp and parent, with their number.
using Samples = std::map<std::pair<Stamp, std::string>, int>;

// Reads all samples, and checks that each is whole.
inline Samples samples_of(const Tree& tree, const char* child, const std::string& where) {
  Samples samples;
  const History::View history = tree.history(tree.find(child));
  Stamp before = kFirstStamp;
  for (std::size_t i = 0; i < history.size(); ++i) {
    const Sample sample = history.sample(i);
    const std::string parent = tree.name(sample.parent);
    // A static sample has no stamp; its position says which one it is.
    const Stamp stamp =
        history.is_static() ? kStart + static_cast<Stamp>(std::llround(sample.pose.p[0] * 1e9)) : history.time(i);
    if (!is_pose_at(sample.pose, parent, stamp)) fail(where + ": a sample is torn");
    if (stamp < before) fail(where + ": the samples are not in order");
    before = stamp;
    ++samples[{stamp, parent}];
  }
  return samples;
}

}  // namespace shared_fixture
