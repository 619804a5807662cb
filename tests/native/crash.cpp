// SPDX-License-Identifier: Apache-2.0
// Ends the writer of a shared tree after every single instruction of every kind of change, and lets another writer
// continue. Nothing that was stored before may be lost, no sample may be torn, and the tree must accept more samples.
//
// The writer is a child process that this one executes step by step (ptrace). Whenever the shared memory has changed,
// its copy is what a writer that dies now would leave behind.

#include <sys/ptrace.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "shared_fixture.hpp"

namespace {

using namespace shared_fixture;

const char* const kFrames[] = {"base", "other"};

struct Content {
  Samples of[std::size(kFrames)];
  explicit Content(const Tree& tree, const std::string& where) {
    for (std::size_t i = 0; i < std::size(kFrames); ++i) of[i] = samples_of(tree, kFrames[i], where);
  }
};

int count_in(const Samples& samples, const Samples::key_type& key) {
  const auto found = samples.find(key);
  return found == samples.end() ? 0 : found->second;
}

void check(const Operation& operation, const Content& before, const Content& after, const Content& now,
           const std::string& where) {
  for (std::size_t i = 0; i < std::size(kFrames); ++i) {
    for (const auto& [key, count] : now.of[i]) {
      const int most = std::max(count_in(before.of[i], key), count_in(after.of[i], key));
      if (count > most) fail(where + ": a sample is there twice, or was never stored");
    }
    if (operation.may_be_empty && now.of[i].empty()) continue;
    bool is_before = true, is_after = true;
    for (const auto& [key, count] : before.of[i]) {
      const int least = std::min(count, count_in(after.of[i], key));
      if (count_in(now.of[i], key) < least) fail(where + ": a sample is lost");
      if (count_in(now.of[i], key) < count) is_before = false;
    }
    for (const auto& [key, count] : after.of[i]) is_after = is_after && count_in(now.of[i], key) == count;
    // A static transform is either the one before or the one after.
    if (before.of[i].size() == 1 && after.of[i].size() == 1 && !is_before && !is_after) fail(where + ": it is lost");
  }
}

// Both ends of the range must be those of the samples, and the tree must store more samples without losing others.
void use(Tree& tree, const std::string& where) {
  const FrameId base = tree.find("base");
  const History::View history = tree.history(base);
  const History::Span span = tree.frame(base).history.span();
  if (base != 0 && !history.empty() && !history.is_static() &&
      (span.first != history.oldest() || span.last != history.newest() || span.parent != history.parent())) {
    fail(where + ": the range of stamps is not that of the samples");
  }
  const Stamp start = std::max(history.newest(), kStart) + kTick;
  for (int i = 0; i < 600; ++i) {
    put(tree, "map", "base", start + i * kTick);
    put(tree, "map", "other", start + i * kTick);
  }
  const std::size_t base_count = samples_of(tree, "base", where).size(),
                    count = samples_of(tree, "other", where).size();
  if (base_count < 600 || count < 600) fail(where + ": later samples are lost");
}

int explore(const Operation& operation) {
  Block block, last, copy;
  block.create();
  {
    Tree tree(block.writer());
    operation.prepare(tree);
  }
  const Content before(Tree(block.reader()), "before");
  copy.copy(block);
  {
    Tree tree(copy.writer());
    operation.change(tree);
  }
  const Content after(Tree(copy.reader()), "after");

  const pid_t child = fork();
  if (child == 0) {
    Tree tree(block.writer());
    tree.recover();
    ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    raise(SIGSTOP);
    operation.change(tree);
    raise(SIGSTOP);
    _exit(0);
  }
  int status, states = 0, stops = 0;
  last.copy(block);
  for (long step = 0; waitpid(child, &status, 0) == child && !WIFEXITED(status); ++step) {
    if (WSTOPSIG(status) == SIGSTOP && ++stops == 2) break;
    if (last.used() != block.used() || std::memcmp(last.data(), block.data(), block.used()) != 0) {
      last.copy(block);
      copy.copy(block);
      const std::string where = operation.name + (", after instruction " + std::to_string(step));
      Tree successor(copy.writer());
      successor.recover();
      if (successor.start_reading() % 2 != 0) fail(where + ": the change is not completed");
      check(operation, before, after, Content(Tree(copy.reader()), where), where);
      use(successor, where);
      ++states;
    }
    ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
  }
  kill(child, SIGKILL);
  waitpid(child, &status, 0);
  if (stops < 2) fail(std::string(operation.name) + ": the writer did not finish");
  return states;
}

}  // namespace

int main() {
  int all = 0;
  for (const Operation& operation : operations()) {
    const int states = explore(operation);
    std::printf("%-45s %5d states\n", operation.name, states);
    all += states;
  }
  std::printf("%d states of an interrupted writer, each continued by another writer\n", all);
}
