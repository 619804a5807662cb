// SPDX-License-Identifier: Apache-2.0
#include "wire/writer.hpp"

#include <memory>
#include <stdexcept>
#include <utility>

#include "core/cdr.hpp"

namespace coframe {
namespace {

void check_encapsulation(std::size_t size) {
  if (size < 4)
    throw std::invalid_argument("The message is too short: a serialized message begins with 4 bytes of encapsulation.");
}

bool is_damaged_tf_message(const dds::IoVector& bytes) {
  return check_tf_message(static_cast<const std::uint8_t*>(bytes.data), bytes.size).reason != nullptr;
}

}  // namespace

Writer::Writer(dds::Entity participant, dds::Entity topic, const QosProfile& profile, const std::string& user_data,
               bool checks_transforms, std::shared_ptr<Event> on_change)
    : checks_transforms_(checks_transforms), events_(on_change) {
  const dds::Functions& f = dds::functions();
  const QosPointer qos = make_qos(profile, user_data);
  const std::unique_ptr<dds::Listener, void (*)(dds::Listener*)> listener(f.dds_create_listener(nullptr),
                                                                          f.dds_delete_listener);
  if (on_change) events_.add_to_writer(listener.get());
  entity_ = dds::check(f.dds_create_writer(participant, topic, qos.get(), listener.get()), "create a writer");
  dds::release_topic(topic);
  try {
    type_ = dds::type_of(entity_);
  } catch (...) {
    close();
    throw;
  }
}

void Writer::write(const void* data, std::size_t size) const {
  const dds::IoVector vector = dds::io_vector(data, size);
  write({&vector, 1}, size);
}

void Writer::write(std::span<const dds::IoVector> parts, std::size_t size) const {
  check_encapsulation(size);
  // A TFMessage has no large arrays, so it is in one part.
  const bool is_damaged = checks_transforms_ && (parts.size() != 1 || is_damaged_tf_message(parts[0]));
  dds::check(is_damaged ? dds::kBadParameter : pass_on(parts, size), "write");
}

void Writer::forward(const void* data, std::size_t size) const {
  check_encapsulation(size);
  const dds::IoVector vector = dds::io_vector(data, size);
  dds::check(pass_on({&vector, 1}, size), "write");
}

dds::Code Writer::pass_on(std::span<const dds::IoVector> parts, std::size_t size) const {
  dds::functions();  // throws in a forked child, where another thread may have held the lock
  const std::lock_guard lock(closing_);
  const dds::Entity entity = entity_;
  return entity > 0 ? dds::write(entity, type_, parts, size) : dds::kBadParameter;
}

void Writer::close() noexcept {
  if (dds::forked()) return;
  const std::lock_guard lock(closing_);
  const dds::Entity entity = entity_.exchange(0);
  if (entity > 0) dds::functions().dds_delete(entity);
}

dds::Guid Writer::guid() const {
  dds::Guid guid{};
  dds::check(dds::functions().dds_get_guid(entity_, &guid), "read the writer's GUID");
  return guid;
}

std::uint32_t Writer::matched() const {
  dds::MatchedStatus status{};
  dds::check(dds::functions().dds_get_publication_matched_status(entity_, &status), "count the readers");
  return status.current_count;
}

std::vector<dds::Handle> Writer::matched_handles() const {
  return dds::matched_handles(dds::functions().dds_get_matched_subscriptions, entity_);
}

dds::IncompatibleQosStatus Writer::incompatible() const {
  dds::IncompatibleQosStatus status{};
  dds::check(dds::functions().dds_get_offered_incompatible_qos_status(entity_, &status), "read the QoS status");
  return status;
}

void Writer::assert_liveliness() const {
  dds::check(dds::functions().dds_assert_liveliness(entity_), "assert the liveliness");
}

bool Writer::wait_for_acks(std::int64_t timeout_ns) const {
  const dds::Code code = dds::functions().dds_wait_for_acks(entity_, timeout_ns);
  return code != dds::kTimeout && dds::check(code, "wait for the readers") >= 0;
}

}  // namespace coframe
