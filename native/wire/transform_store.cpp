// SPDX-License-Identifier: Apache-2.0
#include "wire/transform_store.hpp"

#include <chrono>
#include <utility>

namespace coframe {
namespace {

// The maximum number of publishers in memory, because not every wire reports the end of every publisher.
constexpr std::size_t kMaxSources = 1024;

template <class Clock>
std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

}  // namespace

TransformStore::TransformStore(std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
                               std::shared_ptr<const Renaming> renaming, std::shared_ptr<Event> event)
    : buffer_(std::move(buffer)),
      is_static_(is_static),
      authority_(authority),
      renaming_(std::move(renaming)),
      event_(std::move(event)) {
  if (is_static_ && buffer_->shares()) published_.emplace(buffer_);
}

void TransformStore::name_writer(Writer writer, const std::string& authority) {
  const ForkSafeLock lock(mutex_);
  Source& source = source_of(writer);
  buffer_->rename(source.stream, authority);
  source.has_name = true;
}

void TransformStore::forget_writer(Writer writer) {
  const ForkSafeLock lock(mutex_);
  sources_.erase(writer);
}

void TransformStore::writer_left(Writer writer) {
  const ForkSafeLock lock(mutex_);
  if (published_) published_->leave(writer);
}

void TransformStore::settle_statics() {
  const ForkSafeLock lock(mutex_);
  if (published_) published_->settle();
}

std::vector<TransformStore::WriterStatistics> TransformStore::writers() const {
  const ForkSafeLock lock(mutex_);
  std::vector<WriterStatistics> statistics;
  for (const auto& [writer, source] : sources_) {
    statistics.push_back(
        {writer, source.messages, source.received_at, source.period, source.delay, source.stream.name_problems});
  }
  return statistics;
}

TransformStore::Source& TransformStore::source_of(Writer writer) {
  const auto found = sources_.find(writer);
  if (found != sources_.end()) return found->second;
  if (sources_.size() >= kMaxSources) std::erase_if(sources_, [](const auto& entry) { return !entry.second.has_name; });
  return sources_
      .emplace(writer,
               Source{.stream = buffer_->open_stream(is_static_, authority_, renaming_), .period = {}, .delay = {}})
      .first->second;
}

TransformStore::Ingest::~Ingest() {
  if (store_.is_armed_.exchange(false) && store_.event_) store_.event_->set();
}

void TransformStore::Ingest::add(Writer writer, std::span<const std::uint8_t> message) {
  std::size_t stored = 0;
  Source& source = store_.source_of(writer);
  const DecodeFailure failure =
      store_.buffer_->ingest_without_notify(source.stream, message.data(), message.size(), stored);
  if (store_.published_ && !failure.reason) store_.published_->receive(writer, source.stream.inserted);
  source.received_at = now<std::chrono::steady_clock>();
  source.period.add(source.received_at);
  if (stored > 0) store_.stored_at_.store(source.received_at, std::memory_order_release);
  store_.buffer_->notify_ingested(source.stream);
  ++source.messages;
  ++store_.received_;
  if (!store_.is_static_ && source.stream.newest != 0) {
    source.delay.add(now<std::chrono::system_clock>() - source.stream.newest);
  }
}

}  // namespace coframe
