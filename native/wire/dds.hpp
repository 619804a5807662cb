// SPDX-License-Identifier: Apache-2.0
// The functions of Cyclone DDS that the wire uses, loaded at run time from the library that coframe.wire.dds.library
// finds. There need not be headers, so the few structures that are passed to it are declared here. They are the same in
// Cyclone DDS 0.10 and 11; `load` checks what can be checked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace coframe::dds {

using Entity = std::int32_t;
using Handle = std::uint64_t;  // handle of an instance: the writer of a sample, an announced endpoint
using Code = std::int32_t;     // 0 or a negative error

struct Guid {
  std::uint8_t bytes[16];
};

struct SampleInfo {
  std::int32_t sample_state;
  std::int32_t view_state;
  std::int32_t instance_state;
  bool valid_data;  // false: an instance or a writer has ended, and there is no payload
  std::int64_t source_timestamp;
  Handle instance_handle;
  Handle publication_handle;
  std::uint32_t disposed_generation_count;
  std::uint32_t no_writers_generation_count;
  std::uint32_t sample_rank;
  std::uint32_t generation_rank;
  std::uint32_t absolute_generation_rank;
};

struct Serdata;  // a reference-counted serialized sample
struct Sertype;  // the type of a topic's samples
struct Qos;
struct Listener;

// dds_builtintopic_endpoint_t
struct BuiltinEndpoint {
  Guid key;
  Guid participant_key;
  Handle participant_handle;
  const char* topic_name;
  const char* type_name;
  const Qos* qos;
};

// dds_builtintopic_participant_t
struct BuiltinParticipant {
  Guid key;
  const Qos* qos;
};

struct MatchedStatus {
  std::uint32_t total_count;
  std::int32_t total_count_change;
  std::uint32_t current_count;
  std::int32_t current_count_change;
  Handle last_handle;
};

struct IncompatibleQosStatus {
  std::uint32_t total_count;
  std::int32_t total_count_change;
  std::uint32_t last_policy_id;
};

struct DeadlineMissedStatus {
  std::uint32_t total_count;
  std::int32_t total_count_change;
  Handle last_handle;
};

struct LivelinessChangedStatus {
  std::uint32_t alive_count;
  std::uint32_t not_alive_count;
  std::int32_t alive_count_change;
  std::int32_t not_alive_count_change;
  Handle last_handle;
};

// dds_liveliness_lost_status_t and dds_sample_lost_status_t
struct LostStatus {
  std::uint32_t total_count;
  std::int32_t total_count_change;
};

// ddsrt_iovec_t
struct IoVector {
#ifdef _WIN32
  unsigned long size;
  void* data;
#else
  void* data;
  std::size_t size;
#endif
};

// dds_topic_descriptor_t: a type as generated code describes it.
struct TypeDescriptor {
  struct Blob {
    const unsigned char* data;
    std::uint32_t size;
  };
  std::uint32_t size, alignment, flags;
  std::uint32_t key_count;
  const char* name;
  const void* keys;
  std::uint32_t instruction_count;
  const std::uint32_t* instructions;  // for the serializer
  const char* meta;
  Blob type_information, type_mapping;
  std::uint32_t representations;
};

using DataCallback = void (*)(Entity reader, void* argument);
template <class Status>
using StatusCallback = void (*)(Entity, Status, void* argument);

inline constexpr Entity kParticipantTopic = 0x7fff0001;   // DDS_BUILTIN_TOPIC_DCPSPARTICIPANT
inline constexpr Entity kPublicationTopic = 0x7fff0003;   // DDS_BUILTIN_TOPIC_DCPSPUBLICATION
inline constexpr Entity kSubscriptionTopic = 0x7fff0004;  // DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION

