// SPDX-License-Identifier: Apache-2.0
#include "core/frozen.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "core/bytes.hpp"
#include "core/cdr.hpp"

namespace coframe {

namespace {

constexpr std::array kCounts = {&Frame::Counts::stored,    &Frame::Counts::late, &Frame::Counts::repeated,
                                &Frame::Counts::old,       &Frame::Counts::self, &Frame::Counts::nan,
                                &Frame::Counts::quaternion};

std::uint64_t chunks_for(std::uint64_t samples) { return samples / Chunk::kSize + (samples % Chunk::kSize != 0); }

std::uint64_t chunks_of(const History::View& samples) { return samples.is_static() ? 0 : chunks_for(samples.size()); }

class TableWriter {
 public:
  template <class T>
  void number(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  void text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.append(value);
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

// Names must be valid text, because Python shows them.
bool read_name(ByteReader& reader, std::string_view& name) { return reader.text(name) && is_utf8(name); }

void write_sample(TableWriter& writer, const Sample& sample) {
  for (const double number : sample.pose.q) writer.number(number);
  for (const double number : sample.pose.p) writer.number(number);
  writer.number(sample.parent);
}

bool read_sample(ByteReader& reader, Sample& sample) {
  bool is_complete = true;
  for (double& number : sample.pose.q) is_complete = is_complete && reader.number(number);
  for (double& number : sample.pose.p) is_complete = is_complete && reader.number(number);
  return is_complete && reader.number(sample.parent);
}

// Stored in the table as well, so that opening a file does not read its samples.
void write_span(TableWriter& writer, const History::Span& span) {
  writer.number(span.first);
  writer.number(span.last);
  writer.number(span.parent);
}

bool read_span(ByteReader& reader, History::Span& span) {
  return reader.number(span.first) && reader.number(span.last) && reader.number(span.parent);
}

void write_frame(TableWriter& writer, const Frame& frame) {
  const History::View samples = frame.history.view();
  const HistoryKind kind = !samples.exists()     ? HistoryKind::none
                           : samples.is_static() ? HistoryKind::fixed
                                                 : HistoryKind::dynamic;
  writer.text(frame.name);
  writer.number(frame.authority.get());
  writer.number(static_cast<std::uint8_t>(frame.known));
  writer.number(static_cast<std::uint8_t>(kind));
  writer.number(static_cast<std::uint8_t>(frame.history.one_parent()));
  writer.number(static_cast<std::uint64_t>(samples.size()));
  for (const auto count : kCounts) writer.number((frame.counts.*count).get());
  if (kind == HistoryKind::fixed && !samples.empty()) write_sample(writer, samples.sample(0));
  if (kind == HistoryKind::dynamic) write_span(writer, frame.history.span());
}

// Reads the chunks of a file, one frame after the other.
class ChunkRow {
 public:
  explicit ChunkRow(std::span<const std::uint8_t> bytes)
      : next_(reinterpret_cast<const Chunk*>(bytes.data())), left_(bytes.size() / sizeof(Chunk)) {}

  // Returns the chunks of that many samples; nullptr if there are not as many.
  const Chunk* take(std::uint64_t samples) {
    const std::uint64_t count = chunks_for(samples);
    if (count > left_) return nullptr;
    left_ -= count;
    return std::exchange(next_, next_ + count);
  }
  std::uint64_t left() const { return left_; }

 private:
  const Chunk* next_;
  std::uint64_t left_;
};

bool read_history(ByteReader& reader, std::uint8_t kind, bool one_parent, std::uint64_t samples, ChunkRow& chunks,
                  const HistoryContext& context, History& history) {
  if (kind == static_cast<std::uint8_t>(HistoryKind::none)) return samples == 0;
  if (kind == static_cast<std::uint8_t>(HistoryKind::dynamic)) {
    History::Span span;
    const Chunk* first = chunks.take(samples);
    if (!first || !read_span(reader, span)) return false;
    history.map(context.storage, first, samples, one_parent, span);
    return true;
  }
  Sample sample;
  if (kind != static_cast<std::uint8_t>(HistoryKind::fixed) || samples > 1) return false;
  history.reset(context, HistoryKind::fixed);
  if (samples == 0) return true;
  if (!read_sample(reader, sample)) return false;
  history.insert(context, 0, sample);
  return true;
}

bool read_frame(ByteReader& reader, Tree& tree, const std::vector<AuthorityId>& authorities, ChunkRow& chunks) {
  std::string_view name;
  AuthorityId authority;
  std::uint8_t known, kind, one_parent;
  std::uint64_t samples;
  if (!read_name(reader, name) || !reader.number(authority) || !reader.number(known) || !reader.number(kind) ||
      !reader.number(one_parent) || !reader.number(samples) || name.empty() || authority >= authorities.size()) {
    return false;
  }
  Frame* frame = tree.restore_frame(name);
  if (!frame) return false;
  for (const auto count : kCounts) {
    std::uint64_t number;
    if (!reader.number(number)) return false;
    frame->counts.*count = number;
  }
  frame->authority = authorities[authority];
  frame->known = known != 0;
  return read_history(reader, kind, one_parent != 0, samples, chunks, tree.context(), frame->history);
}

}  // namespace

std::string frozen_table(const Tree& tree) {
  TableWriter writer;
  writer.number(static_cast<std::uint32_t>(tree.authority_count()));
  for (AuthorityId id = 0; id < tree.authority_count(); ++id) writer.text(tree.authority_name(id));
  writer.number(static_cast<std::uint32_t>(tree.frame_count() - 1));
  for (FrameId id = 1; id < tree.frame_count(); ++id) write_frame(writer, tree.frame(id));
  return writer.take();
}

std::uint64_t frozen_chunk_count(const Tree& tree) {
  std::uint64_t count = 0;
  for (FrameId id = 1; id < tree.frame_count(); ++id) count += chunks_of(tree.history(id));
  return count;
}

std::string frozen_chunks(const Tree& tree, std::uint64_t first, std::uint64_t count) {
  const std::uint64_t end = std::min(first + count, frozen_chunk_count(tree));
  std::string bytes((end - std::min(first, end)) * sizeof(Chunk), '\0');
  std::uint64_t number = 0;  // where the first chunk of the next frame begins
  for (FrameId id = 1; id < tree.frame_count(); ++id) {
    const History::View samples = tree.history(id);
    const std::uint64_t start = number;
    number += chunks_of(samples);
    for (std::uint64_t n = std::max(first, start); n < std::min(end, number); ++n) {
      char* chunk = bytes.data() + (n - first) * sizeof(Chunk);
      samples.copy((n - start) * Chunk::kSize, chunk, chunk + offsetof(Chunk, samples));
    }
  }
  return bytes;
}

const char* restore(Tree& tree, std::span<const std::uint8_t> table, std::span<const std::uint8_t> chunks,
                    std::shared_ptr<GuardedMemory> memory) {
  if (reinterpret_cast<std::uintptr_t>(chunks.data()) % alignof(Chunk) != 0) return "its samples are not aligned";
  if (chunks.size() % sizeof(Chunk) != 0) return "its samples are truncated";
  tree.keep(std::move(memory));
  ByteReader reader(table);
  ChunkRow row(chunks);
  std::uint32_t authority_count, frame_count;
  if (!reader.number(authority_count)) return "its table is truncated";
  std::vector<AuthorityId> authorities;
  for (std::uint32_t i = 0; i < authority_count; ++i) {
    std::string_view name;
    if (!read_name(reader, name)) return "its table is damaged: a name is invalid";
    authorities.push_back(i == 0 ? 0 : tree.authority(name));
  }
  if (!reader.number(frame_count)) return "its table is truncated";
  for (std::uint32_t i = 0; i < frame_count; ++i) {
    if (!read_frame(reader, tree, authorities, row)) return "its table is damaged: the data of a frame is invalid";
  }
  if (reader.left() != 0 || row.left() != 0) return "its table is damaged: it does not describe all bytes of the file";
  return nullptr;
}

}  // namespace coframe
