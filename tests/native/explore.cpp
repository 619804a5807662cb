// SPDX-License-Identifier: Apache-2.0
// Runs the real core in every order of the steps of a writer, of a reader, and of the writer that continues after the
// first one has died: all orders with two switches between them, and a sample of those with more. A step is one access
// to an atomic of the shared tree (explore/core/atomic.hpp). A reader must never see a value that was not stored, and
// must not miss one that stays.
//
// The order of memory accesses is the one that the program states; `make sanitize` checks the memory orders.

#include <malloc.h>
#include <ucontext.h>

#include <array>
#include <optional>
#include <random>

#include "core/lookup.hpp"
#include "shared_fixture.hpp"

namespace {

using namespace shared_fixture;

// Runs functions in turns: each runs for a number of steps, and continues there in its next turn.
class Threads {
 public:
  static constexpr int kMany = 1 << 30;

  explicit Threads(std::vector<std::function<void()>> bodies) : bodies_(std::move(bodies)) {
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      Thread& thread = threads_[i];
      getcontext(&thread.context);
      thread.context.uc_stack = {stack(i), 0, kStack};
      thread.context.uc_link = &main_;
      makecontext(&thread.context, &Threads::enter, 0);
    }
    current_ = this;
    before_access = &Threads::step;
  }
  ~Threads() { before_access = nullptr; }

  // Returns whether the thread has ended. `steps` is reduced by the number of steps.
  bool run(std::size_t thread, int& steps) {
    running_ = thread;
    left_ = steps;
    if (!threads_[thread].ended) swapcontext(&main_, &threads_[thread].context);
    steps = left_;
    return threads_[thread].ended;
  }

 private:
  static constexpr std::size_t kStack = 64 << 10;
  struct Thread {
    ucontext_t context;
    bool ended = false;
  };

  static char* stack(std::size_t number) {
    static std::array<std::unique_ptr<char[]>, 3> stacks;
    if (!stacks[number]) stacks[number] = std::make_unique<char[]>(kStack);
    return stacks[number].get();
  }
  static void enter() {
    current_->bodies_[current_->running_]();
    current_->threads_[current_->running_].ended = true;
  }
  static void step() {
    if (current_->left_-- <= 0) {
      current_->left_ = 0;
      swapcontext(&current_->threads_[current_->running_].context, &current_->main_);
      --current_->left_;
    }
  }

  static inline Threads* current_ = nullptr;
  std::vector<std::function<void()>> bodies_;
  std::array<Thread, 3> threads_;
  ucontext_t main_;
  std::size_t running_ = 0;
  int left_ = 0;
};

// What a reader sees in one attempt that no change has interrupted.
struct Answer {
  bool found = false;
  Pose pose;
};

enum class Way { path, walk, check };

std::optional<Answer> read(const Tree& tree, PathCache& paths, Way way, FrameId target, FrameId source, Stamp stamp) {
  const std::uint64_t revision = tree.start_reading();
  Answer answer;
  Failure failure;
  if (way == Way::check) answer.found = check_path_in_tree(tree, paths, target, source, stamp);
  if (way == Way::path) answer.found = lookup_path_in_tree(tree, paths, target, source, stamp, answer.pose);
  if (way == Way::walk) answer.found = lookup_in_tree(tree, nullptr, target, source, stamp, answer.pose, failure);
  if (!tree.unchanged(revision)) return std::nullopt;
  return answer;
}

struct Case {
  Operation operation;
  Stamp stamp;  // of the lookup of map -> base
};

class Explorer {
 public:
  explicit Explorer(const Case& one) : case_(one) {
    start_.create();
    Tree tree(start_.writer());
    case_.operation.prepare(tree);
    before_ = samples_of(tree, "base", "before");
    now_.copy(start_);
    Tree changed(now_.writer());
    case_.operation.change(changed);
    after_ = samples_of(changed, "base", "after");
  }

  long run(Way way) {
    way_ = way;
    const int writes = count_steps(0), reads = count_steps(1);
    for (int a = 0; a <= writes; ++a) {
      for (int b = 0; b <= reads; ++b) {
        one({{0, a}, {1, b}, {0, Threads::kMany}, {1, Threads::kMany}});
        // The writer dies, and another one continues while the reader is in the middle.
        one({{0, a}, {1, b}, {2, Threads::kMany}, {1, Threads::kMany}});
      }
    }
    // Of the orders with one more switch, a sample.
    std::mt19937 random(1);
    const auto below = [&random](int end) { return static_cast<int>(random() % static_cast<unsigned>(end + 1)); };
    for (int i = 0; i < kSampled; ++i) {
      const int a = below(writes), b = below(reads), c = below(writes - a);
      one({{0, a}, {1, b}, {0, c}, {1, kTurn}, {0, Threads::kMany}, {1, Threads::kMany}});
      one({{0, a}, {1, b}, {0, c}, {2, Threads::kMany}, {1, Threads::kMany}});
      one({{0, a + c}, {1, b}, {2, below(writes)}, {1, kTurn}, {2, Threads::kMany}, {1, Threads::kMany}});
    }
    return schedules_;
  }

