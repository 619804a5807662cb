// SPDX-License-Identifier: Apache-2.0
// Readers and writers on one buffer under a sanitizer, with poses that reveal torn reads. Every sample is a function of
// its parent, its child and its stamp: x is the time, y encodes the parent and z the child, and the rotation is about z
// by an angle that grows with time. Interpolation preserves this, so every result of a reader can be checked.

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "core/buffer.hpp"
#include "core/dump.hpp"

namespace {

using namespace coframe;
using Clock = std::chrono::steady_clock;

constexpr int kReaders = 4, kWriters = 2;
constexpr int kDepth = 40;           // edges of the chain
constexpr int kParents = 3;          // parents of the reparented frame
constexpr int kMaxNewFrames = 1000;  // per round
constexpr std::size_t kRun = 100;    // samples of an edge that are inserted at once
constexpr Stamp kSecond = 1'000'000'000, kTick = 1'000'000, kStart = 1000 * kSecond;
constexpr Stamp kParentDuration = 50 * kTick;  // how long the reparented frame keeps a parent
constexpr double kTolerance = 1e-9;

[[noreturn]] void fail(const std::string& what) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::fprintf(stderr, "Failed: %s\n", what.c_str());
  std::_Exit(1);
}

void expect(bool holds, const char* what, const std::string& facts = "") {
  if (!holds) fail(what + (" " + facts));
}

// A pose whose rotation is about z.
struct Planar {
  double x, y, z, angle;
};

double seconds(Stamp stamp) { return static_cast<double>(stamp - kStart) * 1e-9; }
// Slow enough for half an hour between two samples: after a clear(), a delayed sample may be that old.
double angle_at(double x) { return 0.0015 * x + 0.5; }

Planar sample_of(double x, int parent, int child) { return {x, 1.0 * parent, 1.0 * child, angle_at(x)}; }

Planar operator*(const Planar& a, const Planar& b) {
  const double c = std::cos(a.angle), s = std::sin(a.angle);
  return {a.x + c * b.x - s * b.y, a.y + s * b.x + c * b.y, a.z + b.z, a.angle + b.angle};
}

Planar inverse(const Planar& a) {
  const double c = std::cos(a.angle), s = std::sin(a.angle);
  return {-c * a.x - s * a.y, s * a.x - c * a.y, -a.z, -a.angle};
}

TransformValues values_of(const Planar& p) {
  return {{p.x, p.y, p.z}, {0.0, 0.0, std::sin(p.angle / 2), std::cos(p.angle / 2)}};
}

std::string text(const Pose& p) {
  char line[200];
  std::snprintf(line, sizeof line, "(%.9f %.9f %.9f) (%.9f %.9f %.9f %.9f)", p.p[0], p.p[1], p.p[2], p.q[0], p.q[1],
                p.q[2], p.q[3]);
  return line;
}

bool has_rotation(const Pose& pose, double angle) {
  const double* q = pose.q;
  const double off =
      q[2] * std::cos(angle / 2) - q[3] * std::sin(angle / 2);  // half of the difference, if that is small
  return std::abs(dot(q, q) - 1.0) < kTolerance && std::abs(off) < kTolerance;
}

void expect_pose(const Pose& pose, const Planar& expected, const char* what) {
  const bool same = std::abs(pose.p[0] - expected.x) < 1e-6 && std::abs(pose.p[1] - expected.y) < 1e-6 &&
                    std::abs(pose.p[2] - expected.z) < 1e-6;
  if (same && has_rotation(pose, expected.angle)) return;
  Pose expected_pose;
  for (int i = 0; i < 3; ++i) expected_pose.p[i] = std::array{expected.x, expected.y, expected.z}[i];
  expected_pose.q[2] = std::sin(expected.angle / 2);
  expected_pose.q[3] = std::cos(expected.angle / 2);
  fail(what + (" " + text(pose)) + ", expected " + text(expected_pose));
}

