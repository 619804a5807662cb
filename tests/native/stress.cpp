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
constexpr int kDepth = 40;    // links of the chain
constexpr int kParents = 3;   // between which a frame wanders
constexpr int kNames = 1000;  // new ones a round
constexpr Stamp kSecond = 1'000'000'000, kTick = 1'000'000, kStart = 1000 * kSecond;
constexpr Stamp kStay = 50 * kTick;  // with one parent
constexpr double kTolerance = 1e-9;

[[noreturn]] void fail(const std::string& what) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::fprintf(stderr, "broken: %s\n", what.c_str());
  std::_Exit(1);
}

void expect(bool holds, const char* what, const std::string& facts = "") {
  if (!holds) fail(what + (" " + facts));
}

// A pose in which only the angle about z turns.
struct Planar {
  double x, y, z, angle;
};

double seconds(Stamp stamp) { return static_cast<double>(stamp - kStart) * 1e-9; }
// Slow enough for half an hour between two samples: after a clear(), one that comes late may be that old.
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

bool turned(const Pose& pose, double angle) {
  const double* q = pose.q;
  const double off = q[2] * std::cos(angle / 2) - q[3] * std::sin(angle / 2);  // half of it, for small ones
  return std::abs(dot(q, q) - 1.0) < kTolerance && std::abs(off) < kTolerance;
}

void expect_pose(const Pose& pose, const Planar& expected, const char* what) {
  const bool same = std::abs(pose.p[0] - expected.x) < 1e-6 && std::abs(pose.p[1] - expected.y) < 1e-6 &&
                    std::abs(pose.p[2] - expected.z) < 1e-6;
  if (same && turned(pose, expected.angle)) return;
  Pose wanted;
  for (int i = 0; i < 3; ++i) wanted.p[i] = std::array{expected.x, expected.y, expected.z}[i];
  wanted.q[2] = std::sin(expected.angle / 2);
  wanted.q[3] = std::cos(expected.angle / 2);
  fail(what + (" " + text(pose)) + ", expected " + text(wanted));
}

// One sample of a link, or one between two: everything in it belongs together.
void expect_sample(const Pose& pose, int parent, int child, const char* what) {
  const bool whole = std::abs(pose.p[1] - parent) < kTolerance && std::abs(pose.p[2] - child) < kTolerance;
  expect(whole && turned(pose, angle_at(pose.p[0])), what, text(pose));
}

void expect_reason(const Failure& failure) {
  switch (failure.code) {
    case ErrorCode::too_new: return expect(failure.requested > failure.latest, "too new, but is not");
    case ErrorCode::too_old: return expect(failure.requested < failure.earliest, "too old, but is not");
    case ErrorCode::only_other: return expect(failure.requested != failure.latest, "another time, but is the same");
    default: return expect(failure.code != ErrorCode::none, "a failure without a reason");
  }
}

// What there is in the buffer:
//   c0 <- c1 <- ... <- c40      in time order and out of it; every tenth link is static
//   p0, p1, p2 <- wanderer      another parent every 50 ms; removed at times
//   p0 <- flipper               static (x negative) and dynamic (x positive) in turn
//   p0 <- n0, n1, n2, ...       new all the time
//   p0 <- w0_0, w0_1, ...       what reader 0 waits for: some samples each, of which each is the last one for a while
std::string chain_name(int i) { return "c" + std::to_string(i); }
std::string parent_name(int i) { return "p" + std::to_string(i); }
std::string new_name(int i) { return "n" + std::to_string(i); }
bool link_is_static(int child) { return child % 10 == 0; }
Planar link(int child, Stamp stamp) {
  return sample_of(link_is_static(child) ? 0.25 : seconds(stamp), child - 1, child);
}
int parent_at(Stamp stamp) { return static_cast<int>(stamp / kStay % kParents); }
std::string promised_name(int reader, int number) {
  return "w" + std::to_string(reader) + "_" + std::to_string(number / 8);
}
Stamp promised_stamp(int number) { return kStart + number * kTick; }
constexpr int kWanderer = 100, kFlipper = 101, kNew = 102, kPromised = 103;

// Of questions.
enum class Kind { chain, full, latest, wanderer, flipper, new_frame, frames, texts, wait, promise, snapshot, batch };
constexpr std::size_t kKinds = 12;

struct Tally {
  std::atomic<std::uint64_t> answers{0}, failures{0}, inserted{0}, worst_insert_ns{0}, insert_ns{0};
  std::array<std::atomic<std::uint64_t>, kKinds> found{};  // by kind

