// SPDX-License-Identifier: Apache-2.0
// Waiters for insertions, indexed by the frame they depend on: an insertion on another edge costs nothing and wakes no
// thread.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/error.hpp"
#include "core/event.hpp"
#include "core/query.hpp"
#include "core/tree.hpp"

namespace coframe {

using Token = std::uint64_t;

// A queue of tokens from waits and watches that no thread blocks on. Any thread may put and take, one may wait.
class Mailbox {
 public:
  void put(Token token);
  // Returns and removes the tokens.
  std::vector<Token> take();
  // Waits until there is a token. Returns false when `timeout_ns` has passed without one, or earlier.
  bool wait_for(std::int64_t timeout_ns);
  bool empty() const { return count_.load() == 0; }

 private:
  std::atomic<std::size_t> count_{0};
  Event arrival_;
  std::mutex mutex_;
  std::vector<Token> tokens_;  // guarded by mutex_
};

// Which insertion may make a waiting lookup succeed.
struct WaitCondition {
  std::vector<FrameId> frames;  // an insertion on the edge to the parent of one of these frames
  std::string name;             // or one that creates this frame
  Stamp needed = 0;             // if the edge's newest stamp is at least this
  bool operator==(const WaitCondition&) const = default;
};

// A lookup that waits until it succeeds. It owns its names.
class Wait {
 public:
  explicit Wait(const LookupQuery& query, std::shared_ptr<Mailbox> mailbox = nullptr, Token token = 0);
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  const LookupQuery& query() const { return query_; }
  // Waits for the result, in one thread. Returns false when `timeout_ns` has passed without one, or earlier.
  bool wait_for(std::int64_t timeout_ns);
  bool done() const { return done_.load(std::memory_order_acquire); }
  const LookupResult& result() const { return result_; }  // valid once done()

 private:
  friend class WaitQueue;
  void complete(const LookupResult& result);

  std::string target_, source_, fixed_;
  LookupQuery query_;
  std::shared_ptr<Mailbox> mailbox_;
  Token token_;
  LookupResult result_;
  std::atomic<bool> done_{false};
  Event ready_;
  WaitCondition condition_;  // guarded by the queue's mutex
};

// Notifies of changes of one edge or all edges. Changes before the token is handled are combined.
class Watch {
 public:
  // An empty `child` watches all edges.
  Watch(std::string_view child, std::shared_ptr<Mailbox> mailbox, Token token)
      : child_(child), mailbox_(std::move(mailbox)), token_(token) {}

  // Returns the frames whose edge to their parent has changed since the last call.
  std::vector<FrameId> take();

 private:
  friend class WaitQueue;
  void note(FrameId child);

  std::string child_;
  FrameId frame_ = 0;  // the frame of that name, once it exists
  std::shared_ptr<Mailbox> mailbox_;
  Token token_;
  std::mutex mutex_;
  std::unordered_set<FrameId> changed_;
};

class WaitQueue {
 public:
  // Tries the lookup; on false, the failure says what is missing.
  using Ask = std::function<bool(LookupQuery&, LookupResult&, Failure&)>;

  WaitQueue(const Tree& tree, Ask ask) : tree_(tree), ask_(std::move(ask)) {}
  // Called before the first attempt of every wait and watch; nullptr: nothing.
  void on_add(std::function<void()> call);

  // The wait is completed as soon as its lookup succeeds, which may be immediately.
  void add(const std::shared_ptr<Wait>& wait);
  void remove(const std::shared_ptr<Wait>& wait);
  void add(const std::shared_ptr<Watch>& watch);
  void remove(const std::shared_ptr<Watch>& watch);

  // Returns whether there are no waits and no watches.
  bool empty() const { return entries_.load() == 0; }
  // Called by the writer after the data are visible and without locks. Not needed while the queue is empty.
  void notify(const Inserted& inserted);

 private:
  struct Waiters {
    std::vector<std::shared_ptr<Wait>> waits;
    std::vector<std::shared_ptr<Watch>> watches;
  };

  using Waits = std::vector<std::shared_ptr<Wait>>;

  void complete_or_enqueue(const std::shared_ptr<Wait>& wait, bool queued);
  WaitCondition condition_for(const LookupQuery& query, const Failure& failure) const;
  void add_behind(FrameId frame, Stamp common, std::vector<FrameId>& frames) const;
  template <class Waiter>
  void remove_from_name(const std::string& name, std::vector<std::shared_ptr<Waiter>> Waiters::* waiters,
                        const std::shared_ptr<Waiter>& waiter);
  void enqueue(const std::shared_ptr<Wait>& wait, WaitCondition condition);
  void dequeue(const std::shared_ptr<Wait>& wait);
  void forget(const std::shared_ptr<Wait>& wait);
  void retry(const Waits& waits);
  void attach_to_frame(const std::shared_ptr<Watch>& watch);
  void on_insertion(FrameId child);
  void on_new_names();

  // The waiters to notify of insertions, by frame modulo kCounters: the writer checks this before it takes the mutex.
  static constexpr std::size_t kCounters = 256;
  std::atomic<std::uint32_t>& watchers(FrameId frame) { return watchers_[frame % kCounters]; }

  const Tree& tree_;
  Ask ask_;
  std::function<void()> on_add_;
  std::array<std::atomic<std::uint32_t>, kCounters> watchers_{};
  std::mutex mutex_;
  std::unordered_map<FrameId, Waiters> by_frame_;
  std::unordered_map<std::string, Waiters> by_name_;  // for frames that do not exist yet
  std::unordered_map<const Wait*, std::shared_ptr<Wait>> waits_;
  std::vector<std::shared_ptr<Watch>> watches_of_all_;
  // What the writer checks before it takes the mutex.
  std::atomic<std::size_t> entries_{0}, waiting_{0}, names_{0}, watching_all_{0};
};

// Adds a wait to the queue for a scope.
class ScopedWait {
 public:
  ScopedWait(WaitQueue& queue, std::shared_ptr<Wait> wait) : queue_(queue), wait_(std::move(wait)) {
    queue_.add(wait_);
  }
  ScopedWait(const ScopedWait&) = delete;
  ScopedWait& operator=(const ScopedWait&) = delete;
  ~ScopedWait() { queue_.remove(wait_); }

 private:
  WaitQueue& queue_;
  std::shared_ptr<Wait> wait_;
};

}  // namespace coframe