// Checks one sample of an edge, or an interpolation between two: all its numbers must be from the same edge and time.
void expect_sample(const Pose& pose, int parent, int child, const char* what) {
  const bool whole = std::abs(pose.p[1] - parent) < kTolerance && std::abs(pose.p[2] - child) < kTolerance;
  expect(whole && has_rotation(pose, angle_at(pose.p[0])), what, text(pose));
}

void expect_reason(const Failure& failure) {
  switch (failure.code) {
    case ErrorCode::too_new:
      return expect(failure.requested > failure.latest,
                    "the error is too_new, but the time is not later than the latest sample");
    case ErrorCode::too_old:
      return expect(failure.requested < failure.earliest,
                    "the error is too_old, but the time is not earlier than the oldest sample");
    case ErrorCode::only_other:
      return expect(failure.requested != failure.latest,
                    "the error is only_other, but the time is that of the only sample");
    default: return expect(failure.code != ErrorCode::none, "a failure has no error code");
  }
}

// The content of the buffer:
//   c0 <- c1 <- ... <- c40      samples in order and out of order; every tenth edge is static
//   p0, p1, p2 <- reparented    changes its parent every 50 ms; sometimes removed
//   p0 <- switching             alternates between static (x negative) and dynamic (x positive)
//   p0 <- n0, n1, n2, ...       new frames
//   p0 <- w0_0, w0_1, ...       the frames that reader 0 waits for; 8 samples each, inserted one by one
std::string chain_name(int i) { return "c" + std::to_string(i); }
std::string parent_name(int i) { return "p" + std::to_string(i); }
std::string new_name(int i) { return "n" + std::to_string(i); }
bool edge_is_static(int child) { return child % 10 == 0; }
Planar edge_pose(int child, Stamp stamp) {
  return sample_of(edge_is_static(child) ? 0.25 : seconds(stamp), child - 1, child);
}
int parent_at(Stamp stamp) { return static_cast<int>(stamp / kParentDuration % kParents); }
std::string promised_name(int reader, int number) {
  return "w" + std::to_string(reader) + "_" + std::to_string(number / 8);
}
Stamp promised_stamp(int number) { return kStart + number * kTick; }
constexpr int kReparented = 100, kSwitching = 101, kNew = 102, kPromised = 103;

// The kinds of checks by readers.
enum class Kind {
  chain,
  full,
  latest,
  reparented,
  switching,
  new_frame,
  frames,
  texts,
  wait,
  promise,
  snapshot,
  batch
};
constexpr std::size_t kKinds = 12;

struct Statistics {
  std::atomic<std::uint64_t> successes{0}, failures{0}, inserted{0}, worst_insert_ns{0}, insert_ns{0};
  std::array<std::atomic<std::uint64_t>, kKinds> found{};  // successes by kind

  void count_success(Kind kind) { found[static_cast<std::size_t>(kind)].fetch_add(1); }
};

struct World {
  World(Stamp cache, bool in_order)
      : buffer(cache), in_order(in_order), chain_is_kept(in_order && (cache == kKeepAll || cache >= 300 * kTick)) {}

  Buffer buffer;
  const bool in_order;       // samples arrive in order, so that readers rarely need to retry
  const bool chain_is_kept;  // the chain's latest transform is never cleared or pruned once it exists
  std::atomic<bool> has_chain{false};
  std::atomic<Stamp> now{kStart};
  std::atomic<int> new_frames{0};                     // inserted so far
  std::atomic<std::uint64_t> clears{0};               // odd while a clear() is running
  std::array<std::atomic<int>, kReaders> promised{};  // number of the sample that a reader waits for; 0: inserted
  std::atomic<bool> stopped{false};
};

class Writer {
 public:
  Writer(World& world, Statistics& statistics, int number, unsigned seed)
      : world_(world),
        statistics_(statistics),
        number_(number),
        rng_(seed),
        stream_(world.buffer.open_stream(false, "stream")),
        authority_(world.buffer.authority("writer")) {}

  void run() {
    while (!world_.stopped.load()) {
      if (world_.in_order) {
        publish_chain(next_stamp());
        world_.has_chain.store(true);
        continue;
      }
      run_step(rng_() % 100);
      for (int reader = 0; reader < kReaders; ++reader) insert_promised(reader);
    }
  }