  void note(Kind kind) { found[static_cast<std::size_t>(kind)].fetch_add(1); }
};

struct World {
  World(Stamp cache, bool calm)
      : buffer(cache), calm(calm), always_there(calm && (cache == kKeepAll || cache >= 300 * kTick)) {}

  Buffer buffer;
  const bool calm;          // samples arrive in order, so that readers rarely need to retry
  const bool always_there;  // the chain's latest transform is never cleared or pruned once it exists
  std::atomic<bool> begun{false};
  std::atomic<Stamp> now{kStart};
  std::atomic<int> names{0};                          // new ones so far
  std::atomic<std::uint64_t> clears{0};               // odd while one is under way
  std::array<std::atomic<int>, kReaders> promised{};  // number of the sample that a reader waits for; 0: it is there
  std::atomic<bool> over{false};
};

class Writer {
 public:
  Writer(World& world, Tally& tally, int number, unsigned seed)
      : world_(world),
        tally_(tally),
        number_(number),
        rng_(seed),
        stream_(world.buffer.open_stream(false, "stream")),
        authority_(world.buffer.authority("writer")) {}

  void run() {
    while (!world_.over.load()) {
      if (world_.calm) {
        tell_chain(later());
        world_.begun.store(true);
        continue;
      }
      act(rng_() % 100);
      for (int reader = 0; reader < kReaders; ++reader) keep_promise(reader);
    }
  }

 private:
  void act(unsigned dice) {
    if (dice < 28) return tell_chain(later());
    if (dice < 30) return tell_run();
    if (dice < 45) return insert_link(1 + static_cast<int>(rng_() % kDepth), earlier());
    if (dice < 75) return insert_wanderer(dice < 70 ? later() : earlier());
    if (dice < 94) return insert_flipper(later());
    if (dice < 99) return insert_new();
    if (number_ == 0 && rng_() % 10 == 0) return clear();
    if (rng_() % 20 == 0) world_.buffer.remove_frame("wanderer");
  }

  Stamp later() { return world_.now.fetch_add(kTick) + kTick; }
  Stamp earlier() {
    const Stamp now = world_.now.load();
    return std::max(kStart, now - static_cast<Stamp>(rng_() % 500) * kTick);
  }

  void tell_chain(Stamp stamp) {
    std::vector<std::string> names;
    for (int i = 0; i <= kDepth; ++i) names.push_back(chain_name(i));
    std::vector<TransformView> views;
    for (int child = 1; child <= kDepth; ++child) {
      if (world_.calm && link_is_static(child)) {
        insert_link(child, stamp);
      } else if (!link_is_static(child)) {
        views.push_back({names[child - 1], names[child], stamp, values_of(link(child, stamp))});
      }
    }
    const std::string bytes = encode_tf_message(views);
    std::size_t stored = 0;
    const auto start = Clock::now();
    const DecodeFailure failure =
        world_.buffer.ingest(stream_, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size(), stored);
    took(start);
    expect(!failure.reason, "a good message was refused");
  }

  void insert_link(int child, Stamp stamp) {
    insert(chain_name(child - 1), chain_name(child), stamp, link(child, stamp), link_is_static(child));
  }

  // Many samples of one link at once.
  void tell_run() {
    const int child = 1 + static_cast<int>(rng_() % kDepth);
    if (link_is_static(child)) return;
    std::vector<Stamp> stamps(100);
    std::vector<double> rows;
    for (Stamp& stamp : stamps) {
      stamp = later();
      const TransformValues values = values_of(link(child, stamp));
      rows.insert(rows.end(), values.translation, values.translation + 3);
      rows.insert(rows.end(), values.rotation, values.rotation + 4);
    }
    const std::string parent = chain_name(child - 1), name = chain_name(child);
    std::size_t stored = 0, bad_row = 0;
    const Track track{parent, name, stamps.size(), stamps.data(), rows.data()};
    const auto start = Clock::now();
    const unsigned refusals = world_.buffer.insert_many(track, false, authority_, stored, bad_row);
    took(start);
    expect(refusals == 0, "good transforms were refused");
  }

  void insert_wanderer(Stamp stamp) {
    const int parent = parent_at(stamp);
    insert(parent_name(parent), "wanderer", stamp, sample_of(seconds(stamp), parent, kWanderer), false);
  }

