// SPDX-License-Identifier: Apache-2.0
// One writer inserts samples in order into a cache that keeps two samples per edge. The latest transform must always be
// available, no matter how fast samples are dropped.

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "core/buffer.hpp"

namespace {

using namespace coframe;

constexpr TransformValues kHere{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}};

void expect(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "Failed: %s\n", what);
  std::_Exit(1);
}

}  // namespace

int main(int argc, char** argv) {
  Buffer buffer(0);
  const AuthorityId authority = buffer.authority("writer");
  const auto insert = [&](Stamp stamp) {
    buffer.insert("map", "odom", stamp, kHere, false, authority);
    buffer.insert("odom", "base", stamp, kHere, false, authority);
  };
  insert(1);
  const FrameId map = buffer.find("map"), odom = buffer.find("odom"), base = buffer.find("base");
  std::atomic<bool> stopped{false};
  std::thread writer([&] {
    for (Stamp stamp = 2; !stopped; ++stamp) insert(stamp);
  });
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(argc > 1 ? std::atof(argv[1]) : 10);
  long lookups = 0;
  for (; std::chrono::steady_clock::now() < end; ++lookups) {
    Stamp stamp = 0;
    Pose pose;
    Failure failure;
    expect(buffer.lookup_by_id(map, base, stamp, pose, failure), "the latest transform is not available");
    stamp = 0;
    expect(buffer.lookup_full_by_id(map, stamp, base, 0, odom, pose, failure),
           "the latest transform through a fixed frame is not available");
  }
  stopped = true;
  writer.join();
  std::printf("%ld lookups\n", lookups);
  return 0;
}
