// SPDX-License-Identifier: Apache-2.0
#include "wire/tf_reader.hpp"

#include <chrono>
#include <unordered_map>
#include <utility>

namespace coframe {
namespace {

// The maximum number of publishers in memory, because DDS does not report the end of every publisher.
constexpr std::size_t kMaxSources = 1024;

template <class Clock>
std::int64_t now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(Clock::now().time_since_epoch()).count();
}

}  // namespace

TfReader::TfReader(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
                   std::shared_ptr<Buffer> buffer, bool is_static, const std::string& authority,
                   std::shared_ptr<const Renaming> renaming, std::shared_ptr<Event> on_data_event)
    : buffer_(std::move(buffer)),
      is_static_(is_static),
      authority_(authority),
      renaming_(std::move(renaming)),
      event_(std::move(on_data_event)),
      reader_(participant, topic, make_qos(profile, user_data).get(), &TfReader::on_data, this, event_) {
  on_data(reader_.entity(), this);  // samples that arrived before the listener was attached
}

void TfReader::name_writer(dds::Handle writer, const std::string& authority) {
  const std::lock_guard lock(mutex_);
  Source& source = source_of(writer);
  buffer_->rename(source.stream, authority);
  source.named = true;
}

void TfReader::forget_writer(dds::Handle writer) {
  const std::lock_guard lock(mutex_);
  sources_.erase(writer);
}

std::vector<TfReader::WriterStatistics> TfReader::writers() const {
  const std::lock_guard lock(mutex_);
  std::vector<WriterStatistics> all;
  for (const auto& [writer, source] : sources_) {
    all.push_back(
        {writer, source.messages, source.received_at, source.period, source.delay, source.stream.name_problems});
  }
  return all;
}

// DDS is written in C, so no exception may reach it. If memory runs out, a message is lost.
void TfReader::on_data(dds::Entity reader, void* self) noexcept {
  try {
    static_cast<TfReader*>(self)->drain(reader);
  } catch (...) {
  }
}

void TfReader::drain(dds::Entity reader) {
  const std::lock_guard lock(mutex_);
  while (dds::take(reader, dds::kBatch, [this](const dds::Sample& sample) { store(sample); }) == dds::kBatch) {
  }
  if (armed_.exchange(false) && event_) event_->set();
}

TfReader::Source& TfReader::source_of(dds::Handle writer) {
  const auto found = sources_.find(writer);
  if (found != sources_.end()) return found->second;
  if (sources_.size() >= kMaxSources) std::erase_if(sources_, [](const auto& entry) { return !entry.second.named; });
  return sources_
      .emplace(writer,
               Source{.stream = buffer_->open_stream(is_static_, authority_, renaming_), .period = {}, .delay = {}})
      .first->second;
}

void TfReader::store(const dds::Sample& sample) {
  const auto bytes = sample.bytes();
  std::size_t stored = 0;
  Source& source = source_of(sample.info().publication_handle);
  // The buffer counts malformed messages.
  buffer_->ingest_without_notify(source.stream, bytes.data(), bytes.size(), stored);
  source.received_at = now<std::chrono::steady_clock>();
  source.period.add(source.received_at);
  if (stored > 0) stored_at_.store(source.received_at, std::memory_order_release);
  buffer_->notify_ingested(source.stream);
  ++source.messages;
  ++received_;
  if (!is_static_ && source.stream.newest != 0) {
    source.delay.add(now<std::chrono::system_clock>() - source.stream.newest);
  }
}

}  // namespace coframe
