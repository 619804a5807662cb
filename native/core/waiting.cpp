#include "core/waiting.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace coframe {

namespace {

constexpr Stamp kAnyStamp = std::numeric_limits<Stamp>::min();

bool asks_latest(const Question& question) {
  return question.stamp == 0 || (question.travels && question.source_stamp == 0);
}

template <class T>
void take_out(std::vector<std::shared_ptr<T>>& all, const std::shared_ptr<T>& one) {
  const auto found = std::find(all.begin(), all.end(), one);
  if (found == all.end()) return;
  *found = std::move(all.back());
  all.pop_back();
}

}  // namespace

void Mailbox::put(Token token) {
  {
    const std::lock_guard lock(mutex_);
    tokens_.push_back(token);
    count_.store(tokens_.size());
  }
  arrived_.notify_one();
}

std::vector<Token> Mailbox::take() {
  const std::lock_guard lock(mutex_);
  count_.store(0);
  return std::exchange(tokens_, {});
}

bool Mailbox::wait_for(std::int64_t timeout_ns) {
  std::unique_lock lock(mutex_);
  return arrived_.wait_for(lock, std::chrono::nanoseconds(timeout_ns), [this] { return !tokens_.empty(); });
}

Wait::Wait(const Question& question, std::shared_ptr<Mailbox> mailbox, Token token)
    : target_(question.target),
      source_(question.source),
      fixed_(question.fixed),
      question_(question),
      mailbox_(std::move(mailbox)),
      token_(token) {
  question_.target = target_;
  question_.source = source_;
  question_.fixed = fixed_;
}

bool Wait::wait_for(std::int64_t timeout_ns) {
  std::unique_lock lock(mutex_);
  return ready_.wait_for(lock, std::chrono::nanoseconds(timeout_ns), [this] { return answered(); });
}