 private:
  void run_step(unsigned choice) {
    if (choice < 28) return publish_chain(next_stamp());
    if (choice < 30) return insert_run();
    if (choice < 45) return insert_edge(1 + static_cast<int>(rng_() % kDepth), past_stamp());
    if (choice < 75) return insert_reparented(choice < 70 ? next_stamp() : past_stamp());
    if (choice < 94) return insert_switching(next_stamp());
    if (choice < 99) return insert_new();
    if (number_ == 0 && rng_() % 10 == 0) return clear();
    if (rng_() % 20 == 0) world_.buffer.remove_frame("reparented");
  }

  Stamp next_stamp() { return world_.now.fetch_add(kTick) + kTick; }
  Stamp past_stamp() {
    const Stamp now = world_.now.load();
    return std::max(kStart, now - static_cast<Stamp>(rng_() % 500) * kTick);
  }

  void publish_chain(Stamp stamp) {
    std::vector<std::string> names;
    for (int i = 0; i <= kDepth; ++i) names.push_back(chain_name(i));
    std::vector<TransformView> views;
    for (int child = 1; child <= kDepth; ++child) {
      if (world_.in_order && edge_is_static(child)) {
        insert_edge(child, stamp);
      } else if (!edge_is_static(child)) {
        views.push_back({names[child - 1], names[child], stamp, values_of(edge_pose(child, stamp))});
      }
    }
    const std::string bytes = encode_tf_message(views);
    std::size_t stored = 0;
    const auto start = Clock::now();
    const DecodeFailure failure =
        world_.buffer.ingest(stream_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), stored);
    record_insertion(start);
    expect(!failure.reason, "a valid message was refused");
  }

  void insert_edge(int child, Stamp stamp) {
    insert(chain_name(child - 1), chain_name(child), stamp, edge_pose(child, stamp), edge_is_static(child));
  }

  // Inserts many samples of one edge at once.
  void insert_run() {
    const int child = 1 + static_cast<int>(rng_() % kDepth);
    if (edge_is_static(child)) return;
    std::vector<Stamp> stamps(kRun);
    std::vector<double> rows;
    for (Stamp& stamp : stamps) {
      stamp = next_stamp();
      const TransformValues values = values_of(edge_pose(child, stamp));
      rows.insert(rows.end(), values.translation, values.translation + 3);
      rows.insert(rows.end(), values.rotation, values.rotation + 4);
    }
    const std::string parent = chain_name(child - 1), name = chain_name(child);
    std::size_t stored = 0, bad_row = 0;
    const Track track{parent, name, stamps.size(), stamps.data(), rows.data()};
    const auto start = Clock::now();
    const unsigned refusals = world_.buffer.insert_many(track, false, authority_, stored, bad_row);
    record_insertion(start);
    expect(refusals == 0, "valid transforms were refused");
  }

  void insert_reparented(Stamp stamp) {
    const int parent = parent_at(stamp);
    insert(parent_name(parent), "reparented", stamp, sample_of(seconds(stamp), parent, kReparented), false);
  }

  void insert_switching(Stamp stamp) {
    const bool is_static = rng_() % 4 == 0;
    insert(parent_name(0), "switching", stamp, sample_of((is_static ? -1 : 1) * seconds(stamp), 0, kSwitching),
           is_static);
  }

  void insert_new() {
    const int number = std::min(world_.new_frames.load(), kMaxNewFrames - 1);
    const Stamp stamp = next_stamp();
    insert(parent_name(0), new_name(number), stamp, sample_of(seconds(stamp), 0, kNew), number % 2 == 0);
    int expected = number;
    world_.new_frames.compare_exchange_strong(expected, number + 1);
  }

  void insert_promised(int reader) {
    int number = world_.promised[reader].load();
    if (number == 0) return;
    const Stamp stamp = promised_stamp(number);
    insert(parent_name(0), promised_name(reader, number), stamp, sample_of(seconds(stamp), 0, kPromised), false);
    world_.promised[reader].compare_exchange_strong(number, 0);
  }

  void clear() {
    world_.clears.fetch_add(1);
    world_.buffer.clear();
    world_.clears.fetch_add(1);
  }

  void insert(const std::string& parent, const std::string& child, Stamp stamp, const Planar& pose, bool is_static) {
    const TransformValues values = values_of(pose);
    const auto start = Clock::now();
    const unsigned refusals = world_.buffer.insert(parent, child, stamp, values, is_static, authority_);
    record_insertion(start);
    expect((refusals & ~kOldData) == 0, "a valid transform was refused");
  }

  void record_insertion(Clock::time_point start) {
    const auto ns = static_cast<std::uint64_t>((Clock::now() - start).count());
    statistics_.inserted.fetch_add(1);
    statistics_.insert_ns.fetch_add(ns);
    std::uint64_t worst = statistics_.worst_insert_ns.load();
    while (ns > worst && !statistics_.worst_insert_ns.compare_exchange_weak(worst, ns)) {
    }
  }

  World& world_;
  Statistics& statistics_;
  const int number_;
  std::mt19937 rng_;
  TransformStream stream_;
  AuthorityId authority_;
};

