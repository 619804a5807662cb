// SPDX-License-Identifier: Apache-2.0
// One writer of a shared tree and several readers in one process under a sanitizer: lookups, waits and watches, and
// readers that join and leave. The pose of every sample follows from its parent and its stamp.
//
//   shared_stress SECONDS

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>

#include "core/buffer.hpp"
#include "shared/segment.hpp"
#include "shared_fixture.hpp"

namespace {

using namespace shared_fixture;
using Clock = std::chrono::steady_clock;

constexpr int kReaders = 3;
std::atomic<Stamp> written{0};
std::atomic<bool> stopped{false};

void insert_all(Buffer& buffer) {
  std::mt19937 random(1);
  for (Stamp stamp = kStart; !stopped; stamp += kTick) {
    buffer.insert("map", "base", stamp, values_of("map", stamp), false, 0);
    if (random() % 4 == 0) {
      const Stamp late = stamp - static_cast<Stamp>(random() % (50 * kTick));
      buffer.insert("map", "base", late, values_of("map", late), false, 0);
    }
    if (random() % 16 == 0) buffer.insert("map", "plate", stamp, values_of("map", stamp), true, 0);
    written.store(stamp);
    if (random() % 8 == 0) std::this_thread::sleep_for(std::chrono::microseconds(50));
  }
}

// Returns the stamp of the result: 0 asks for the latest. A sample that the writer has dropped in the meantime is not
// looked up.
Stamp look_up(Buffer& buffer, Stamp stamp, const char* what) {
  LookupQuery query;
  query.target = "map";
  query.source = "base";
  query.stamp = stamp;
  LookupResult result;
  Failure failure;
  if (!buffer.lookup_by_name(query, result, failure)) {
    if (stamp != 0 && written.load() > stamp + kCache - kTick) return stamp;
    fail(std::string(what) + " is not found");
  }
  if (!is_pose_at(result.pose, "map", result.stamp)) fail(std::string(what) + " is wrong");
  return result.stamp;
}

void look_up_all(const std::shared_ptr<Segment>& segment, unsigned seed) {
  std::mt19937 random(seed);
  while (!stopped) {
    Buffer buffer(kCache);
    if (!buffer.follow(segment->reader())) fail("an empty buffer does not follow");
    const auto mailbox = std::make_shared<Mailbox>();
    const auto watch = std::make_shared<Watch>("base", mailbox, 1);
    buffer.wait_queue().add(watch);
    for (int i = 0; i < 300 && !stopped; ++i) {
      const Stamp newest = written.load();
      if (newest < kStart + 200 * kTick) continue;
      look_up(buffer, newest - static_cast<Stamp>(random() % (100 * kTick)), "a stored transform");
      if (i % 100 != 0) continue;
      LookupQuery query;
      query.target = "map";
      query.source = "base";
      query.stamp = newest + 10 * kTick;
      const auto wait = std::make_shared<Wait>(query);
      const ScopedWait queued(buffer.wait_queue(), wait);
      for (int turn = 0; !wait->wait_for(kSecond) && !stopped; ++turn) {
        if (turn > 20) fail("a wait does not end");
      }
      if (wait->done() && !is_pose_at(wait->result().pose, "map", query.stamp)) fail("the result of a wait is wrong");
    }
    buffer.wait_queue().remove(watch);
    const Stamp newest = written.load();
    buffer.stop_following();
    // The writer can have replaced all samples of that time while they were copied.
    if (newest >= kStart + 200 * kTick && look_up(buffer, 0, "a copied transform") < newest) fail("a copy is too old");
    buffer.insert("map", "own", kStart, values_of("map", kStart), false, 0);
    if (buffer.find("own") == 0) fail("a buffer of its own does not store");
  }
}

}  // namespace

int main(int count, char** arguments) {
  const int seconds = count > 1 ? std::atoi(arguments[1]) : 10;
  const auto segment =
      Segment::open("/dev/shm/coframe-test-" + std::to_string(getuid()), "stress-" + std::to_string(getpid()), kCache);
  if (!segment->try_to_write()) fail("there is another writer");
  Buffer buffer(segment->writer());
  std::vector<std::thread> threads;
  threads.emplace_back(insert_all, std::ref(buffer));
  for (int i = 0; i < kReaders; ++i) threads.emplace_back(look_up_all, segment, static_cast<unsigned>(i));
  std::this_thread::sleep_for(std::chrono::seconds(seconds));
  stopped = true;
  for (std::thread& thread : threads) thread.join();
  segment->close();
  std::printf("%lld samples written\n", static_cast<long long>((written - kStart) / kTick));
}
