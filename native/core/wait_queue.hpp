// SPDX-License-Identifier: Apache-2.0
// Who waits for an insertion, found by the frame it concerns: an insertion on another edge costs nothing, and nobody is
// woken in vain.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "core/error.hpp"
#include "core/query.hpp"
#include "core/tree.hpp"

namespace coframe {

using Token = std::uint64_t;

// Where waits and watches that nobody sits at drop a note when something has happened. Any threads put in and take out.
class Mailbox {
 public:
  void put(Token token);
  // What has come.
  std::vector<Token> take();
  // Waits until something has come; false when `timeout_ns` passed without.
  bool wait_for(std::int64_t timeout_ns);
  bool empty() const { return count_.load() == 0; }

 private:
  std::atomic<std::size_t> count_{0};
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Token> tokens_;
};

// Where a wait sits: which insertion may help it.
struct WaitCondition {
  std::vector<FrameId> frames;  // one on the edge to the parent of one of these,
  std::string name;             // or one that makes this frame known,
  Stamp needed = 0;             // if the edge's newest stamp is then at least this
  bool operator==(const WaitCondition&) const = default;
};

// A query that waits for its answer. It owns its names.
class Wait {
 public:
  explicit Wait(const LookupQuery& query, std::shared_ptr<Mailbox> mailbox = nullptr, Token token = 0);
  Wait(const Wait&) = delete;
  Wait& operator=(const Wait&) = delete;

  const LookupQuery& query() const { return query_; }
  // Waits for the answer; false when `timeout_ns` passed without.
  bool wait_for(std::int64_t timeout_ns);
  bool done() const { return done_.load(std::memory_order_acquire); }
  const LookupResult& result() const { return result_; }  // once answered

 private:
  friend class WaitQueue;
  void complete(const LookupResult& result);

  std::string target_, source_, fixed_;
  LookupQuery query_;
  std::shared_ptr<Mailbox> mailbox_;
  Token token_;
  LookupResult result_;
  std::atomic<bool> done_{false};
  std::mutex mutex_;
  std::condition_variable ready_;
  WaitCondition condition_;  // guarded by the room
};

// Somebody wants to hear of changes of an edge, or of all. Several changes before the note is read are one.
class Watch {
 public:
  // `child` empty: all edges.
  Watch(std::string_view child, std::shared_ptr<Mailbox> mailbox, Token token)
      : child_(child), mailbox_(std::move(mailbox)), token_(token) {}

  // The frames whose edge to their parent has changed since the last call.
  std::vector<FrameId> take();

 private:
  friend class WaitQueue;
  void note(FrameId child);

  std::string child_;
  FrameId frame_ = 0;  // of that name, once it is known
  std::shared_ptr<Mailbox> mailbox_;
  Token token_;
  std::mutex mutex_;
  std::unordered_set<FrameId> changed_;
};

class WaitQueue {
 public:
  // Tries to answer; false: the failure says what is missing.
  using Ask = std::function<bool(LookupQuery&, LookupResult&, Failure&)>;

  WaitQueue(Tree& tree, Ask ask) : tree_(tree), ask_(std::move(ask)) {}

  // From now on the answer is brought as soon as there is one; that may be at once.
  void add(const std::shared_ptr<Wait>& wait);
  void remove(const std::shared_ptr<Wait>& wait);
  void add(const std::shared_ptr<Watch>& watch);
  void remove(const std::shared_ptr<Watch>& watch);

  // Whether nobody waits or watches.
  bool empty() const { return entries_.load() == 0; }
  // What the writer tells, after the data are visible and with no lock held. Needless in an empty room.
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

  Tree& tree_;
  Ask ask_;
  std::mutex mutex_;
  std::unordered_map<FrameId, Waiters> by_frame_;
  std::unordered_map<std::string, Waiters> by_name_;  // of frames that are not there yet
  std::unordered_map<const Wait*, std::shared_ptr<Wait>> waits_;
  std::vector<std::shared_ptr<Watch>> watches_of_all_;
  // What the writer looks at before it takes the mutex.
  std::atomic<std::size_t> entries_{0}, waiting_{0}, names_{0}, watching_all_{0};
};

// Sits in the room for a scope.
class ScopedWait {
 public:
  ScopedWait(WaitQueue& room, std::shared_ptr<Wait> wait) : room_(room), wait_(std::move(wait)) { room_.add(wait_); }
  ScopedWait(const ScopedWait&) = delete;
  ScopedWait& operator=(const ScopedWait&) = delete;
  ~ScopedWait() { room_.remove(wait_); }

 private:
  WaitQueue& room_;
  std::shared_ptr<Wait> wait_;
};

}  // namespace coframe
