// SPDX-License-Identifier: Apache-2.0
// Opens frozen buffers with damaged tables and samples and looks up transforms in them under a sanitizer.
// Deterministic.

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <random>
#include <string>
#include <vector>

#include "core/buffer.hpp"
#include "core/dump.hpp"
#include "core/frozen.hpp"

namespace {

using namespace coframe;

constexpr Stamp kSecond = 1'000'000'000;

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "Failed: %s\n", what);
  std::_Exit(1);
}

// A buffer of the exact size, so that the sanitizer detects every access beyond its end.
struct Exact {
  explicit Exact(const std::string& bytes)
      : data(static_cast<std::uint8_t*>(::operator new(std::max<std::size_t>(bytes.size(), 1), kAlignment))),
        size(bytes.size()) {
    std::copy(bytes.begin(), bytes.end(), data);
  }
  Exact(const Exact&) = delete;
  Exact& operator=(const Exact&) = delete;
  ~Exact() { ::operator delete(data, kAlignment); }

  static constexpr std::align_val_t kAlignment{64};
  std::uint8_t* data;
  std::size_t size;
};

std::shared_ptr<Buffer> filled() {
  Buffer buffer(kKeepAll);
  const AuthorityId authority = buffer.authority("fuzzer");
  for (int i = 1; i <= 600; ++i) {
    const TransformValues values{{0.01 * i, 0, 1}, {0, 0, 0.1, 1}};
    for (const char* child : {"a", "b", "c"}) {
      const char parent[] = {static_cast<char>(*child - 1), 0};
      buffer.insert(*child == 'a' ? "root" : parent, child, i * kSecond / 50, values, false, authority);
    }
    if (i % 200 == 0) buffer.insert(i == 200 ? "a" : "root", "reparented", i * kSecond / 50, values, false, authority);
  }
  buffer.insert("c", "tool", 0, {{1, 2, 3}, {0, 0, 0, 1}}, true, authority);
  return buffer.snapshot();
}

class Fuzzer {
 public:
  Fuzzer() {
    filled()->read([this](const Tree& tree) {
      table_ = frozen_table(tree);
      chunks_ = frozen_chunks(tree, 0, frozen_chunk_count(tree));
      return true;
    });
  }

  void run(int cases) {
    open(table_, chunks_);
    expect(opened_ == 1, "an undamaged buffer is refused");
    for (int i = 0; i < cases; ++i) {
      std::string table = table_, chunks = chunks_;
      for (unsigned n = rng_() % 4; n > 0; --n) damage(table);
      for (unsigned n = rng_() % 40; n > 0; --n) damage(chunks);
      if (rng_() % 8 == 0) table.resize(rng_() % table.size());
      if (rng_() % 8 == 0) chunks.resize(rng_() % 8 * sizeof(Chunk));
      open(table, chunks);
    }
    std::printf("%d cases, %d of them opened\n", cases, opened_ - 1);
    expect(opened_ > cases / 10 && opened_ < cases, "the cases do not cover both outcomes");
  }

 private:
  void damage(std::string& bytes) {
    static const std::array<std::uint64_t, 8> edge_cases{0,          1,          0xff,  0x7fffffff,
                                                         0xffffffff, 1ull << 63, ~0ull, ~0ull >> 1};
    const std::uint64_t number = rng_() % 2 == 0 ? edge_cases[rng_() % edge_cases.size()] : rng_();
    const std::size_t size = std::size_t{1} << rng_() % 4, at = rng_() % (bytes.size() - size);
    std::memcpy(&bytes[at], &number, size);
  }

  void open(const std::string& table, const std::string& chunks) {
    const Exact head(table);
    const auto samples = std::make_shared<const Exact>(chunks);
    const char* reason;
    const auto buffer = Buffer::restored(kKeepAll, {head.data, head.size}, {samples->data, samples->size},
                                         std::shared_ptr<GuardedMemory>(samples, nullptr), reason);
    if (!buffer) return;
    ++opened_;
    look_up_some(*buffer);
    look_up_some(*buffer->snapshot());
  }

  void look_up_some(Buffer& buffer) {
    const std::vector<std::string> names = buffer.frame_names();
    for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 3); ++i) {
      const FrameId target = buffer.find(names[i]), source = buffer.find(names[names.size() - 1 - i]);
      if (target == 0 || source == 0) continue;
      for (const Stamp requested : {Stamp{0}, kSecond, 5 * kSecond, static_cast<Stamp>(rng_())}) {
        Stamp stamp = requested;
        Pose pose;
        Failure failure;
        if (buffer.lookup_by_id(target, source, stamp, pose, failure)) continue;
        expect(!buffer.read([&](const Tree& tree) { return lookup_text(failure, tree); }).empty(),
               "a failure has no text");
      }
      many(buffer, names[i], names[names.size() - 1 - i]);
    }
    buffer.edges();
    buffer.encode(false);
    buffer.encode(true);
    buffer.read([](const Tree& tree) { return frames_as_yaml(tree); });
    buffer.read([](const Tree& tree) { return frames_as_dot(tree, kSecond); });
  }

  void many(const Buffer& buffer, const std::string& target, const std::string& source) {
    std::vector<Stamp> stamps(200);
    for (Stamp& stamp : stamps) stamp = static_cast<Stamp>(rng_() % (13 * kSecond));
    std::vector<double> poses(7 * stamps.size()), twists(6 * stamps.size());
    LookupQuery query;
    query.target = target;
    query.source = source;
    Failure failure;
    const Batch batch{stamps.size(), stamps.data(), poses.data(), twists.data(), nullptr, Batch::Missing::nan};
    buffer.lookup_many(query, nullptr, batch, 1, failure);
    buffer.stamps_between(query, kSecond, 3 * kSecond, stamps, failure);
  }

  std::mt19937_64 rng_{20};
  std::string table_, chunks_;
  int opened_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Fuzzer().run(argc > 1 ? std::atoi(argv[1]) : 3000);
  return 0;
}