  void insert_flipper(Stamp stamp) {
    const bool is_static = rng_() % 4 == 0;
    insert(parent_name(0), "flipper", stamp, sample_of((is_static ? -1 : 1) * seconds(stamp), 0, kFlipper), is_static);
  }

  void insert_new() {
    const int number = std::min(world_.names.load(), kNames - 1);
    const Stamp stamp = later();
    insert(parent_name(0), new_name(number), stamp, sample_of(seconds(stamp), 0, kNew), number % 2 == 0);
    int expected = number;
    world_.names.compare_exchange_strong(expected, number + 1);
  }

  void keep_promise(int reader) {
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
    took(start);
    expect((refusals & ~kOldData) == 0, "a good transform was refused");
  }

  void took(Clock::time_point start) {
    const auto ns = static_cast<std::uint64_t>((Clock::now() - start).count());
    tally_.inserted.fetch_add(1);
    tally_.insert_ns.fetch_add(ns);
    std::uint64_t worst = tally_.worst_insert_ns.load();
    while (ns > worst && !tally_.worst_insert_ns.compare_exchange_weak(worst, ns)) {
    }
  }

  World& world_;
  Tally& tally_;
  const int number_;
  std::mt19937 rng_;
  TransformStream stream_;
  AuthorityId authority_;
};

class Reader {
 public:
  Reader(World& world, Tally& tally, int number, unsigned seed)
      : world_(world), buffer_(world.buffer), tally_(tally), number_(number), rng_(seed) {}

  void run() {
    while (!world_.over.load()) check(rng_() % (world_.calm ? 52 : 100));
  }

 private:
  void check(unsigned dice) {
    if (dice < 20) return check_chain();
    if (dice < 25) return check_batch();
    if (dice < 35) return check_full();
    if (dice < 50) return check_latest();
    if (dice < 51) return check_wait();
    if (dice < 52) return check_snapshot();
    if (dice < 67) return check_wanderer();
    if (dice < 80) return check_flipper();
    if (dice < 89) return check_new();
    if (dice < 98) return check_promise();
    if (dice < 99) return check_frames();
    check_texts();
  }

  Stamp when() {
    const Stamp now = world_.now.load();
    const Stamp back = rng_() % 4 == 0 ? 0 : static_cast<Stamp>(rng_() % 400'000'000);  // between samples, too
    return std::max(kStart, now - back);
  }

  bool look_up(const std::string& target, const std::string& source, Stamp& stamp, Pose& pose, Kind kind) {
    const FrameId target_id = buffer_.find(target), source_id = buffer_.find(source);
    if (target_id == 0 || source_id == 0) return false;
    Failure failure;
    const bool was_possible = target_id != source_id && buffer_.check_cached_path(paths_, target_id, source_id, stamp);
    const bool ok = buffer_.lookup_by_id(target_id, source_id, stamp, pose, failure);
    const bool is_dropped = failure.code == ErrorCode::too_old || failure.code == ErrorCode::only_other;
    expect(ok || !was_possible || !world_.always_there || is_dropped, "what was possible is not");
    return count(ok, failure, kind);
  }

  bool count(bool ok, const Failure& failure, Kind kind) {
    (ok ? tally_.answers : tally_.failures).fetch_add(1);
    if (ok) tally_.note(kind);
    if (!ok) expect_reason(failure);
    return ok;
  }

  static Planar along(int top, int bottom, Stamp stamp) {
    Planar pose{0, 0, 0, 0};
    for (int child = top + 1; child <= bottom; ++child) pose = pose * link(child, stamp);
    return pose;
  }

  void check_chain() {
    int top = static_cast<int>(rng_() % (kDepth + 1)), bottom = static_cast<int>(rng_() % (kDepth + 1));
    if (top == bottom) return;
    Stamp stamp = when();
    Pose pose;
    if (!look_up(chain_name(top), chain_name(bottom), stamp, pose, Kind::chain)) return;
    expect_pose(pose, top < bottom ? along(top, bottom, stamp) : inverse(along(bottom, top, stamp)), "chain");
  }