class Reader {
 public:
  Reader(World& world, Statistics& statistics, int number, unsigned seed)
      : world_(world), buffer_(world.buffer), statistics_(statistics), number_(number), rng_(seed) {}

  void run() {
    while (!world_.stopped.load()) check(rng_() % (world_.in_order ? 52 : 100));
  }

 private:
  void check(unsigned choice) {
    if (choice < 20) return check_chain();
    if (choice < 25) return check_batch();
    if (choice < 35) return check_full();
    if (choice < 50) return check_latest();
    if (choice < 51) return check_wait();
    if (choice < 52) return check_snapshot();
    if (choice < 67) return check_reparented();
    if (choice < 80) return check_switching();
    if (choice < 89) return check_new();
    if (choice < 98) return check_promise();
    if (choice < 99) return check_frames();
    check_texts();
  }

  Stamp random_stamp() {
    const Stamp now = world_.now.load();
    const Stamp back = rng_() % 4 == 0 ? 0 : static_cast<Stamp>(rng_() % 400'000'000);  // also between samples
    return std::max(kStart, now - back);
  }

  bool look_up(const std::string& target, const std::string& source, Stamp& stamp, Pose& pose, Kind kind) {
    const FrameId target_id = buffer_.find(target), source_id = buffer_.find(source);
    if (target_id == 0 || source_id == 0) return false;
    Failure failure;
    const bool could_transform =
        target_id != source_id && buffer_.check_cached_path(paths_, target_id, source_id, stamp);
    const bool ok = buffer_.lookup_by_id(target_id, source_id, stamp, pose, failure);
    const bool is_dropped = failure.code == ErrorCode::too_old || failure.code == ErrorCode::only_other;
    expect(ok || !could_transform || !world_.chain_is_kept || is_dropped,
           "a lookup failed although its path was available");
    return count(ok, failure, kind);
  }

  bool count(bool ok, const Failure& failure, Kind kind) {
    (ok ? statistics_.successes : statistics_.failures).fetch_add(1);
    if (ok) statistics_.count_success(kind);
    if (!ok) expect_reason(failure);
    return ok;
  }

  static Planar chain_pose(int top, int bottom, Stamp stamp) {
    Planar pose{0, 0, 0, 0};
    for (int child = top + 1; child <= bottom; ++child) pose = pose * edge_pose(child, stamp);
    return pose;
  }

  void check_chain() {
    int top = static_cast<int>(rng_() % (kDepth + 1)), bottom = static_cast<int>(rng_() % (kDepth + 1));
    if (top == bottom) return;
    Stamp stamp = random_stamp();
    Pose pose;
    if (!look_up(chain_name(top), chain_name(bottom), stamp, pose, Kind::chain)) return;
    expect_pose(pose, top < bottom ? chain_pose(top, bottom, stamp) : inverse(chain_pose(bottom, top, stamp)), "chain");
  }

