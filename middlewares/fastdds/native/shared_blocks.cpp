// SPDX-License-Identifier: Apache-2.0
#include "shared_blocks.hpp"

#include <algorithm>
#include <cstring>
#include <random>

#ifdef __linux__
#include <fcntl.h>
#include <linux/futex.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <csignal>
#include <ctime>
#include <fstream>
#endif

namespace coframe::fastdds {
namespace {

constexpr std::uint64_t kMagic = 0x31'6b'63'6f'6c'62'66'63;  // "cfblock1"
constexpr std::uint64_t kReading = 1;
constexpr std::uint64_t kWaiting = std::uint64_t{1} << 16;
constexpr std::uint64_t kReaders = 0xffff;  // the largest number of readers
constexpr std::size_t kSpare = 2;           // blocks beyond those of the messages that are kept

std::uint32_t number_of(std::uint64_t state) { return static_cast<std::uint32_t>(state >> 32); }
std::uint64_t reading(std::uint64_t state) { return state & kReaders; }
std::uint64_t waiting(std::uint64_t state) { return state >> 16 & kReaders; }

std::uint64_t state_of(std::uint32_t number, std::size_t readers) {
  return std::uint64_t{number} << 32 | std::min<std::uint64_t>(readers, kReaders) * kWaiting;
}

bool is_finished(const BlockHeader& header) {
  const std::uint64_t state = header.state.load(std::memory_order_acquire);
  return waiting(state) == 0 && reading(state) == 0;
}

bool retire_if_finished(BlockHeader& header) {
  if (!is_finished(header)) return false;
  header.retired = 1;
  return true;
}

std::uint64_t random_token() {
  static std::mt19937_64 engine{std::random_device{}()};
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  return engine();
}

#ifdef __linux__

void wake_all(std::atomic<std::uint32_t>& word) { syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0); }

// Waits until a message is complete. Returns false if its writer has died or was stopped.
bool wait_for(const std::atomic<std::uint32_t>& complete, std::uint32_t number, std::int32_t process) {
  constexpr timespec kPause{0, 50'000'000};  // between two looks at the process
  constexpr int kPauses = 20;                // 1 s; copying 1 GB takes less
  for (int i = 0; i < kPauses; ++i) {
    const std::uint32_t now = complete.load(std::memory_order_acquire);
    if (now == number) return true;
    if (kill(process, 0) != 0 && errno == ESRCH) return false;
    syscall(SYS_futex, &complete, FUTEX_WAIT, now, &kPause, nullptr, 0);
  }
  return complete.load(std::memory_order_acquire) == number;
}

// A block that holds the number of bytes, rounded up so that messages of similar sizes fit as well.
std::unique_ptr<Block> create_block(std::size_t size) {
  constexpr std::size_t kStep = std::size_t{1} << 16;
  const std::size_t block_size = (size + size / 8 + sizeof(BlockHeader) + kStep - 1) / kStep * kStep;
  const int file = memfd_create("coframe", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (file < 0) return nullptr;
  void* memory = MAP_FAILED;
  // Memory is reserved now: writing to it could otherwise end the process.
  if (posix_fallocate(file, 0, static_cast<off_t>(block_size)) == 0 &&
      fcntl(file, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_SEAL) == 0) {
    memory = mmap(nullptr, block_size, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  }
  if (memory == MAP_FAILED) {
    ::close(file);
    return nullptr;
  }
  return std::make_unique<Block>(memory, block_size, file);
}

std::shared_ptr<Block> open_block(std::int32_t process, std::int32_t number) {
  const std::string path = "/proc/" + std::to_string(process) + "/fd/" + std::to_string(number);
  const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return nullptr;
  struct stat status{};
  // Without the seal, the writer could truncate the file, which would end this process.
  const int seals = fcntl(file, F_GET_SEALS);
  void* memory = MAP_FAILED;
  if (seals >= 0 && (seals & F_SEAL_SHRINK) != 0 && fstat(file, &status) == 0 &&
      status.st_size > static_cast<off_t>(sizeof(BlockHeader))) {
    memory = mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  }
  ::close(file);
  if (memory == MAP_FAILED) return nullptr;
  return std::make_shared<Block>(memory, static_cast<std::size_t>(status.st_size), -1);
}

std::string find_namespace() {
  // Only processes that this user may debug can open each other's files.
  if (prctl(PR_GET_DUMPABLE) != 1) return "";
  std::string boot;
  std::ifstream("/proc/sys/kernel/random/boot_id") >> boot;
  struct stat processes{};
  if (boot.size() != 36 || stat("/proc/self/ns/pid", &processes) != 0) return "";
  return boot + "." + std::to_string(processes.st_ino) + "." + std::to_string(geteuid());
}

#else

void wake_all(std::atomic<std::uint32_t>&) {}
bool wait_for(const std::atomic<std::uint32_t>&, std::uint32_t, std::int32_t) { return false; }
std::unique_ptr<Block> create_block(std::size_t) { return nullptr; }
std::shared_ptr<Block> open_block(std::int32_t, std::int32_t) { return nullptr; }
std::string find_namespace() { return ""; }

#endif

}  // namespace

const std::string& block_namespace() {
  static const std::string name = find_namespace();
  return name;
}

Block::~Block() {
#ifdef __linux__
  munmap(memory_, size_);
  if (file_ >= 0) ::close(file_);
#endif
}

Block* BlockPool::take(std::size_t size, std::size_t readers, std::size_t kept_count) {
  if (readers > kReaders) return nullptr;
  const auto fits = [&](const Block& block) {
    return block.capacity() >= size && block.capacity() / 4 <= size + (std::size_t{1} << 16);
  };
  // The newest one with which all readers have finished: it may still be in the cache of the processor.
  for (std::size_t i = blocks_.size(); i-- > 0;) {
    const std::uint64_t state = blocks_[i]->header().state.load(std::memory_order_acquire);
    if (fits(*blocks_[i]) && waiting(state) == 0) {
      if (Block* block = reuse(i, readers)) return block;
    }
  }
  for (std::size_t i = 0; i + kept_count < blocks_.size(); ++i) {
    if (!fits(*blocks_[i])) continue;
    if (Block* block = reuse(i, readers)) return block;
  }
  while (blocks_.size() >= kept_count + kSpare) forget(0);
  if (!has_room(size)) {
    std::erase_if(blocks_, [](const auto& block) { return retire_if_finished(block->header()); });
    if (!has_room(size)) return nullptr;
  }
  return create(size, readers);
}

bool BlockPool::has_room(std::size_t size) const {
  std::size_t bytes = size;
  for (const auto& block : blocks_) bytes += block->capacity();
  return blocks_.size() < kMaxBlocks && bytes <= kMaxBytes;
}

bool BlockPool::finished() const {
  return std::ranges::all_of(blocks_, [](const auto& block) { return is_finished(block->header()); });
}

Block* BlockPool::reuse(std::size_t position, std::size_t readers) {
  auto& state = blocks_[position]->header().state;
  std::uint64_t before = state.load(std::memory_order_acquire);
  do {
    if (reading(before) != 0) return nullptr;
  } while (!state.compare_exchange_weak(before, state_of(number_ + 1, readers), std::memory_order_acq_rel));
  ++number_;
  std::rotate(blocks_.begin() + static_cast<std::ptrdiff_t>(position),
              blocks_.begin() + static_cast<std::ptrdiff_t>(position) + 1, blocks_.end());
  return blocks_.back().get();
}

Block* BlockPool::create(std::size_t size, std::size_t readers) {
  std::unique_ptr<Block> block = create_block(size);
  if (!block) return nullptr;
  BlockHeader& header = *new (&block->header()) BlockHeader{};
  header.token = random_token();
  header.size = block->capacity();
  header.writer = writer_;
  header.state = state_of(++number_, readers);
  header.magic = kMagic;
  blocks_.push_back(std::move(block));
  return blocks_.back().get();
}

BlockReference BlockPool::reference(std::size_t size) const {
  const Block& block = *blocks_.back();
  BlockReference reference{};
  std::memcpy(reference.encapsulation, kReferenceEncapsulation, sizeof reference.encapsulation);
#ifdef __linux__
  reference.process = static_cast<std::int32_t>(getpid());
#endif
  reference.file = block.file();
  reference.number = number_;
  reference.token = block.header().token;
  reference.size = size;
  return reference;
}

void BlockPool::complete() {
  auto& complete = blocks_.back()->header().complete;
  complete.store(number_, std::memory_order_release);
  wake_all(complete);
}

void BlockPool::forget(std::size_t position) {
  blocks_[position]->header().retired = 1;
  blocks_.erase(blocks_.begin() + static_cast<std::ptrdiff_t>(position));
}

void BlockPool::clear() {
  while (!blocks_.empty()) forget(blocks_.size() - 1);
}

BlockMessage::~BlockMessage() {
  if (!block_) return;
  auto& state = block_->header().state;
  std::uint64_t before = state.load(std::memory_order_relaxed);
  std::uint64_t after;
  do {
    after = before - kReading - (waiting(before) > 0 ? kWaiting : 0);
  } while (!state.compare_exchange_weak(before, after, std::memory_order_release));
}

bool BlockMap::is_reference(std::span<const std::uint8_t> bytes) {
  return bytes.size() == sizeof(BlockReference) && std::memcmp(bytes.data(), kReferenceEncapsulation, 4) == 0;
}

std::optional<BlockMessage> BlockMap::find(const Guid& writer, std::span<const std::uint8_t> bytes) {
  BlockReference reference;
  std::memcpy(&reference, bytes.data(), sizeof reference);
  const std::shared_ptr<Block> block = open(writer, reference);
  if (!block || reference.size > block->capacity()) return std::nullopt;
  auto& state = block->header().state;
  std::uint64_t before = state.load(std::memory_order_acquire);
  do {
    if (number_of(before) != reference.number || reading(before) == kReaders) return std::nullopt;
  } while (!state.compare_exchange_weak(before, before + kReading, std::memory_order_acquire));
  BlockMessage message(block, reference.size);
  if (!wait_for(block->header().complete, reference.number, reference.process)) return std::nullopt;
  return message;
}

std::shared_ptr<Block> BlockMap::open(const Guid& writer, const BlockReference& reference) {
  const std::lock_guard lock(mutex_);
  auto& known = blocks_[writer];
  const auto found = std::find_if(known.begin(), known.end(),
                                  [&](const auto& block) { return block->header().token == reference.token; });
  if (found != known.end()) return *found;
  std::shared_ptr<Block> block = open_block(reference.process, reference.file);
  if (!block) {
    failed_ = true;
    return nullptr;
  }
  const BlockHeader& header = block->header();
  if (header.magic != kMagic || header.token != reference.token || header.writer != writer) return nullptr;
  std::erase_if(known, [](const auto& other) { return other->header().retired != 0; });
  if (known.size() >= BlockPool::kMaxBlocks) known.erase(known.begin());
  known.push_back(block);
  return block;
}

void BlockMap::writer_left(const Guid& writer) {
  const std::lock_guard lock(mutex_);
  if (blocks_.contains(writer)) left_.push_back(writer);
}

void BlockMap::queue_is_empty() {
  const std::lock_guard lock(mutex_);
  for (const Guid& writer : left_) blocks_.erase(writer);
  left_.clear();
}

}  // namespace coframe::fastdds
