// The tree for many threads: one short critical section a call, waiting without polling, counts of what came in.
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>

#include "core/cdr.hpp"
#include "core/lookup.hpp"
#include "core/tree.hpp"

namespace coframe {

// A mutex under which a reader steps aside once for writers that wait, so that busy readers cannot starve the wire,
// nor busy writers the readers. Who waits sleeps: a writer that is not running must not make readers spin.
class TreeMutex {
 public:
  void lock_for_writing() {
    if (mutex_.try_lock()) return;
    writers_waiting_.fetch_add(1);
    mutex_.lock();
    writers_waiting_.fetch_sub(1);
    turns_.fetch_add(1);
    turns_.notify_all();
  }
  void lock_for_reading() {
    if (writers_waiting_.load(std::memory_order_relaxed) > 0) step_aside();
    mutex_.lock();
  }
  void unlock() { mutex_.unlock(); }

 private:
  // The turn is read before the writers are looked for: who still waits then will raise it.
  void step_aside() {
    const std::uint32_t turn = turns_.load();
    if (writers_waiting_.load() > 0) turns_.wait(turn);
  }

  std::mutex mutex_;
  std::atomic<int> writers_waiting_{0};
  std::atomic<std::uint32_t> turns_{0};  // of writers that had to wait
};

struct Counts {
  std::uint64_t messages = 0;   // TFMessages taken in as bytes
  std::uint64_t malformed = 0;  // of those, not decodable
  std::uint64_t stored = 0;     // transforms
  std::uint64_t refused = 0;    // transforms with bad names or values
  std::uint64_t old = 0;        // transforms older than the cache
};

// One source of messages: the same publisher sends the same names in the same order, so the last ones are tried
// first. Used by one thread at a time.
struct TransformStream {
  // More of one message's transforms are not remembered: there may be many sources, and any of them may send much.
  static constexpr std::size_t kMaxRemembered = 1024;
  struct Names {
    std::string parent, child;
    FrameId parent_id = 0, child_id = 0;
  };
  bool is_static = false;
  AuthorityId authority = 0;
  std::vector<Names> expected;
  std::vector<TransformView> decoded;
};

struct FrameSummary {
  std::string name, parent, authority;
  bool is_static;
  std::size_t samples;
  Stamp oldest, newest;
  double rate;
};

class Buffer {
 public:
  explicit Buffer(Stamp cache_length) : tree_(cache_length) {}

  Stamp cache_length() const { return tree_.cache_length(); }

  unsigned insert(std::string_view parent, std::string_view child, Stamp stamp, const TransformValues& values,
                  bool is_static, std::string_view authority);
  TransformStream open_stream(bool is_static, std::string_view authority);
  // The source has another name: notes it for the frames that its last messages told of, and for all to come.
  void rename(TransformStream& stream, std::string_view authority);
  DecodeFailure ingest(TransformStream& stream, const std::uint8_t* data, std::size_t size, std::size_t& stored);
  void clear();

  FrameId find(std::string_view name) const;
  std::string name(FrameId frame) const;
  bool lookup(FrameId target, FrameId source, Stamp& stamp, Pose& pose, Failure& failure) const;
  // The two legs are answered under one lock: `stamp` is the target leg's, in and out.
  bool lookup_full(FrameId target, Stamp& target_stamp, FrameId source, Stamp source_stamp, FrameId fixed, Pose& pose,
                   Failure& failure) const;
  bool latest_common_time(FrameId target, FrameId source, Stamp& stamp, Failure& failure) const;
  bool chain(FrameId target, FrameId source, Stamp stamp, std::vector<FrameId>& frames, Failure& failure) const;

  std::vector<FrameSummary> frames() const;
  std::vector<std::string> frame_names() const;
  // The newest sample of every static or every dynamic frame, as a TFMessage's CDR.
  std::string encode(bool is_static) const;
  Counts counts() const;
  // Runs `read` on the tree while nobody writes.
  template <class Read>
  auto read(Read&& read) const {
    ReadLock lock(mutex_);
    return read(tree_);
  }

  // Counts the insertions; a change of it is worth a new try.
  std::uint64_t changes() const { return changes_.load(); }
  // Waits until changes() differs from `seen`; false when `timeout_ns` passed without.
  bool wait_for_change(std::uint64_t seen, std::int64_t timeout_ns) const;

 private:
  struct ReadLock {
    explicit ReadLock(TreeMutex& mutex) : mutex(mutex) { mutex.lock_for_reading(); }
    ~ReadLock() { mutex.unlock(); }
    TreeMutex& mutex;
  };
  struct WriteLock {
    explicit WriteLock(TreeMutex& mutex) : mutex(mutex) { mutex.lock_for_writing(); }
    ~WriteLock() { mutex.unlock(); }
    TreeMutex& mutex;
  };

  bool store(TransformStream& stream, std::size_t index, const TransformView& view);
  bool count(unsigned refusals);
  void notify();

  mutable TreeMutex mutex_;
  Tree tree_;
  mutable PathCache paths_;
  Counts counts_;

  std::atomic<std::uint64_t> changes_{0};
  mutable std::atomic<int> waiting_{0};
  mutable std::mutex wait_mutex_;
  mutable std::condition_variable changed_;
};

}  // namespace coframe
