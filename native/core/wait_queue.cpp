// SPDX-License-Identifier: Apache-2.0
#include "core/wait_queue.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/fork_guard.hpp"

namespace coframe {

namespace {

constexpr Stamp kAnyStamp = std::numeric_limits<Stamp>::min();

bool is_for_latest(const LookupQuery& query) {
  return query.stamp == 0 || (query.time_travel && query.source_stamp == 0);
}

template <class T>
void remove_unordered(std::vector<std::shared_ptr<T>>& items, const std::shared_ptr<T>& item) {
  const auto found = std::find(items.begin(), items.end(), item);
  if (found == items.end()) return;
  *found = std::move(items.back());
  items.pop_back();
}

}  // namespace

void Mailbox::put(Token token) {
  {
    const std::lock_guard lock(mutex_);
    tokens_.push_back(token);
    count_.store(tokens_.size());
  }
  arrival_.set();
}

std::vector<Token> Mailbox::take() {
  const std::lock_guard lock(mutex_);
  count_.store(0);
  return std::exchange(tokens_, {});
}

bool Mailbox::wait_for(std::int64_t timeout_ns) {
  if (empty()) arrival_.wait(timeout_ns);
  return !empty();
}

Wait::Wait(const LookupQuery& query, std::shared_ptr<Mailbox> mailbox, Token token)
    : target_(query.target),
      source_(query.source),
      fixed_(query.fixed),
      query_(query),
      mailbox_(std::move(mailbox)),
      token_(token) {
  query_.target = target_;
  query_.source = source_;
  query_.fixed = fixed_;
}

bool Wait::wait_for(std::int64_t timeout_ns) {
  if (!done()) ready_.wait(timeout_ns);
  return done();
}

void Wait::complete(const LookupResult& result) {
  result_ = result;
  done_.store(true, std::memory_order_release);
  ready_.set();
  if (mailbox_) mailbox_->put(token_);
}

std::vector<FrameId> Watch::take() {
  const std::lock_guard lock(mutex_);
  const std::vector<FrameId> taken(changed_.begin(), changed_.end());
  changed_.clear();
  return taken;
}

void Watch::note(FrameId child) {
  const std::lock_guard lock(mutex_);
  const bool is_first = changed_.empty();
  changed_.insert(child);
  if (is_first) mailbox_->put(token_);
}

void WaitQueue::on_add(std::function<void()> call) {
  const ForkSafeLock lock(mutex_);
  on_add_ = std::move(call);
  if (on_add_ && !empty()) on_add_();
}

void WaitQueue::add(const std::shared_ptr<Wait>& wait) {
  const ForkSafeLock lock(mutex_);
  waits_.emplace(wait.get(), wait);
  entries_.fetch_add(1);
  waiting_.fetch_add(1);
  if (on_add_) on_add_();
  try {
    complete_or_enqueue(wait, false);
  } catch (...) {
    forget(wait);
    throw;
  }
}

void WaitQueue::remove(const std::shared_ptr<Wait>& wait) {
  const ForkSafeLock lock(mutex_);
  dequeue(wait);
  forget(wait);
}

void WaitQueue::forget(const std::shared_ptr<Wait>& wait) {
  if (waits_.erase(wait.get()) == 0) return;
  waiting_.fetch_sub(1);
  entries_.fetch_sub(1);
}

void WaitQueue::add(const std::shared_ptr<Watch>& watch) {
  const ForkSafeLock lock(mutex_);
  entries_.fetch_add(1);
  if (on_add_) on_add_();
  if (watch->child_.empty()) {
    watches_of_all_.push_back(watch);
    watching_all_.fetch_add(1);
    return;
  }
  by_name_[watch->child_].watches.push_back(watch);
  names_.fetch_add(1);
  attach_to_frame(watch);
}

void WaitQueue::remove(const std::shared_ptr<Watch>& watch) {
  const ForkSafeLock lock(mutex_);
  entries_.fetch_sub(1);
  if (watch->child_.empty()) {
    remove_unordered(watches_of_all_, watch);
    watching_all_.fetch_sub(1);
  } else if (watch->frame_ == 0) {
    remove_from_name(watch->child_, &Waiters::watches, watch);
  } else {
    remove_unordered(by_frame_[watch->frame_].watches, watch);
    watchers(watch->frame_).fetch_sub(1);
  }
}

// Moves the watch from the name to the frame, if the frame exists by now.
void WaitQueue::attach_to_frame(const std::shared_ptr<Watch>& watch) {
  const FrameId frame = tree_.find(watch->child_);
  if (frame == 0) return;
  remove_from_name(watch->child_, &Waiters::watches, watch);
  watch->frame_ = frame;
  by_frame_[frame].watches.push_back(watch);
  watchers(frame).fetch_add(1);
}

void WaitQueue::notify(const Inserted& inserted) {
  if (inserted.rewired && waiting_.load() > 0) {
    const ForkSafeLock lock(mutex_);
    Waits waits;
    for (const auto& [_, wait] : waits_) {
      if (wait->condition_.name.empty()) waits.push_back(wait);
    }
    retry(waits);
  }
  if (inserted.new_names && names_.load() > 0) on_new_names();
  if (inserted.child == 0) return;
  if (watchers(inserted.child).load() > 0 || watching_all_.load() > 0) on_insertion(inserted.child);
}

void WaitQueue::on_insertion(FrameId child) {
  const ForkSafeLock lock(mutex_);
  for (const auto& watch : watches_of_all_) watch->note(child);
  const auto waiters = by_frame_.find(child);
  if (waiters == by_frame_.end()) return;
  for (const auto& watch : waiters->second.watches) watch->note(child);
  const History::View history = tree_.history(child);
  Waits ready_waits;
  for (const auto& wait : waiters->second.waits) {
    if (history.is_static() || history.newest() >= wait->condition_.needed) ready_waits.push_back(wait);
  }
  retry(ready_waits);
}

void WaitQueue::on_new_names() {
  const ForkSafeLock lock(mutex_);
  Waits ready_waits;
  std::vector<std::shared_ptr<Watch>> watches;
  for (const auto& [name, waiters] : by_name_) {
    if (tree_.find(name) == 0) continue;
    ready_waits.insert(ready_waits.end(), waiters.waits.begin(), waiters.waits.end());
    watches.insert(watches.end(), waiters.watches.begin(), waiters.watches.end());
  }
  for (const auto& watch : watches) attach_to_frame(watch);
  retry(ready_waits);
}

void WaitQueue::retry(const Waits& waits) {
  for (const auto& wait : waits) complete_or_enqueue(wait, true);
}

// A wait is registered before its last attempt, and a writer checks for waiters after its data are visible, so one of
// the two always sees the other. A repeated attempt keeps its condition unless the condition changes.
void WaitQueue::complete_or_enqueue(const std::shared_ptr<Wait>& wait, bool queued) {
  for (;;) {
    LookupResult result;
    Failure failure;
    if (ask_(wait->query_, result, failure)) {
      dequeue(wait);
      forget(wait);
      wait->complete(result);
      return;
    }
    WaitCondition condition = condition_for(wait->query_, failure);
    if (queued && condition == wait->condition_) return;
    dequeue(wait);
    enqueue(wait, std::move(condition));
    queued = true;
  }
}

// Either walk may continue from where it ended, so both ends are watched, whichever of them the failure reports.
WaitCondition WaitQueue::condition_for(const LookupQuery& query, const Failure& failure) const {
  WaitCondition condition;
  if (failure.code == ErrorCode::unknown_frame) condition.name = failure.name;
  condition.frames = {failure.target_end, failure.source_end};
  condition.needed = failure.requested;
  if (is_for_latest(query)) {
    condition.needed = kAnyStamp;
    add_behind(failure.target, failure.requested, condition.frames);
    add_behind(failure.source, failure.requested, condition.frames);
  }
  std::erase(condition.frames, 0);
  std::sort(condition.frames.begin(), condition.frames.end());
  condition.frames.erase(std::unique(condition.frames.begin(), condition.frames.end()), condition.frames.end());
  return condition;
}

// The latest common time is determined by the edges that are furthest behind, and changes with them.
void WaitQueue::add_behind(FrameId frame, Stamp common, std::vector<FrameId>& frames) const {
  for (int depth = 0; depth <= kMaxDepth; ++depth) {
    const History::View history = tree_.history(frame);
    if (history.empty() || (!history.is_static() && history.newest() <= common)) frames.push_back(frame);
    if (history.empty()) return;
    frame = history.parent();
  }
}

void WaitQueue::enqueue(const std::shared_ptr<Wait>& wait, WaitCondition condition) {
  wait->condition_ = std::move(condition);
  for (const FrameId frame : wait->condition_.frames) {
    by_frame_[frame].waits.push_back(wait);
    watchers(frame).fetch_add(1);
  }
  if (!wait->condition_.name.empty()) {
    by_name_[wait->condition_.name].waits.push_back(wait);
    names_.fetch_add(1);
  }
  std::atomic_thread_fence(std::memory_order_seq_cst);
}

void WaitQueue::dequeue(const std::shared_ptr<Wait>& wait) {
  for (const FrameId frame : wait->condition_.frames) {
    remove_unordered(by_frame_[frame].waits, wait);
    watchers(frame).fetch_sub(1);
  }
  if (!wait->condition_.name.empty()) remove_from_name(wait->condition_.name, &Waiters::waits, wait);
  wait->condition_ = WaitCondition{};
}

// Names that never become frames must not accumulate.
template <class Waiter>
void WaitQueue::remove_from_name(const std::string& name, std::vector<std::shared_ptr<Waiter>> Waiters::* waiters,
                                 const std::shared_ptr<Waiter>& waiter) {
  const auto found = by_name_.find(name);
  if (found == by_name_.end()) return;
  remove_unordered(found->second.*waiters, waiter);
  names_.fetch_sub(1);
  if (found->second.waits.empty() && found->second.watches.empty()) by_name_.erase(found);
}

}  // namespace coframe