void Wait::bring(const Answer& answer) {
  {
    const std::lock_guard lock(mutex_);
    answer_ = answer;
    answered_.store(true, std::memory_order_release);
    ready_.notify_all();
  }
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

void WaitingRoom::add(const std::shared_ptr<Wait>& wait) {
  const std::lock_guard lock(mutex_);
  waits_.emplace(wait.get(), wait);
  guests_.fetch_add(1);
  waiting_.fetch_add(1);
  answer_or_seat(wait, false);
}

void WaitingRoom::remove(const std::shared_ptr<Wait>& wait) {
  const std::lock_guard lock(mutex_);
  stand_up(wait);
  forget(wait);
}

void WaitingRoom::forget(const std::shared_ptr<Wait>& wait) {
  if (waits_.erase(wait.get()) == 0) return;
  waiting_.fetch_sub(1);
  guests_.fetch_sub(1);
}

void WaitingRoom::add(const std::shared_ptr<Watch>& watch) {
  const std::lock_guard lock(mutex_);
  guests_.fetch_add(1);
  if (watch->child_.empty()) {
    watches_of_all_.push_back(watch);
    watching_all_.fetch_add(1);
    return;
  }
  by_name_[watch->child_].watches.push_back(watch);
  names_.fetch_add(1);
  move_in(watch);
}

void WaitingRoom::remove(const std::shared_ptr<Watch>& watch) {
  const std::lock_guard lock(mutex_);
  guests_.fetch_sub(1);
  if (watch->child_.empty()) {
    take_out(watches_of_all_, watch);
    watching_all_.fetch_sub(1);
  } else if (watch->frame_ == 0) {
    take_from_name(watch->child_, &Guests::watches, watch);
  } else {
    take_out(by_frame_[watch->frame_].watches, watch);
    tree_.frame(watch->frame_).watchers.fetch_sub(1);
  }
}

// From the name to the frame, if there is one by now.
void WaitingRoom::move_in(const std::shared_ptr<Watch>& watch) {
  const FrameId frame = tree_.find(watch->child_);
  if (frame == 0) return;
  take_from_name(watch->child_, &Guests::watches, watch);
  watch->frame_ = frame;
  by_frame_[frame].watches.push_back(watch);
  tree_.frame(frame).watchers.fetch_add(1);
}

void WaitingRoom::tell(const Inserted& inserted) {
  if (inserted.rewired && waiting_.load() > 0) {
    const std::lock_guard lock(mutex_);
    Waits all;
    for (const auto& [_, wait] : waits_) {
      if (wait->seat_.name.empty()) all.push_back(wait);
    }
    try_again(all);
  }
  if (inserted.new_names && names_.load() > 0) on_new_names();
  if (inserted.child == 0) return;
  if (tree_.frame(inserted.child).watchers.load() > 0 || watching_all_.load() > 0) on_insertion(inserted.child);
}

void WaitingRoom::on_insertion(FrameId child) {
  const std::lock_guard lock(mutex_);
  for (const auto& watch : watches_of_all_) watch->note(child);
  const auto guests = by_frame_.find(child);
  if (guests == by_frame_.end()) return;
  for (const auto& watch : guests->second.watches) watch->note(child);
  const History::View history = tree_.history(child);
  Waits helped;
  for (const auto& wait : guests->second.waits) {
    if (history.is_static() || history.newest() >= wait->seat_.needed) helped.push_back(wait);
  }
  try_again(helped);
}

void WaitingRoom::on_new_names() {
  const std::lock_guard lock(mutex_);
  Waits helped;
  std::vector<std::shared_ptr<Watch>> watches;
  for (const auto& [name, guests] : by_name_) {
    if (tree_.find(name) == 0) continue;
    helped.insert(helped.end(), guests.waits.begin(), guests.waits.end());
    watches.insert(watches.end(), guests.watches.begin(), guests.watches.end());
  }
  for (const auto& watch : watches) move_in(watch);
  try_again(helped);
}

void WaitingRoom::try_again(const Waits& waits) {
  for (const auto& wait : waits) answer_or_seat(wait, true);
}

// A wait sits down before it asks for the last time, and a writer looks for guests after the data are visible: one of
// the two always sees the other. Who asks again keeps the seat until another one is better.
void WaitingRoom::answer_or_seat(const std::shared_ptr<Wait>& wait, bool seated) {
  for (;;) {
    Answer answer;
    Failure failure;
    if (ask_(wait->question_, answer, failure)) {
      stand_up(wait);
      forget(wait);
      wait->bring(answer);
      return;
    }
    Seat seat = seat_for(wait->question_, failure);
    if (seated && seat == wait->seat_) return;
    stand_up(wait);
    sit_down(wait, std::move(seat));
    seated = true;
  }
}

// Either walk may get on to where the other one ended, so both ends are to be watched, whichever the failure tells of.
Seat WaitingRoom::seat_for(const Question& question, const Failure& failure) const {
  Seat seat;
  if (failure.code == ErrorCode::unknown_frame) seat.name = failure.name;
  seat.frames = {failure.target_end, failure.source_end};
  seat.needed = failure.requested;
  if (asks_latest(question)) {
    seat.needed = kAnyStamp;
    add_lagging(failure.target, failure.requested, seat.frames);
    add_lagging(failure.source, failure.requested, seat.frames);
  }
  std::erase(seat.frames, 0);
  std::sort(seat.frames.begin(), seat.frames.end());
  seat.frames.erase(std::unique(seat.frames.begin(), seat.frames.end()), seat.frames.end());
  return seat;
}

// The latest common time is that of the links that are furthest behind: it moves with them.
void WaitingRoom::add_lagging(FrameId frame, Stamp common, std::vector<FrameId>& frames) const {
  for (int depth = 0; depth <= kMaxDepth; ++depth) {
    const History::View history = tree_.history(frame);
    if (history.empty() || (!history.is_static() && history.newest() <= common)) frames.push_back(frame);
    if (history.empty()) return;
    frame = history.parent();
  }
}

void WaitingRoom::sit_down(const std::shared_ptr<Wait>& wait, Seat seat) {
  wait->seat_ = std::move(seat);
  for (const FrameId frame : wait->seat_.frames) {
    by_frame_[frame].waits.push_back(wait);
    tree_.frame(frame).watchers.fetch_add(1);
  }
  if (!wait->seat_.name.empty()) {
    by_name_[wait->seat_.name].waits.push_back(wait);
    names_.fetch_add(1);
  }
  std::atomic_thread_fence(std::memory_order_seq_cst);
}

void WaitingRoom::stand_up(const std::shared_ptr<Wait>& wait) {
  for (const FrameId frame : wait->seat_.frames) {
    take_out(by_frame_[frame].waits, wait);
    tree_.frame(frame).watchers.fetch_sub(1);
  }
  if (!wait->seat_.name.empty()) take_from_name(wait->seat_.name, &Guests::waits, wait);
  wait->seat_ = Seat{};
}

// Names that never become frames must not pile up.
template <class Guest>
void WaitingRoom::take_from_name(const std::string& name, std::vector<std::shared_ptr<Guest>> Guests::*guests,
                                 const std::shared_ptr<Guest>& guest) {
  const auto seats = by_name_.find(name);
  if (seats == by_name_.end()) return;
  take_out(seats->second.*guests, guest);
  names_.fetch_sub(1);
  if (seats->second.waits.empty() && seats->second.watches.empty()) by_name_.erase(seats);
}

}  // namespace coframe