  // Checks the rows of one batch, in order or not, with or without velocities.
  void check_batch() {
    const int top = static_cast<int>(rng_() % kDepth), bottom = top + 1 + static_cast<int>(rng_() % (kDepth - top));
    const bool down = rng_() % 2 == 0;
    const std::string above = chain_name(top), below = chain_name(bottom);
    std::vector<Stamp> stamps(1 + rng_() % 700);
    for (Stamp& stamp : stamps) stamp = random_stamp();
    if (rng_() % 2 == 0) std::sort(stamps.begin(), stamps.end());
    std::vector<double> poses(7 * stamps.size()), twists(6 * stamps.size());
    LookupQuery query;
    query.target = down ? below : above;
    query.source = down ? above : below;
    const Batch batch{stamps.size(), stamps.data(),      poses.data(), rng_() % 2 == 0 ? twists.data() : nullptr,
                      nullptr,       Batch::Missing::nan};
    Failure failure;
    const bool ok = buffer_.lookup_many(query, nullptr, batch, 1, failure) == stamps.size();
    bool any = false;
    for (std::size_t row = 0; row < stamps.size(); ++row) {
      const double* v = &poses[7 * row];
      if (std::isnan(v[0])) continue;
      any = true;
      const Planar expected = chain_pose(top, bottom, stamps[row]);
      expect_pose({{v[3], v[4], v[5], v[6]}, {v[0], v[1], v[2]}}, down ? inverse(expected) : expected, "batch");
    }
    expect(any || !ok, "a batch succeeded, but all its rows are NaN");
    statistics_.successes.fetch_add(any);
    if (any) statistics_.count_success(Kind::batch);
  }

  void check_full() {
    const int target = 1 + static_cast<int>(rng_() % kDepth), source = 1 + static_cast<int>(rng_() % kDepth);
    const FrameId target_id = buffer_.find(chain_name(target)), source_id = buffer_.find(chain_name(source)),
                  fixed_id = buffer_.find(chain_name(0));
    if (target_id == 0 || source_id == 0 || fixed_id == 0) return;
    Stamp target_stamp = random_stamp();
    const Stamp source_stamp = random_stamp();
    Pose pose;
    Failure failure;
    const bool ok =
        buffer_.lookup_full_by_id(target_id, target_stamp, source_id, source_stamp, fixed_id, pose, failure);
    if (!count(ok, failure, Kind::full)) return;
    expect_pose(pose, inverse(chain_pose(0, target, target_stamp)) * chain_pose(0, source, source_stamp),
                "time travel");
  }

  // The latest common time never decreases, unless another thread clears the buffer in the meantime.
  void check_latest() {
    const std::uint64_t clears = world_.clears.load();
    Stamp before = 0;
    for (int i = 0; i < 3; ++i) {
      Stamp stamp = 0;
      Pose pose;
      const bool has_begun = world_.has_chain.load();
      if (!look_up(chain_name(0), chain_name(kDepth), stamp, pose, Kind::latest)) {
        expect(!has_begun || !world_.chain_is_kept, "the chain is not available");
        continue;
      }
      expect_pose(pose, chain_pose(0, kDepth, stamp), "chain at its latest time");
      expect(stamp >= before || cleared_since(clears), "the latest common time decreased");
      before = stamp;
    }
  }

  void check_reparented() {
    const int parent = static_cast<int>(rng_() % kParents);
    const Stamp requested = rng_() % 3 == 0 ? 0 : random_stamp();
    Stamp stamp = requested;
    Pose pose;
    if (!look_up(parent_name(parent), "reparented", stamp, pose, Kind::reparented)) return;
    expect_sample(pose, parent, kReparented, "reparented");
    expect(pose.p[0] <= seconds(stamp) + kTolerance, "reparented: the sample is newer than requested");
    expect(requested != 0 || pose.p[0] > seconds(stamp) - kTolerance, "reparented: not the latest sample");
  }

