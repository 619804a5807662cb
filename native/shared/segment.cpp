// SPDX-License-Identifier: Apache-2.0
#include "shared/segment.hpp"

#ifdef __linux__

#include <fcntl.h>
#include <linux/futex.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

#include "core/fork_guard.hpp"
#include "core/guarded_memory.hpp"
#include "core/tree.hpp"

namespace coframe {

namespace {

constexpr std::int64_t kNoCapacity = -1;

// The beginning of the memory.
struct Header {
  std::uint64_t layout = 0;
  std::uint64_t capacity = 0;
  Atomic<std::int64_t> writer{0};    // the number of its process
  Atomic<std::uint64_t> used{0};     // bytes that belong to the tree
  Atomic<std::uint64_t> backed{0};   // bytes that the system has reserved memory for
  Atomic<std::int64_t> shortage{0};  // why memory was refused last: an error of the system, or kNoCapacity; 0: never
  TreeData tree;
};

// Another value for every version whose processes cannot read each other's memory.
std::uint64_t layout() {
  constexpr std::uint64_t kVersion = 3;
  std::uint64_t sum = kVersion;
  for (const std::uint64_t part : {sizeof(Header), sizeof(TreeData), sizeof(Frame), sizeof(History), sizeof(Chunk),
                                   sizeof(ChunkHeader), std::size_t{NameTable::hash_of("base_link")}}) {
    sum = sum * 0x9e3779b97f4a7c15u + part;
  }
  return sum;
}

[[noreturn]] void fail(const std::string& what) {
  throw SegmentError(what + ": " + std::system_category().message(errno));
}

class File;

struct OpenFiles {
  std::mutex mutex;
  std::set<File*> files;
};
// Never destroyed, and not created on first use: a thread that forks could find it half created.
OpenFiles& open_files = *new OpenFiles;

// A file that is closed at the end of its scope, and in forked children: locks end when the last copy is closed.
class File {
 public:
  File() = default;
  explicit File(int number) : number_(number) {
    if (number < 0) return;
    const ForkSafeLock lock(open_files.mutex);
    open_files.files.insert(this);
  }
  File(File&& other) noexcept { *this = std::move(other); }
  File& operator=(File&& other) noexcept {
    const ForkSafeScope scope;
    const int number = other.release();
    close();
    File copy(number);
    std::swap(copy.number_, number_);
    const ForkSafeLock lock(open_files.mutex);
    if (number_ >= 0) open_files.files.insert(this);
    return *this;
  }
  ~File() { close(); }

  int number() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }
  void close() {
    const ForkSafeScope scope;
    const int number = release();
    if (number >= 0) ::close(number);
  }
  // In a forked child, where no other thread exists.
  void forget() { ::close(std::exchange(number_, -1)); }
  bool lock(int operation) const {
    while (flock(number_, operation | LOCK_NB) != 0) {
      if (errno != EINTR) return false;
    }
    return true;
  }
  // Whether a path still names this file.
  bool is_at(const std::string& path) const {
    struct stat here, there;
    return fstat(number_, &here) == 0 && ::stat(path.c_str(), &there) == 0 && here.st_ino == there.st_ino &&
           here.st_dev == there.st_dev;
  }

 private:
  int release() {
    const ForkSafeLock lock(open_files.mutex);
    open_files.files.erase(this);
    return std::exchange(number_, -1);
  }

  int number_ = -1;
};

[[maybe_unused]] const int closes_in_children = pthread_atfork(nullptr, nullptr, [] {
  for (File* file : std::exchange(open_files.files, {})) file->forget();
});

// A part of the address space.
class Mapping {
 public:
  Mapping(const File& file, std::size_t size, bool writable, const std::string& path)
      : size_(size), start_(map(file, size, writable)), guard_(start_, size, loss_of(path)) {}
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
  ~Mapping() { munmap(start_, size_); }
  Header& header() const { return *static_cast<Header*>(start_); }
  std::byte* data() const { return static_cast<std::byte*>(start_); }
  std::size_t size() const { return size_; }
  GuardedMemory& guard() { return guard_; }

 private:
  static void* map(const File& file, std::size_t size, bool writable) {
    void* start = mmap(nullptr, size, PROT_READ | (writable ? PROT_WRITE : 0), MAP_SHARED, file.number(), 0);
    if (start == MAP_FAILED) fail("the shared memory cannot be mapped");
    return start;
  }
  static LostMemory loss_of(const std::string& path) {
    return {LostMemory::Kind::shared,
            "The shared transforms in " + path +
                " are lost, because another program has truncated this file. Restart the programs that share them."};
  }

