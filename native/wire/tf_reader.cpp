#include "wire/tf_reader.hpp"

#include <chrono>
#include <unordered_map>
#include <utility>

namespace coframe {
namespace {

// Publishers come and go, and of those without a name nobody says that they have left: so many are remembered.
constexpr std::size_t kMaxSources = 1024;

std::int64_t now() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count();
}

}  // namespace

TfReader::TfReader(dds::Entity participant, dds::Entity topic, const QosProfile& profile,
                   const std::string& user_data, std::shared_ptr<Buffer> buffer, bool is_static,
                   const std::string& authority)
    : buffer_(std::move(buffer)),
      is_static_(is_static),
      authority_(authority),
      reader_(participant, topic, make_qos(profile, user_data).get(), &TfReader::on_data, this) {
  on_data(reader_.entity(), this);  // what came before the listener
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

// An exception must not reach DDS, which is C: out of memory, a message is lost.
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
}

TfReader::Source& TfReader::source_of(dds::Handle writer) {
  const auto found = sources_.find(writer);
  if (found != sources_.end()) return found->second;
  if (sources_.size() >= kMaxSources) std::erase_if(sources_, [](const auto& entry) { return !entry.second.named; });
  return sources_.emplace(writer, Source{buffer_->open_stream(is_static_, authority_), false}).first->second;
}

void TfReader::store(const dds::Sample& sample) {
  const auto bytes = sample.bytes();
  TransformStream& stream = source_of(sample.info().publication_handle).stream;
  std::size_t stored = 0;
  // What is malformed the buffer counts.
  buffer_->take_in(stream, bytes.data(), bytes.size(), stored);
  if (stored > 0) stored_at_.store(now(), std::memory_order_release);
  buffer_->tell_of_last(stream);
}

}  // namespace coframe