  void check_switching() {
    Stamp stamp = rng_() % 3 == 0 ? 0 : random_stamp();
    Pose pose;
    if (!look_up(parent_name(0), "switching", stamp, pose, Kind::switching)) return;
    expect_sample(pose, 0, kSwitching, "switching");
    const bool is_static = pose.p[0] < 0;
    expect(is_static || std::abs(pose.p[0] - seconds(stamp)) < kTolerance, "switching: the sample has another time");
  }

  void check_new() {
    const int names = world_.new_frames.load();
    if (names == 0) return;
    const int number = names - 1 - static_cast<int>(rng_() % std::min(names, 50));
    const std::string name = new_name(number);
    const FrameId frame = buffer_.find(name);
    expect(frame != 0, "a frame is missing", name);
    expect(buffer_.name(frame) == name, "a frame has the name of another frame", name);
    Stamp stamp = 0;
    Pose pose;
    if (look_up(parent_name(0), name, stamp, pose, Kind::new_frame)) expect_sample(pose, 0, kNew, "new frame");
  }

  void check_frames() {
    const int names = world_.new_frames.load();
    const std::vector<std::string> all = buffer_.frame_names();
    expect(all.size() >= static_cast<std::size_t>(names), "frames are missing");
    for (const FrameSummary& frame : buffer_.frames()) {
      expect(!frame.name.empty(), "a frame has no name");
      if (frame.parent.empty()) continue;
      expect(frame.oldest <= frame.newest, "a frame's oldest sample is newer than its newest", frame.name);
      expect(frame.name[0] != 'c' || frame.parent[0] == 'c', "a frame has the parent of another frame", frame.name);
    }
    for (const EdgeSummary& edge : buffer_.edges()) {
      const FrameSummary& frame = edge.frame;
      // The samples of an insertion are visible shortly before they are counted.
      expect(frame.is_static || edge.stored + kRun >= frame.samples, "a frame has more samples than were stored",
             frame.name);
    }
    statistics_.count_success(Kind::frames);
  }

  void check_texts() {
    const Counts counts = buffer_.counts();
    expect(counts.malformed == 0 && counts.refused == 0, "messages or transforms that were never sent are counted");
    std::vector<FrameId> frames;
    Failure failure;
    const FrameId target = buffer_.find(chain_name(0)), source = buffer_.find(chain_name(kDepth));
    if (target == 0 || source == 0) return;
    if (buffer_.chain(target, source, world_.now.load() + kSecond, frames, failure)) return;
    const std::string why = buffer_.read([&](const Tree& tree) { return lookup_text(failure, tree); });
    expect(!why.empty(), "a failure has no text");
    expect(buffer_.read([](const Tree& tree) { return frames_as_yaml(tree); }).find("rate: ") != std::string::npos ||
               world_.clears.load() > 0,
           "the YAML contains no frames");
    expect(!buffer_.encode(false).empty(), "the encoded message is empty");
    statistics_.count_success(Kind::texts);
  }

  // Waits for a sample that is inserted once, possibly while the wait is being registered; nothing else would wake it.
  void check_promise() {
    const int number = ++promises_;
    const std::string target = parent_name(0), source = promised_name(number_, number);
    LookupQuery query;
    query.target = target;
    query.source = source;
    query.stamp = promised_stamp(number);
    const std::uint64_t clears = world_.clears.load();
    const auto wait = std::make_shared<Wait>(query);
    world_.promised[number_].store(number);
    const ScopedWait condition(buffer_.wait_queue(), wait);
    while (!wait->wait_for(50 * kTick)) {
      if (world_.stopped.load() || cleared_since(clears)) return;
      if (world_.promised[number_].load() != 0 || wait->wait_for(10 * kSecond)) continue;
      return expect(cleared_since(clears), "a waiting reader was not notified");
    }
    expect_sample(wait->result().pose, 0, kPromised, "promised");
    statistics_.count_success(Kind::promise);
  }

  bool cleared_since(std::uint64_t clears) { return clears % 2 != 0 || clears != world_.clears.load(); }

