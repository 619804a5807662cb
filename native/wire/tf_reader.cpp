#include "wire/tf_reader.hpp"

#include <utility>

namespace coframe {
namespace {

// Publishers come and go; when this many have been seen, all are learnt anew.
constexpr std::size_t kMaxSources = 1024;

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
  Source& source = sources_[writer];
  source.stream = buffer_->open_stream(is_static_, authority);
  source.named = true;
  const std::vector<std::uint8_t> message = std::exchange(source.last_static, {});
  std::size_t stored = 0;
  if (!message.empty()) buffer_->ingest(source.stream, message.data(), message.size(), stored);
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

void TfReader::store(const dds::Sample& sample) {
  const dds::Handle writer = sample.info().publication_handle;
  auto found = sources_.find(writer);
  if (found == sources_.end()) {
    if (sources_.size() >= kMaxSources) sources_.clear();
    found = sources_.emplace(writer, Source{buffer_->open_stream(is_static_, authority_), false, {}}).first;
  }
  Source& source = found->second;
  const auto bytes = sample.bytes();
  std::size_t stored = 0;
  // What is malformed the buffer counts.
  buffer_->ingest(source.stream, bytes.data(), bytes.size(), stored);
  if (is_static_ && !source.named) source.last_static.assign(bytes.begin(), bytes.end());
}

}  // namespace coframe
