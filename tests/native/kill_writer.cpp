// SPDX-License-Identifier: Apache-2.0
// Kills the writer of a shared tree (SIGKILL) at random moments under load, again and again. This process reads
// meanwhile: what was stored before must be found, no pose may be wrong, and new samples must arrive soon.
//
//   kill_writer KILLS

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "core/buffer.hpp"
#include "shared/segment.hpp"
#include "shared_fixture.hpp"

namespace {

using namespace shared_fixture;
using Clock = std::chrono::steady_clock;

constexpr int kFrames = 5;
const std::string kName = "kill-writer-" + std::to_string(getpid());
const std::string kFolder = "/dev/shm/coframe-test-" + std::to_string(getuid());
constexpr auto kLate = std::chrono::seconds(5);

// The names must outlive the query.
LookupQuery query_of(std::string_view target, std::string_view source, Stamp stamp) {
  LookupQuery query;
  query.target = target;
  query.source = source;
  query.stamp = stamp;
  return query;
}

std::string frame(int i) { return "f" + std::to_string(i); }
std::string parent(int i) { return i == 0 ? "map" : frame(i - 1); }
Stamp now() { return kStart + Clock::now().time_since_epoch() / std::chrono::nanoseconds(1) % (100'000 * kSecond); }

void insert(Buffer& buffer, int i, Stamp stamp, bool is_static = false) {
  buffer.insert(parent(i), is_static ? "plate" : frame(i), stamp, values_of(parent(i), stamp), is_static, 0);
}

// Waits for its turn, then writes until it is killed: samples in order, late ones, and a changing static transform.
[[noreturn]] void write() {
  const auto segment = Segment::open(kFolder, kName, kCache);
  while (!segment->try_to_write()) segment->wait_for_vacancy(kSecond);
  Buffer buffer(segment->writer());
  std::mt19937 random(static_cast<unsigned>(getpid()));
  for (;;) {
    const Stamp stamp = now();
    for (int i = 0; i < kFrames; ++i) insert(buffer, i, stamp);
    if (random() % 4 == 0)
      insert(buffer, static_cast<int>(random() % kFrames), stamp - static_cast<Stamp>(random() % 50'000'000));
    if (random() % 8 == 0) insert(buffer, 1, kStart + static_cast<Stamp>(random() % kSecond), true);
    if (random() % 64 == 0) usleep(100);
  }
}

pid_t start_writer() {
  const pid_t writer = fork();
  if (writer == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // also if the test fails
    write();
  }
  return writer;
}

// The chain map <- f0 ... at one time: composing the poses of its edges gives the pose of the chain.
class Reader {
 public:
  explicit Reader(const std::shared_ptr<Segment>& segment) { buffer_.follow(segment->reader()); }

  Stamp newest() const {
    const std::string last = frame(kFrames - 1);
    LookupQuery query = query_of("map", last, 0);
    LookupResult result;
    Failure failure;
    return buffer_.lookup_by_name(query, result, failure) ? result.stamp : 0;
  }
  void check(Stamp stamp) {
    Pose expected;
    for (int i = kFrames - 1; i >= 0; --i) {
      const Pose step = edge(parent(i), frame(i), stamp);
      if (!is_pose_at(step, parent(i), stamp)) fail("a pose is wrong");
      compose(step, expected);
    }
    const Pose chain = edge("map", frame(kFrames - 1), stamp);
    for (int i = 0; i < 3; ++i) {
      if (std::abs(chain.p[i] - expected.p[i]) > 1e-6 * (1 + std::abs(expected.p[i])))
        fail("the pose of a chain is wrong");
    }
    const Pose plate = edge("f0", "plate", 0);
    if (!is_pose_at(plate, "f0", kStart + static_cast<Stamp>(std::llround(plate.p[0] * 1e9))))
      fail("the static pose is torn");
    ++checks_;
  }
  long checks() const { return checks_; }

 private:
  Pose edge(const std::string& target, const std::string& source, Stamp stamp) const {
    LookupQuery query = query_of(target, source, stamp);
    LookupResult result;
    Failure failure;
    if (!buffer_.lookup_by_name(query, result, failure)) fail("a stored transform is not found: " + source);
    return result.pose;
  }

  Buffer buffer_{kCache};
  long checks_ = 0;
};

}  // namespace

int main(int count, char** arguments) {
  const int kills = count > 1 ? std::atoi(arguments[1]) : 100;
  const auto segment = Segment::open(kFolder, kName, kCache);
  // This process only reads: it leaves the writing to others.
  pid_t writer = start_writer(), next = start_writer();
  (void)next;
  Reader reader(segment);
  std::vector<double> gaps;
  std::mt19937 random(7);
  // The writers wait until this process, which has created the tree, gives up writing.
  segment->stop_writing();
  const auto wait_for_newer = [&](Stamp than) {
    for (const auto start = Clock::now(); reader.newest() <= than;) {
      if (Clock::now() - start > kLate) fail("no new samples arrive");
    }
  };
  wait_for_newer(0);
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  for (int kill_number = 0; kill_number < kills; ++kill_number) {
    const auto end = Clock::now() + std::chrono::microseconds(random() % 20'000);
    const Stamp known = reader.newest();
    while (Clock::now() < end) reader.check(known - static_cast<Stamp>(random() % 10'000'000));
    const auto killed = static_cast<pid_t>(segment->writer_process());
    kill(killed, SIGKILL);
    const Stamp last = reader.newest();
    const auto start = Clock::now();
    reader.check(known);
    wait_for_newer(last + 1'000'000);
    gaps.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    reader.check(known);
    waitpid(killed, nullptr, 0);
    (killed == writer ? writer : next) = start_writer();
  }
  for (const pid_t process : {writer, next}) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
  segment->close();
  if (gaps.empty()) return 0;
  std::sort(gaps.begin(), gaps.end());
  std::printf("%d writers killed, %ld checks; new samples after %.1f ms (median), %.1f ms (longest)\n", kills,
              reader.checks(), gaps[gaps.size() / 2], gaps.back());
}