enum Durability : std::int32_t { kVolatile = 0, kTransientLocal = 1 };
enum History : std::int32_t { kKeepLast = 0, kKeepAll = 1 };
enum Reliability : std::int32_t { kBestEffort = 0, kReliable = 1 };
enum Liveliness : std::int32_t { kAutomatic = 0, kManualByTopic = 2 };
enum IgnoreLocal : std::int32_t { kIgnoreNothing = 0, kIgnoreParticipant = 1 };
inline constexpr std::int32_t kAliveInstance = 16;
inline constexpr std::int32_t kUnlimited = -1;
inline constexpr std::int16_t kXcdr1 = 0;
inline constexpr std::int32_t kData = 2;  // SDK_DATA: a complete sample, not only its key
inline constexpr Code kBadParameter = -3;
inline constexpr Code kTimeout = -10;
inline constexpr Code kPreconditionNotMet = -4;

// X(return type, name, arguments) for every function that is used.
#define COFRAME_DDS_FUNCTIONS(X)                                                                                     \
  X(Entity, dds_create_domain, (std::uint32_t id, const char* config))                                               \
  X(Entity, dds_create_participant, (std::uint32_t domain, const Qos*, const Listener*))                             \
  X(Entity, dds_create_topic,                                                                                        \
    (Entity participant, const TypeDescriptor*, const char* name, const Qos*, const Listener*))                      \
  X(Entity, dds_create_writer, (Entity participant, Entity topic, const Qos*, const Listener*))                      \
  X(Entity, dds_create_reader, (Entity participant, Entity topic, const Qos*, const Listener*))                      \
  X(Code, dds_delete, (Entity))                                                                                      \
  X(Code, dds_writecdr, (Entity writer, Serdata*))                                                                   \
  X(Code, dds_take, (Entity reader, void** samples, SampleInfo*, std::size_t size, std::uint32_t limit))             \
  X(Code, dds_return_loan, (Entity reader, void** samples, std::int32_t count))                                      \
  X(Code, dds_takecdr, (Entity reader, Serdata**, std::uint32_t limit, SampleInfo*, std::uint32_t mask))             \
  X(Code, dds_get_guid, (Entity, Guid*))                                                                             \
  X(Code, dds_get_publication_matched_status, (Entity writer, MatchedStatus*))                                       \
  X(Code, dds_get_subscription_matched_status, (Entity reader, MatchedStatus*))                                      \
  X(Code, dds_get_matched_subscriptions, (Entity writer, Handle*, std::size_t size))                                 \
  X(Code, dds_get_matched_publications, (Entity reader, Handle*, std::size_t size))                                  \
  X(Code, dds_get_offered_incompatible_qos_status, (Entity writer, IncompatibleQosStatus*))                          \
  X(Code, dds_get_requested_incompatible_qos_status, (Entity reader, IncompatibleQosStatus*))                        \
  X(Listener*, dds_create_listener, (void* argument))                                                                \
  X(void, dds_delete_listener, (Listener*))                                                                          \
  X(void, dds_lset_data_available, (Listener*, DataCallback))                                                        \
  X(Code, dds_set_listener, (Entity, const Listener*))                                                               \
  X(Code, dds_set_qos, (Entity, const Qos*))                                                                         \
  X(Code, dds_lset_offered_deadline_missed_arg,                                                                      \
    (Listener*, StatusCallback<DeadlineMissedStatus>, void* argument, bool reset))                                   \
  X(Code, dds_lset_requested_deadline_missed_arg,                                                                    \
    (Listener*, StatusCallback<DeadlineMissedStatus>, void* argument, bool reset))                                   \
  X(Code, dds_lset_offered_incompatible_qos_arg,                                                                     \
    (Listener*, StatusCallback<IncompatibleQosStatus>, void* argument, bool reset))                                  \
  X(Code, dds_lset_requested_incompatible_qos_arg,                                                                   \
    (Listener*, StatusCallback<IncompatibleQosStatus>, void* argument, bool reset))                                  \
  X(Code, dds_lset_liveliness_lost_arg, (Listener*, StatusCallback<LostStatus>, void* argument, bool reset))         \
  X(Code, dds_lset_liveliness_changed_arg,                                                                           \
    (Listener*, StatusCallback<LivelinessChangedStatus>, void* argument, bool reset))                                \
  X(Code, dds_lset_sample_lost_arg, (Listener*, StatusCallback<LostStatus>, void* argument, bool reset))             \
  X(Code, dds_lset_publication_matched_arg, (Listener*, StatusCallback<MatchedStatus>, void* argument, bool reset))  \
  X(Code, dds_lset_subscription_matched_arg, (Listener*, StatusCallback<MatchedStatus>, void* argument, bool reset)) \
  X(Code, dds_assert_liveliness, (Entity writer))                                                                    \
  X(Code, dds_wait_for_acks, (Entity writer, std::int64_t timeout_ns))                                               \
  X(void, dds_qset_deadline, (Qos*, std::int64_t nanoseconds))                                                       \
  X(void, dds_qset_lifespan, (Qos*, std::int64_t nanoseconds))                                                       \
  X(void, dds_qset_liveliness, (Qos*, std::int32_t kind, std::int64_t lease_ns))                                     \
  X(bool, dds_qget_deadline, (const Qos*, std::int64_t* nanoseconds))                                                \
  X(bool, dds_qget_lifespan, (const Qos*, std::int64_t* nanoseconds))                                                \
  X(bool, dds_qget_liveliness, (const Qos*, std::int32_t* kind, std::int64_t* lease_ns))                             \
  X(Qos*, dds_create_qos, ())                                                                                        \
  X(void, dds_delete_qos, (Qos*))                                                                                    \
  X(void, dds_qset_userdata, (Qos*, const void* data, std::size_t size))                                             \
  X(void, dds_qset_durability, (Qos*, std::int32_t kind))                                                            \
  X(void, dds_qset_history, (Qos*, std::int32_t kind, std::int32_t depth))                                           \
  X(void, dds_qset_reliability, (Qos*, std::int32_t kind, std::int64_t max_blocking_ns))                             \
  X(void, dds_qset_ignorelocal, (Qos*, std::int32_t kind))                                                           \
  X(void, dds_qset_partition, (Qos*, std::uint32_t count, const char** names))                                       \
  X(bool, dds_qget_partition, (const Qos*, std::uint32_t* count, char*** names))                                     \
  X(void, dds_qset_data_representation, (Qos*, std::uint32_t count, const std::int16_t* values))                     \
  X(void, dds_qset_durability_service,                                                                               \
    (Qos*, std::int64_t cleanup_delay_ns, std::int32_t history_kind, std::int32_t history_depth,                     \
     std::int32_t max_samples, std::int32_t max_instances, std::int32_t max_samples_per_instance))                   \
  X(bool, dds_qget_userdata, (const Qos*, void** data, std::size_t* size))                                           \
  X(void, dds_free, (void*))                                                                                         \
  X(bool, dds_qget_durability, (const Qos*, std::int32_t* kind))                                                     \
  X(bool, dds_qget_history, (const Qos*, std::int32_t* kind, std::int32_t* depth))                                   \
  X(bool, dds_qget_reliability, (const Qos*, std::int32_t* kind, std::int64_t* max_blocking_ns))                     \
  X(const char*, dds_strretcode, (Code))                                                                             \
  X(Serdata*, ddsi_serdata_from_ser_iov,                                                                             \
    (const Sertype*, std::int32_t kind, std::size_t count, const IoVector*, std::size_t size))                       \
  X(std::uint32_t, ddsi_serdata_size, (const Serdata*))                                                              \
  X(Serdata*, ddsi_serdata_to_ser_ref, (const Serdata*, std::size_t offset, std::size_t size, IoVector*))            \
  X(void, ddsi_serdata_to_ser_unref, (Serdata*, const IoVector*))                                                    \
  X(void, ddsi_serdata_unref, (Serdata*))