  // Rows of one batch, in order or not, and with velocities or not.
  void check_batch() {
    const int top = static_cast<int>(rng_() % kDepth), bottom = top + 1 + static_cast<int>(rng_() % (kDepth - top));
    const bool down = rng_() % 2 == 0;
    const std::string above = chain_name(top), below = chain_name(bottom);
    std::vector<Stamp> stamps(1 + rng_() % 700);
    for (Stamp& stamp : stamps) stamp = when();
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
      const Planar expected = along(top, bottom, stamps[row]);
      expect_pose({{v[3], v[4], v[5], v[6]}, {v[0], v[1], v[2]}}, down ? inverse(expected) : expected, "batch");
    }
    expect(any || !ok, "answers that are none");
    tally_.answers.fetch_add(any);
    if (any) tally_.note(Kind::batch);
  }

  void check_full() {
    const int target = 1 + static_cast<int>(rng_() % kDepth), source = 1 + static_cast<int>(rng_() % kDepth);
    const FrameId target_id = buffer_.find(chain_name(target)), source_id = buffer_.find(chain_name(source)),
                  fixed_id = buffer_.find(chain_name(0));
    if (target_id == 0 || source_id == 0 || fixed_id == 0) return;
    Stamp target_stamp = when();
    const Stamp source_stamp = when();
    Pose pose;
    Failure failure;
    const bool ok =
        buffer_.lookup_full_by_id(target_id, target_stamp, source_id, source_stamp, fixed_id, pose, failure);
    if (!count(ok, failure, Kind::full)) return;
    expect_pose(pose, inverse(along(0, target, target_stamp)) * along(0, source, source_stamp), "time travel");
  }

  // The latest common time never decreases, unless another thread clears the buffer meanwhile.
  void check_latest() {
    const std::uint64_t clears = world_.clears.load();
    Stamp before = 0;
    for (int i = 0; i < 3; ++i) {
      Stamp stamp = 0;
      Pose pose;
      const bool has_begun = world_.begun.load();
      if (!look_up(chain_name(0), chain_name(kDepth), stamp, pose, Kind::latest)) {
        expect(!has_begun || !world_.always_there, "the chain is not there");
        continue;
      }
      expect_pose(pose, along(0, kDepth, stamp), "chain at its latest");
      expect(stamp >= before || cleared_since(clears), "the latest common time ran back");
      before = stamp;
    }
  }

  void check_wanderer() {
    const int parent = static_cast<int>(rng_() % kParents);
    const Stamp asked = rng_() % 3 == 0 ? 0 : when();
    Stamp stamp = asked;
    Pose pose;
    if (!look_up(parent_name(parent), "wanderer", stamp, pose, Kind::wanderer)) return;
    expect_sample(pose, parent, kWanderer, "wanderer");
    expect(pose.p[0] <= seconds(stamp) + kTolerance, "wanderer: a sample of later");
    expect(asked != 0 || pose.p[0] > seconds(stamp) - kTolerance, "wanderer: not its latest");
  }

  void check_flipper() {
    Stamp stamp = rng_() % 3 == 0 ? 0 : when();
    Pose pose;
    if (!look_up(parent_name(0), "flipper", stamp, pose, Kind::flipper)) return;
    expect_sample(pose, 0, kFlipper, "flipper");
    const bool is_static = pose.p[0] < 0;
    expect(is_static || std::abs(pose.p[0] - seconds(stamp)) < kTolerance, "flipper: of another time");
  }

  void check_new() {
    const int names = world_.names.load();
    if (names == 0) return;
    const int number = names - 1 - static_cast<int>(rng_() % std::min(names, 50));
    const std::string name = new_name(number);
    const FrameId frame = buffer_.find(name);
    expect(frame != 0, "a frame is not known", name);
    expect(buffer_.name(frame) == name, "a frame has another's name", name);
    Stamp stamp = 0;
    Pose pose;
    if (look_up(parent_name(0), name, stamp, pose, Kind::new_frame)) expect_sample(pose, 0, kNew, "new frame");
  }

  void check_frames() {
    const int names = world_.names.load();
    const std::vector<std::string> all = buffer_.frame_names();
    expect(all.size() >= static_cast<std::size_t>(names), "frames are missing");
    for (const FrameSummary& frame : buffer_.frames()) {
      expect(!frame.name.empty(), "a frame without a name");
      if (frame.parent.empty()) continue;
      expect(frame.oldest <= frame.newest, "a frame's oldest sample is newer than its newest", frame.name);
      expect(frame.name[0] != 'c' || frame.parent[0] == 'c', "a frame with another's parent", frame.name);
    }
    for (const EdgeSummary& edge : buffer_.edges()) {
      const FrameSummary& frame = edge.frame;
      // A sample shows a moment before it is counted.
      expect(frame.is_static || edge.stored + 1 >= frame.samples, "more samples than were stored", frame.name);
    }
    tally_.note(Kind::frames);
  }

  void check_texts() {
    const Counts counts = buffer_.counts();
    expect(counts.malformed == 0 && counts.refused == 0, "counts of what never came");
    std::vector<FrameId> frames;
    Failure failure;
    const FrameId target = buffer_.find(chain_name(0)), source = buffer_.find(chain_name(kDepth));
    if (target == 0 || source == 0) return;
    if (buffer_.chain(target, source, world_.now.load() + kSecond, frames, failure)) return;
    const std::string why = buffer_.read([&](const Tree& tree) { return lookup_text(failure, tree); });
    expect(!why.empty(), "no words for a failure");
    expect(buffer_.read([](const Tree& tree) { return frames_as_yaml(tree); }).find("rate: ") != std::string::npos ||
               world_.clears.load() > 0,
           "no frames in the YAML");
    expect(!buffer_.encode(false).empty(), "no bytes");
    tally_.note(Kind::texts);
  }

  // A sample that comes once, maybe while the wait sits down; nothing else would wake it.
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
      if (world_.over.load() || cleared_since(clears)) return;
      if (world_.promised[number_].load() != 0 || wait->wait_for(10 * kSecond)) continue;
      return expect(cleared_since(clears), "a wait was forgotten");
    }
    expect_sample(wait->result().pose, 0, kPromised, "promised");
    tally_.note(Kind::promise);
  }

  bool cleared_since(std::uint64_t clears) { return clears % 2 != 0 || clears != world_.clears.load(); }

  // For a transform that is to come soon.
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
    expect(wait->result().stamp == query.stamp, "another time than was waited for");
    expect_pose(wait->result().pose, along(0, bottom, query.stamp), "waited");
    tally_.note(Kind::wait);
  }

  // What writers do afterwards does not show.
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
      expect(ok == (first != -1), "a snapshot that changes its mind");
      if (!ok) continue;
      expect(stamp == first, "a snapshot that goes on");
      expect_pose(pose, along(0, kDepth, stamp), "snapshot");
      tally_.note(Kind::snapshot);
    }
  }

  World& world_;
  Buffer& buffer_;
  Tally& tally_;
  PathCache paths_;
  const int number_;
  int promises_ = 0;
  std::mt19937 rng_;
};