 private:
  static constexpr int kSampled = 300;
  // A reader that waits for the end of a change gets at most this many steps.
  static constexpr int kTurn = 60;
  struct Turn {
    std::size_t thread;
    int steps;
  };

  template <class Use>
  void with_threads(Use&& use) {
    now_.copy(start_);
    Tree writer(now_.writer()), reader(now_.reader()), successor(now_.writer());
    PathCache paths;
    const FrameId map = reader.find("map"), base = reader.find("base");
    answer_.reset();
    if (map != 0 && base != 0) (void)paths.find(reader, map, base);
    Threads threads({[&] { case_.operation.change(writer); },
                     [&] {
                       for (int attempt = 0; attempt < 50 && !answer_; ++attempt) {
                         answer_ = read(reader, paths, way_, map, base, case_.stamp);
                       }
                     },
                     [&] { successor.recover(); }});
    use(threads);
  }

  int count_steps(std::size_t thread) {
    int steps = Threads::kMany;
    with_threads([&](Threads& threads) { threads.run(thread, steps); });
    return Threads::kMany - steps;
  }

  void one(const std::vector<Turn>& turns) {
    ++schedules_;
    with_threads([&](Threads& threads) {
      for (Turn turn : turns) threads.run(turn.thread, turn.steps);
    });
    if (!answer_ || way_ == Way::check) return check_found(turns);
    if (answer_->found && !is_expected()) fail(text(turns) + ": the pose is wrong");
    check_found(turns);
  }

  // The lookup must succeed if it does so before and after the change, unless the samples are removed in between. The
  // cached path may leave the answer to the walk.
  void check_found(const std::vector<Turn>& turns) {
    if (!answer_) fail(text(turns) + ": the reader does not end");
    if (way_ != Way::walk || case_.operation.may_be_empty) return;
    if (covers(before_) && covers(after_) && !answer_->found) fail(text(turns) + ": a stored transform is not found");
    if (!covers(before_) && !covers(after_) && answer_->found) fail(text(turns) + ": a transform is found too early");
  }

  bool covers(const Samples& samples) const {
    return !samples.empty() && (samples.begin()->first.first <= case_.stamp || samples.size() == 1) &&
           (samples.rbegin()->first.first >= case_.stamp || samples.size() == 1) && connects(samples);
  }
  static bool connects(const Samples& samples) {
    for (const auto& [key, _] : samples) {
      if (key.second != "map") return false;
    }
    return true;
  }

  // The pose is that of a sample, or between the neighbors of the requested time before or after the change.
  bool is_expected() const { return agrees(before_) || agrees(after_); }
  bool agrees(const Samples& samples) const {
    if (samples.size() == 1) return is_pose_at(answer_->pose, "map", samples.begin()->first.first);
    return is_pose_at(answer_->pose, "map", case_.stamp);
  }

  std::string text(const std::vector<Turn>& turns) const {
    std::string line = std::string(case_.operation.name) + ", steps";
    for (const Turn& turn : turns) {
      line += std::string(" ") + "wrs"[turn.thread] + ":" +
              (turn.steps == Threads::kMany ? "all" : std::to_string(turn.steps));
    }
    return line;
  }

  const Case& case_;
  Way way_ = Way::walk;
  Block start_, now_;
  Samples before_, after_;
  std::optional<Answer> answer_;
  long schedules_ = 0;
};

}  // namespace

int main() {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);  // the memory of the path caches is used again
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  long all = 0;
  for (const Operation& operation : operations()) {
    long schedules = 0;
    for (const Stamp stamp : {kStart + kTick / 2, kStart + 35 * kTick / 2, kStart + 2505 * kTick / 10}) {
      const Case one{operation, stamp};
      for (const Way way : {Way::walk, Way::path}) schedules += Explorer(one).run(way);
    }
    std::printf("%-45s %8ld orders\n", operation.name, schedules);
    std::fflush(stdout);
    all += schedules;
  }
  std::printf("%ld orders of the steps of a reader and two writers\n", all);
}