  std::size_t size_;
  void* start_;
  GuardedMemory guard_;
};

// Reserves memory of the system for a part of a file; returns 0 or the error.
int back_with_memory(const File& file, std::size_t start, std::size_t size) {
  int error;
  do {
    error = posix_fallocate(file.number(), static_cast<off_t>(start), static_cast<off_t>(size));
  } while (error == EINTR);
  return error;
}

// Takes memory from the segment in order. Only the writer does.
class SegmentMemory final : public Memory {
 public:
  SegmentMemory(File file, std::shared_ptr<Mapping> mapping)
      : file_(std::move(file)), mapping_(std::move(mapping)), end_(mapping_->header().capacity) {}

  void* take(std::size_t size, std::size_t alignment) override {
    const std::size_t start = next(alignment);
    if (!reserve(start, size)) throw std::bad_alloc();
    // A writer that dies before it uses the memory loses it, so it must not be taken twice.
    mapping_->header().used.store(start + size, std::memory_order_release);
    return mapping_->data() + start;
  }
  bool has_room(std::size_t size) override { return reserve(next(kAlignment), size); }

 private:
  static constexpr std::size_t kStep = 1 << 20;

  std::size_t next(std::size_t alignment) const {
    return (mapping_->header().used.load() + alignment - 1) / alignment * alignment;
  }

  // Without this, a write to memory that the system does not have would end the process.
  bool reserve(std::size_t start, std::size_t size) {
    if (mapping_->guard().lost()) return false;
    Header& header = mapping_->header();
    if (start > end_ || size > end_ - start) {
      if (header.shortage.load() == 0) header.shortage.store(kNoCapacity);
      return false;
    }
    const std::size_t backed = header.backed.load(), needed = start + size;
    if (needed <= backed) return true;
    const std::size_t step = std::min<std::size_t>((needed - backed + kStep - 1) / kStep * kStep, end_ - backed);
    if (const int error = back_with_memory(file_, backed, step)) {
      header.shortage.store(error);
      end_ = backed;
      return false;
    }
    header.backed.store(backed + step);
    return true;
  }

  File file_;
  std::shared_ptr<Mapping> mapping_;
  std::size_t end_;
};

bool is_private(const struct stat& status) { return status.st_uid == geteuid() && (status.st_mode & 0077) == 0; }

// Only this user may enter the folder, so the files in it are those of this user.
void make_private_folder(const std::string& folder) {
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) fail("the folder " + folder + " cannot be created");
  struct stat status;
  if (lstat(folder.c_str(), &status) != 0) fail("the folder " + folder + " cannot be read");
  if (!S_ISDIR(status.st_mode) || !is_private(status)) {
    throw SegmentError("the folder " + folder + " does not belong to this user alone");
  }
}

// In a scope, because a child process must not inherit a file before it is registered.
File open_file(const std::string& path, int flags, mode_t mode = 0) {
  const ForkSafeScope scope;
  return File(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, mode));
}