struct Functions {
#define COFRAME_DECLARE(result, name, arguments) result(*name) arguments = nullptr;
  COFRAME_DDS_FUNCTIONS(COFRAME_DECLARE)
#undef COFRAME_DECLARE
  Code (*dds_get_entity_sertype)(Entity, const Sertype**) = nullptr;  // null in Cyclone DDS 0.10
  const void* ddsi_sertype_v0 = nullptr;                              // a tag; its address is compared
};

// A DDS call that failed.
class Error : public std::runtime_error {
 public:
  Error(const std::string& what, Code code);
  Code code() const { return code_; }

 private:
  Code code_;
};

// Loads the library at `path` (UTF-8), finds every function, checks how it passes arguments, and returns the release
// whose binary interface it has: "0.10" or "11". Throws std::runtime_error with what is wrong, as a clause about the
// library ("has no function ..."). A second call returns the same release and does not look at `path`. The library
// stays loaded, because its threads may outlive all objects of this module.
std::string load(const std::string& path);

// Returns the functions. Throws std::logic_error before load() and if forked().
const Functions& functions();

// Returns true in a child process that was forked while its parent used DDS: the DDS threads do not exist there, and
// locks may be held.
bool forked() noexcept;
// Adds `change` to the number of participants: 1 when one is opened, -1 when one is closed.
void count_participants(int change) noexcept;