  // Waits for a transform that will be inserted soon.
  void check_wait() {
    const int bottom = 1 + static_cast<int>(rng_() % kDepth);
    const std::string target = chain_name(0), source = chain_name(bottom);
    LookupQuery query;
    query.target = target;
    query.source = source;
    query.stamp = world_.now.load() + static_cast<Stamp>(rng_() % 10) * kTick;
    const auto wait = std::make_shared<Wait>(query);
    const ScopedWait condition(buffer_.wait_queue(), wait);
    if (!wait->wait_for(20 * kTick)) return;
    expect(wait->result().stamp == query.stamp, "the result of a wait has another time than requested");
    expect_pose(wait->result().pose, chain_pose(0, bottom, query.stamp), "waited");
    statistics_.count_success(Kind::wait);
  }

  // A snapshot does not change when writers insert more samples.
  void check_snapshot() {
    const std::shared_ptr<Buffer> snapshot = buffer_.snapshot();
    const FrameId target = snapshot->find(chain_name(0)), source = snapshot->find(chain_name(kDepth));
    if (target == 0 || source == 0) return;
    Stamp first = 0;
    for (int i = 0; i < 10; ++i) {
      Stamp stamp = 0;
      Pose pose;
      Failure failure;
      const bool ok = snapshot->lookup_by_id(target, source, stamp, pose, failure);
      if (i == 0) first = ok ? stamp : -1;
      expect(ok == (first != -1), "a lookup in a snapshot first failed and then succeeded, or the reverse");
      if (!ok) continue;
      expect(stamp == first, "the latest time of a snapshot changed");
      expect_pose(pose, chain_pose(0, kDepth, stamp), "snapshot");
      statistics_.count_success(Kind::snapshot);
    }
  }

  World& world_;
  Buffer& buffer_;
  Statistics& statistics_;
  PathCache paths_;
  const int number_;
  int promises_ = 0;
  std::mt19937 rng_;
};

void run_round(Stamp cache, bool in_order, std::chrono::duration<double> duration, unsigned seed,
               Statistics& statistics) {
  World world(cache, in_order);
  std::vector<std::thread> threads;
  for (int i = 0; i < (in_order ? 1 : kWriters); ++i) {
    threads.emplace_back([&, i] { Writer(world, statistics, i, seed + static_cast<unsigned>(i)).run(); });
  }
  for (int i = 0; i < kReaders; ++i) {
    threads.emplace_back([&, i] { Reader(world, statistics, i, seed + 10 + static_cast<unsigned>(i)).run(); });
  }
  std::this_thread::sleep_for(duration);
  world.stopped.store(true);
  for (std::thread& thread : threads) thread.join();
}

}  // namespace

int main(int argc, char** argv) {
  const double duration_s = argc > 1 ? std::atof(argv[1]) : 60.0;
  const std::array<Stamp, 4> caches{300 * kTick, kKeepAll, 0, 10 * kSecond};
  const auto end = Clock::now() + std::chrono::duration<double>(duration_s);
  const std::chrono::duration<double> duration(std::min(1.0, duration_s / (2 * caches.size())));
  Statistics statistics;
  unsigned rounds = 0;
  for (; Clock::now() < end; ++rounds) {
    run_round(caches[rounds / 2 % caches.size()], rounds % 2 == 0, duration, 1000 * rounds, statistics);
  }
  const std::uint64_t inserted = statistics.inserted.load();
  std::printf("%u rounds, %llu insertions (%.1f us each, the worst %.2f ms), %llu successful lookups, %llu failures\n",
              rounds, static_cast<unsigned long long>(inserted),
              inserted ? static_cast<double>(statistics.insert_ns.load()) / static_cast<double>(inserted) * 1e-3 : 0.0,
              static_cast<double>(statistics.worst_insert_ns.load()) * 1e-6,
              static_cast<unsigned long long>(statistics.successes.load()),
              static_cast<unsigned long long>(statistics.failures.load()));
  for (std::size_t kind = 0; duration_s >= 10 && kind < statistics.found.size(); ++kind) {
    expect(statistics.found[kind].load() > 0, "no success for checks of kind", std::to_string(kind));
  }
  return 0;
}