class LinuxSegment final : public Segment {
 public:
  LinuxSegment(const std::string& folder, const std::string& name)
      : path_(folder + "/" + name), lock_path_(path_ + ".lock") {
    make_private_folder(folder);
    if (mkfifo(lock_path_.c_str(), 0600) != 0 && errno != EEXIST) fail("the file " + lock_path_ + " cannot be created");
    end_of_writer_ = open_file(lock_path_, O_RDONLY | O_NONBLOCK);
    if (!end_of_writer_) fail("the file " + lock_path_ + " cannot be opened");
    interrupt_ = File(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
    if (!interrupt_) fail("an event cannot be created");
  }
  ~LinuxSegment() override { LinuxSegment::close(); }

  void attach(Stamp cache_length, std::size_t capacity) {
    constexpr int kPatience = 2000;  // milliseconds
    for (int turn = 0; turn < kPatience; ++turn) {
      if (try_attach(cache_length, capacity)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    throw SegmentError("the shared memory " + path_ + " is not usable: its writer does not complete it");
  }

  SharedTreeData reader() override;

  bool try_to_write() override {
    const ForkSafeLock lock(mutex_);
    if (writer_lock_) return true;
    if (!memory_file_) return false;
    // Opened before it is locked: those that wait for the end of the pipe never see a writer without it.
    File candidate = open_file(lock_path_, O_RDWR | O_NONBLOCK);
    if (!candidate || !candidate.lock(LOCK_EX)) return false;
    writer_lock_ = std::move(candidate);
    return true;
  }

  SharedTreeData writer() override { return map_writable(true); }

  void stop_writing() override {
    const ForkSafeLock lock(mutex_);
    writer_lock_.close();
  }

  std::int64_t writer_process() const override { return mapping_->header().writer.load(); }

  void wait_for_vacancy(std::int64_t timeout_ns) override {
    pollfd files[] = {{end_of_writer_.number(), 0, 0}, {interrupt_.number(), POLLIN, 0}};
    const auto milliseconds = timeout_ns < 0 ? -1 : std::min<std::int64_t>(timeout_ns / 1'000'000 + 1, 1 << 30);
    poll(files, 2, static_cast<int>(milliseconds));
  }

  void interrupt() override {
    const std::uint64_t increment = 1;
    (void)!write(interrupt_.number(), &increment, sizeof increment);
  }

  bool outdated() const override { return mapping_->header().tree.outdated.load() != 0; }

  std::size_t used() const override { return mapping_->header().used.load(); }

  bool lost() const override {
    struct stat status;
    return mapping_->guard().lost() ||
           (fstat(memory_file_.number(), &status) == 0 && static_cast<std::size_t>(status.st_size) < mapping_->size());
  }

  std::string shortage() const override {
    const Header& header = mapping_->header();
    const std::int64_t shortage = header.shortage.load();
    if (shortage == 0) return {};
    if (shortage != kNoCapacity) return path_ + ": " + std::system_category().message(static_cast<int>(shortage));
    return "all " + std::to_string(header.capacity >> 20) + " MB of " + path_ + " are in use";
  }

  void close() override {
    const ForkSafeLock lock(mutex_);
    interrupt();
    if (!memory_file_) return;
    // The last one removes the memory.
    if (!writer_lock_) {
      File candidate = open_file(lock_path_, O_RDWR | O_NONBLOCK);
      if (candidate && candidate.lock(LOCK_EX)) writer_lock_ = std::move(candidate);
    }
    if (writer_lock_ && memory_file_.lock(LOCK_EX) && memory_file_.is_at(path_)) unlink(path_.c_str());
    writer_lock_.close();
    memory_file_.close();
  }

  // Completes a change whose writer has died, without becoming the writer. Returns false if there is a writer.
  bool complete_change_of_dead_writer() {
    File candidate = open_file(lock_path_, O_RDWR | O_NONBLOCK);
    if (!candidate || !candidate.lock(LOCK_EX)) return false;
    Tree(map_writable(false)).recover();
    return true;
  }

 private:
  // Returns false if it has to be tried again.
  bool try_attach(Stamp cache_length, std::size_t capacity) {
    File lock = open_file(lock_path_, O_RDWR | O_NONBLOCK);
    if (!lock) fail("the file " + lock_path_ + " cannot be opened");
    if (lock.lock(LOCK_EX)) {
      // Locked until it is replaced, so that no other process opens it in the meantime.
      const File abandoned_file = open_file(path_, O_RDONLY);
      if (!abandoned_file || abandoned_file.lock(LOCK_EX)) create(cache_length, capacity);
      writer_lock_ = std::move(lock);
    }
    File file = open_file(path_, O_RDONLY);
    if (!file || !file.lock(LOCK_SH) || !file.is_at(path_)) {
      writer_lock_.close();
      return false;
    }
    struct stat status;
    if (fstat(file.number(), &status) != 0 || !is_private(status) || !S_ISREG(status.st_mode) ||
        static_cast<std::size_t>(status.st_size) < sizeof(Header)) {
      throw SegmentError("the file " + path_ + " is not shared memory of this user");
    }
    mapping_ = std::make_shared<Mapping>(file, static_cast<std::size_t>(status.st_size), false, path_);
    const Header& header = mapping_->header();
    if (header.layout != layout() || header.capacity != static_cast<std::size_t>(status.st_size)) {
      throw SegmentError("the file " + path_ + " was not written by this version of coframe");
    }
    memory_file_ = std::move(file);
    return true;
  }

  // A new tree that has less room than this would refuse almost every transform.
  static constexpr std::size_t kMinRoom = 6 << 20;

  // The memory appears under its name when it is complete.
  void create(Stamp cache_length, std::size_t capacity) {
    const std::string draft_path = path_ + ".new";
    unlink(draft_path.c_str());
    File file = open_file(draft_path, O_RDWR | O_CREAT | O_EXCL, 0600);
    if (!file) fail("the file " + draft_path + " cannot be created");
    const std::size_t backed_size = std::min(kMinRoom, capacity);
    const int error = back_with_memory(file, 0, backed_size);
    if (error != 0 || ftruncate(file.number(), static_cast<off_t>(capacity)) != 0) {
      if (error != 0) errno = error;
      unlink(draft_path.c_str());
      fail("there is no room for shared memory in " + path_);
    }
    const auto mapping = std::make_shared<Mapping>(file, capacity, true, path_);
    auto* header = new (mapping->data()) Header;
    header->layout = layout();
    header->capacity = capacity;
    header->used.store(sizeof(Header));
    header->backed.store(backed_size);
    SegmentMemory memory(std::move(file), mapping);
    const auto now = std::chrono::system_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
    initialize(header->tree, memory, cache_length, static_cast<std::uint64_t>(now));
    if (rename(draft_path.c_str(), path_.c_str()) != 0) fail("the file " + draft_path + " cannot be renamed");
  }

  SharedTreeData map_writable(bool as_writer);

  const std::string path_, lock_path_;
  std::mutex mutex_;  // guards the files below
  File end_of_writer_, interrupt_, memory_file_, writer_lock_;
  std::shared_ptr<Mapping> mapping_;
};

// Waiting needs no access to the memory for writing.
class Access final : public SharedAccess {
 public:
  Access(std::shared_ptr<LinuxSegment> segment, std::shared_ptr<Mapping> mapping)
      : segment_(std::move(segment)), mapping_(std::move(mapping)) {}

  bool complete_change() override { return segment_->complete_change_of_dead_writer(); }

  std::string unfinished_change() const override {
    const std::string process = std::to_string(segment_->writer_process());
    return "process " + process +
           ", which writes the shared transforms, is suspended in the middle of a change; continue it (kill -CONT " +
           process + ") or end it";
  }

  void wait_for_change(std::uint64_t known_changes, std::int64_t timeout_ns) override {
    constexpr std::int64_t kSecond = 1'000'000'000;
    std::timespec limit{.tv_sec = static_cast<std::time_t>(timeout_ns / kSecond),
                        .tv_nsec = static_cast<long>(timeout_ns % kSecond)};
    if (mapping_->header().tree.changes.load() != known_changes) return;
    syscall(SYS_futex, word(), FUTEX_WAIT, static_cast<std::uint32_t>(known_changes), &limit, nullptr, 0);
  }

  void wake() override { syscall(SYS_futex, word(), FUTEX_WAKE, 0x7fffffff, nullptr, nullptr, 0); }

 private:
  // The half of the number of changes that every change alters.
  std::uint32_t* word() const {
    auto* words = reinterpret_cast<std::uint32_t*>(&mapping_->header().tree.changes);
    return words + (std::endian::native == std::endian::little ? 0 : 1);
  }

  std::shared_ptr<LinuxSegment> segment_;
  std::shared_ptr<Mapping> mapping_;
};

SharedTreeData LinuxSegment::reader() {
  const auto self = std::static_pointer_cast<LinuxSegment>(shared_from_this());
  return {&mapping_->header().tree, nullptr, std::make_shared<Access>(self, mapping_),
          std::shared_ptr<GuardedMemory>(mapping_, &mapping_->guard())};
}

SharedTreeData LinuxSegment::map_writable(bool as_writer) {
  File file = open_file(path_, O_RDWR);
  if (!file || !file.is_at(path_)) fail("the file " + path_ + " cannot be opened");
  const auto mapping = std::make_shared<Mapping>(file, mapping_->header().capacity, true, path_);
  if (as_writer) mapping->header().writer.store(getpid());
  const auto self = std::static_pointer_cast<LinuxSegment>(shared_from_this());
  return {&mapping->header().tree, std::make_shared<SegmentMemory>(std::move(file), mapping),
          std::make_shared<Access>(self, mapping), std::shared_ptr<GuardedMemory>(mapping, &mapping->guard())};
}

}  // namespace

std::shared_ptr<Segment> Segment::open(const std::string& folder, const std::string& name, Stamp cache_length,
                                       std::size_t capacity) {
  char suffix[20];
  std::snprintf(suffix, sizeof suffix, "-%08x", static_cast<unsigned>(layout() >> 32 ^ layout()));
  auto segment = std::make_shared<LinuxSegment>(folder, name + suffix);
  segment->attach(cache_length, capacity);
  return segment;
}

}  // namespace coframe

#else

namespace coframe {

std::shared_ptr<Segment> Segment::open(const std::string&, const std::string&, Stamp, std::size_t) {
  throw SegmentError("sharing transforms between processes is supported only on Linux");
}

}  // namespace coframe

#endif