// Returns `code`, or throws Error "could not <what>: <DDS's text>" if it is negative.
Code check(Code code, const char* what);

// Creates a topic whose readers receive all bytes that arrive under the type's name and check them themselves. With the
// real type, Cyclone DDS drops invalid messages with a line on stderr each, which cannot be counted, and its check of
// sent messages takes three times as long as the rest of sending.
Entity create_unchecked_topic(Entity participant, const std::string& name, const std::string& type);

inline IoVector io_vector(const void* data, std::size_t size) {
  IoVector vector{};
  vector.data = const_cast<void*>(data);
  vector.size = static_cast<decltype(vector.size)>(size);
  return vector;
}

// Returns the type of an entity's samples; null with Cyclone DDS 0.10. It lives as long as the entity.
const Sertype* type_of(Entity entity);

// Sends serialized bytes: 4 bytes of encapsulation, all in the first part, then CDR. `size` is that of all parts. They
// are copied. `type` is that of the writer.
Code write(Entity writer, const Sertype* type, std::span<const IoVector> parts, std::size_t size);

// Deletes a topic once its reader or writer was created, which keeps what it needs of it. Built-in topics stay.
void release_topic(Entity topic);

// Returns all handles of `entity` from `get`, one of the functions dds_get_matched_*.
std::vector<Handle> matched_handles(Code (*get)(Entity, Handle*, std::size_t), Entity entity);

// One taken sample; it is returned to DDS at the end of its scope.
class Sample {
 public:
  Sample(Serdata* data, const SampleInfo& info) noexcept;
  Sample(Sample&& other) noexcept;
  Sample(const Sample&) = delete;
  Sample& operator=(Sample&&) = delete;
  Sample& operator=(const Sample&) = delete;
  ~Sample();

  // The whole payload: the 4 bytes of encapsulation, then CDR.
  std::span<const std::uint8_t> bytes() const noexcept;
  const SampleInfo& info() const noexcept { return info_; }

 private:
  Serdata* data_;  // owned
  Serdata* view_;  // the reference that keeps `bytes_` mapped
  IoVector bytes_{};
  SampleInfo info_;
};

// Takes up to `limit` (at most kBatch) samples from `reader` and calls `use(Sample&&)` for those with data. Returns how
// many were taken, with or without data.
inline constexpr std::uint32_t kBatch = 64;

template <class Use>
std::uint32_t take(Entity reader, std::uint32_t limit, Use&& use) {
  Serdata* data[kBatch];
  SampleInfo info[kBatch];
  const Code count = functions().dds_takecdr(reader, data, limit < kBatch ? limit : kBatch, info, 0);
  if (count <= 0) return 0;
  for (Code i = 0; i < count; ++i) {
    if (info[i].valid_data) {
      use(Sample(data[i], info[i]));
    } else {
      functions().ddsi_serdata_unref(data[i]);
    }
  }
  return static_cast<std::uint32_t>(count);
}

}  // namespace coframe::dds