void run_round(Stamp cache, bool calm, std::chrono::duration<double> duration, unsigned seed, Tally& tally) {
  World world(cache, calm);
  std::vector<std::thread> threads;
  for (int i = 0; i < (calm ? 1 : kWriters); ++i) {
    threads.emplace_back([&, i] { Writer(world, tally, i, seed + static_cast<unsigned>(i)).run(); });
  }
  for (int i = 0; i < kReaders; ++i) {
    threads.emplace_back([&, i] { Reader(world, tally, i, seed + 10 + static_cast<unsigned>(i)).run(); });
  }
  std::this_thread::sleep_for(duration);
  world.over.store(true);
  for (std::thread& thread : threads) thread.join();
}

}  // namespace

int main(int argc, char** argv) {
  const double seconds_wanted = argc > 1 ? std::atof(argv[1]) : 60.0;
  const std::array<Stamp, 4> caches{300 * kTick, kKeepAll, 0, 10 * kSecond};
  const auto end = Clock::now() + std::chrono::duration<double>(seconds_wanted);
  const std::chrono::duration<double> duration(std::min(1.0, seconds_wanted / (2 * caches.size())));
  Tally tally;
  unsigned rounds = 0;
  for (; Clock::now() < end; ++rounds) {
    run_round(caches[rounds / 2 % caches.size()], rounds % 2 == 0, duration, 1000 * rounds, tally);
  }
  const std::uint64_t inserted = tally.inserted.load();
  std::printf("%u rounds, %llu insertions (%.1f us each, the worst %.2f ms), %llu answers, %llu failures\n", rounds,
              static_cast<unsigned long long>(inserted),
              inserted ? static_cast<double>(tally.insert_ns.load()) / static_cast<double>(inserted) * 1e-3 : 0.0,
              static_cast<double>(tally.worst_insert_ns.load()) * 1e-6,
              static_cast<unsigned long long>(tally.answers.load()),
              static_cast<unsigned long long>(tally.failures.load()));
  for (std::size_t kind = 0; seconds_wanted >= 10 && kind < tally.found.size(); ++kind) {
    expect(tally.found[kind].load() > 0, "no answer to questions of kind", std::to_string(kind));
  }
  return 0;
}
