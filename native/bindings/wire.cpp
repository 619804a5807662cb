// SPDX-License-Identifier: Apache-2.0
// DDS without the GIL: the base of coframe.wire.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <memory>
#include <optional>
#include <vector>

#include "bindings/arguments.hpp"
#include "bindings/bindings.hpp"
#include "bindings/buffer.hpp"
#include "bindings/direct_writer.hpp"
#include "bindings/message_codec.hpp"
#include "bindings/relay.hpp"
#include "coframe/endpoint_values.hpp"
#include "core/cdr.hpp"
#include "wire/endpoint_reader.hpp"
#include "wire/participant.hpp"
#include "wire/reader.hpp"
#include "wire/tap.hpp"
#include "wire/tf_reader.hpp"
#include "wire/transform_store.hpp"
#include "wire/writer.hpp"

namespace coframe::bindings {
namespace {

using ReleaseGil = nb::call_guard<WithoutGil>;

// Closing waits for DDS threads, and DDS frees Python types meanwhile: the GIL must not be held.
template <class Native>
class Closing : public Native {
 public:
  using Native::Native;
  ~Closing() {
    WithoutGil release;
    Native::close();
  }
};

using PyParticipant = Closing<DomainParticipant>;
using PyWriter = Closing<Writer>;
using PyReader = Closing<Reader>;
using PyEndpointReader = Closing<EndpointReader>;
using PyTap = Closing<Tap>;
using PyTfReader = Closing<TfReader>;

// Reads a GUID without the GIL: DDS locks the entity, whose lock a DDS thread may hold.
template <class Endpoint>
dds::Guid guid_of(const Endpoint& endpoint) {
  WithoutGil release;
  return endpoint.guid();
}

nb::bytes to_bytes(const dds::Guid& guid) { return nb::bytes(guid.bytes, sizeof guid.bytes); }

template <class Endpoint>
nb::list matched_handles(const Endpoint& endpoint) {
  std::vector<dds::Handle> handles;
  {
    // DDS locks the endpoint, whose lock a DDS thread may hold.
    WithoutGil release;
    handles = endpoint.matched_handles();
  }
  nb::list list;
  for (const dds::Handle handle : handles) list.append(handle);
  return list;
}

// Calls `write`, a method of Writer, without the GIL.
template <void (Writer::*write)(const void*, std::size_t) const>
void write_bytes(const PyWriter& writer, nb::bytes message) {
  const char* data = message.c_str();
  const std::size_t size = message.size();
  WithoutGil release;
  (writer.*write)(data, size);
}

nb::bytes to_bytes(const dds::Sample& sample) {
  const auto bytes = sample.bytes();
  return values::message_bytes<WithoutGil>(bytes.data(), bytes.size());
}

// With a codec, messages that it can read are returned as messages, others as bytes.
nb::list take_messages(PyReader& reader, std::uint32_t limit, const MessageCodec* codec) {
  std::vector<dds::Sample> samples;
  {
    WithoutGil release;
    samples = reader.take(limit);
  }
  nb::list messages;
  for (const dds::Sample& sample : samples) {
    nb::object message = codec == nullptr ? nb::none() : codec->decode(sample.bytes());
    if (message.is_none()) message = to_bytes(sample);
    messages.append(nb::make_tuple(message, sample.info().source_timestamp, sample.info().publication_handle));
  }
  return messages;
}

nb::tuple take_tapped(PyTap& tap) {
  Tap::Messages messages;
  {
    WithoutGil release;
    messages = tap.take();
  }
  return nb::make_tuple(nb::bytes(messages.bytes.data(), messages.bytes.size()), array_bytes(messages.ends),
                        array_bytes(messages.arrived), array_bytes(messages.sent), array_bytes(messages.writers));
}

nb::list writers_of(const TransformStore& store) {
  std::vector<TransformStore::WriterStatistics> statistics;
  {
    WithoutGil release;
    statistics = store.writers();
  }
  nb::list list;
  for (const auto& [writer, messages, received_at, period, delay, name_problems] : statistics) {
    list.append(writer_tuple(writer, messages, received_at, period, delay, name_problems));
  }
  return list;
}

void define_participant(nb::module_& wire) {
  nb::class_<PyParticipant>(wire, "DomainParticipant", "A DDS domain of this process and a participant in it.")
      .def(nb::init<std::uint32_t, const std::string&, const std::string&>(), nb::arg("domain"), nb::arg("config"),
           nb::arg("user_data"), ReleaseGil())
      .def_prop_ro("entity", &PyParticipant::entity, "DDS's number for the participant; 0 after close.")
      .def_prop_ro("guid", [](const PyParticipant& self) { return to_bytes(guid_of(self)); })
      .def("set_user_data", &PyParticipant::set_user_data, nb::arg("user_data"), ReleaseGil(),
           "Replace the user data. If they differ, DDS announces the participant immediately.")
      .def("close", &PyParticipant::close, ReleaseGil(), "End the participant and DDS's threads.");
}

void define_writer(nb::module_& wire) {
  nb::class_<PyWriter>(wire, "Writer", "A DDS writer of serialized messages.")
      .def(nb::init<dds::Entity, dds::Entity, const QosProfile&, const std::string&, bool, std::shared_ptr<Event>>(),
           nb::arg("participant"), nb::arg("topic"), nb::arg("qos"), nb::arg("user_data"),
           nb::arg("checks_transforms") = false, nb::arg("on_change") = nb::none(), ReleaseGil())
      .def("write", &write_bytes<&Writer::write>, nb::arg("message"), "Send one serialized message without the GIL.")
      .def(
          "publish",
          [](const PyWriter& self, const MessageCodec& codec, nb::handle message) {
            return publish_message(self, codec, message);
          },
          nb::arg("codec"), nb::arg("message"),
          "Serialize and send a message; return False if Python code has to serialize it.")
      .def(
          "direct",
          [](nb::handle self, std::shared_ptr<const MessageCodec> codec, std::shared_ptr<Event> closed,
             nb::object failure, bool of_items) {
            return direct_function(self, nb::cast<const PyWriter&>(self), std::move(codec), std::move(closed),
                                   std::move(failure), of_items);
          },
          nb::arg("codec"), nb::arg("closed"), nb::arg("failure"), nb::arg("of_items"),
          "Return a function that serializes and sends a message, and returns whether it did; False leaves it to "
          "Python "
          "code, as always once `closed` is set or the writer is closed. `failure` returns the exception for an error "
          "text. With `of_items`, the function takes the items of the message's only field, or a single item.")
      .def("forward", &write_bytes<&Writer::forward>, nb::arg("message"), "Send a message without checking its bytes.")
      .def("assert_liveliness", &PyWriter::assert_liveliness, ReleaseGil(),
           "Show the readers that the writer is alive.")
      .def("wait_for_acks", &PyWriter::wait_for_acks, nb::arg("timeout_ns"), ReleaseGil(),
           "Wait until all reliable readers have received all messages; False after the timeout.")
      .def(
          "take_status", [](PyWriter& self, std::size_t kind) { return values::take_status(self.events(), kind); },
          nb::arg("kind"),
          "Return the counts of the status DEADLINE_MISSED, ... if it has changed since the last call.")
      .def_prop_ro("guid", [](const PyWriter& self) { return to_bytes(guid_of(self)); })
      .def_prop_ro("matched", &PyWriter::matched, "How many readers the writer has found.", ReleaseGil())
      .def("matched_handles", &matched_handles<PyWriter>, "The handles of those readers.")
      .def_prop_ro(
          "refused_policy", [](const PyWriter& self) { return self.incompatible().last_policy_id; },
          "DDS's number of the QoS policy that rejected the last reader; 0: none.", ReleaseGil())
      .def("close", &PyWriter::close, ReleaseGil());
}

// The properties of every reader with a `reader()`.
template <class Reader, class Class>
void define_reader_properties(Class& cls) {
  cls.def_prop_ro("guid", [](const Reader& self) { return to_bytes(guid_of(self.reader())); })
      .def(
          "take_status",
          [](Reader& self, std::size_t kind) { return values::take_status(self.reader().events(), kind); },
          nb::arg("kind"),
          "Return the counts of the status DEADLINE_MISSED, ... if it has changed since the last call.")
      .def_prop_ro(
          "matched", [](const Reader& self) { return self.reader().matched(); },
          "How many writers the reader has found.", ReleaseGil())
      .def(
          "matched_handles", [](const Reader& self) { return matched_handles(self.reader()); },
          "The handles of those writers.")
      .def_prop_ro(
          "refused_policy", [](const Reader& self) { return self.reader().incompatible().last_policy_id; },
          "DDS's number of the QoS policy that rejected the last writer; 0: none.", ReleaseGil())
      .def("close", &Reader::close, ReleaseGil(), "End the reader; no callback runs afterwards.");
}

void add_message(TransformStore& store, TransformStore::Writer writer, nb::bytes message) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(message.c_str());
  const std::size_t size = message.size();
  WithoutGil release;
  TransformStore::Ingest(store).add(writer, {data, size});
}

// What a reader of transforms and a store of transforms have in common. `of` returns the store.
template <class Reader, class Class, class Of>
void define_store_properties(Class& cls, Of of) {
  cls.def(
         "arm", [of](Reader& self) { of(self).arm(); }, "Let the next message set the event.")
      .def_prop_ro(
          "received", [of](const Reader& self) { return of(self).received(); }, "The number of received messages.")
      .def(
          "name_writer",
          [of](Reader& self, TransformStore::Writer writer, const std::string& authority) {
            of(self).name_writer(writer, authority);
          },
          nb::arg("writer"), nb::arg("authority"), ReleaseGil(),
          "Store `authority` as the source of this writer's past and future transforms.")
      .def(
          "forget_writer", [of](Reader& self, TransformStore::Writer writer) { of(self).forget_writer(writer); },
          nb::arg("writer"), ReleaseGil(), "Forget the writer with this handle.")
      .def(
          "writer_left", [of](Reader& self, TransformStore::Writer writer) { of(self).writer_left(writer); },
          nb::arg("writer"), ReleaseGil(),
          "Note that the writer with this handle no longer exists, so its static transforms are not published.")
      .def(
          "settle_statics", [of](Reader& self) { of(self).settle_statics(); }, ReleaseGil(),
          "From now on, count previously shared static transforms as published only if they were received.")
      .def(
          "writers", [of](const Reader& self) { return writers_of(of(self)); }, "Return the statistics of each writer.")
      .def_prop_ro(
          "stored_at", [of](const Reader& self) { return of(self).stored_at(); },
          "When the transforms of the newest message were stored, in nanoseconds of the steady clock; 0 if never.");
}

void define_readers(nb::module_& wire) {
  auto reader = nb::class_<PyReader>(wire, "Reader", "A DDS reader of serialized messages.");
  reader
      .def(nb::init<dds::Entity, dds::Entity, const QosProfile&, const std::string&, std::shared_ptr<Event>>(),
           nb::arg("participant"), nb::arg("topic"), nb::arg("qos"), nb::arg("user_data"), nb::arg("on_data").none(),
           ReleaseGil())
      .def(
          "take", [](PyReader& self, std::uint32_t limit) { return take_messages(self, limit, nullptr); },
          nb::arg("limit"), "Return up to `limit` tuples (bytes, source timestamp in ns, writer's handle).")
      .def(
          "take_decoded",
          [](PyReader& self, std::uint32_t limit, const MessageCodec& codec) {
            return take_messages(self, limit, &codec);
          },
          nb::arg("limit"), nb::arg("codec"),
          "The same with messages instead of bytes, except for messages that Python code has to read.")
      .def_prop_ro("pending", &PyReader::pending, "Whether messages may be waiting.");
  define_reader_properties<PyReader>(reader);

  auto tap = nb::class_<PyTap>(wire, "Tap", "Records messages with their arrival times on DDS's thread.");
  tap.def(
         "__init__",
         [](PyTap* self, dds::Entity participant, dds::Entity topic, const QosProfile& qos,
            const std::string& user_data, std::size_t head, std::size_t messages, std::size_t size) {
           new (self) PyTap(participant, topic, qos, user_data, Tap::Limits{head, messages, size});
         },
         nb::arg("participant"), nb::arg("topic"), nb::arg("qos"), nb::arg("user_data"), nb::arg("head"),
         nb::arg("messages"), nb::arg("size"), ReleaseGil())
      .def("take", &take_tapped,
           "Return the messages since the last call: their bytes, and as bytes their ends (uint64), arrived, sent "
           "(int64) "
           "and writer's handle (uint64).")
      .def_prop_ro("missed", &PyTap::missed, "How many messages arrived while it was full.");
  define_reader_properties<PyTap>(tap);

  auto tf_reader = nb::class_<PyTfReader>(wire, "TfReader", "Stores the transforms of a topic in a buffer.");
  tf_reader.def(
      "__init__",
      [](PyTfReader* self, dds::Entity participant, dds::Entity topic, const QosProfile& qos,
         const std::string& user_data, const BufferObject& buffer, bool is_static, const std::string& authority,
         const std::optional<Renaming>& renaming, std::shared_ptr<Event> on_data) {
        new (self) PyTfReader(participant, topic, qos, user_data, buffer.core, is_static, authority,
                              renaming ? std::make_shared<const Renaming>(*renaming) : nullptr, std::move(on_data));
      },
      nb::arg("participant"), nb::arg("topic"), nb::arg("qos"), nb::arg("user_data"), nb::arg("buffer"),
      nb::arg("is_static"), nb::arg("authority"), nb::arg("renaming") = nb::none(), nb::arg("on_data") = nb::none(),
      ReleaseGil());
  define_store_properties<PyTfReader>(tf_reader, [](auto& reader) -> auto& { return reader.store(); });
  define_reader_properties<PyTfReader>(tf_reader);

  auto store = nb::class_<TransformStore>(wire, "TransformStore", "Stores the transforms of messages in a buffer.");
  store
      .def(
          "__init__",
          [](TransformStore* self, const BufferObject& buffer, bool is_static, const std::string& authority,
             const std::optional<Renaming>& renaming, std::shared_ptr<Event> on_data) {
            new (self)
                TransformStore(buffer.core, is_static, authority,
                               renaming ? std::make_shared<const Renaming>(*renaming) : nullptr, std::move(on_data));
          },
          nb::arg("buffer"), nb::arg("is_static"), nb::arg("authority"), nb::arg("renaming") = nb::none(),
          nb::arg("on_data") = nb::none())
      .def("add", &add_message, nb::arg("writer"), nb::arg("message"),
           "Store the transforms of one serialized message without the GIL.");
  define_store_properties<TransformStore>(store, [](auto& self) -> auto& { return self; });

  nb::class_<PyEndpointReader>(wire, "EndpointReader", "The writers, readers or participants found by DDS discovery.")
      .def(nb::init<dds::Entity, dds::Entity, std::shared_ptr<Event>>(), nb::arg("participant"), nb::arg("topic"),
           nb::arg("on_change"), ReleaseGil())
      .def("take", &values::take_changes<WithoutGil, PyEndpointReader>,
           "Return the changes: tuples (handle, alive, guid, participant's guid, topic, type, "
           "(depth, reliable, transient_local, keep_all, manual_liveliness, deadline, lifespan, lease), user data, "
           "partitions). Those that are not alive have only the handle and the guid.")
      .def("close", &PyEndpointReader::close, ReleaseGil());
  wire.attr("DEADLINE_MISSED") = static_cast<std::size_t>(StatusEvents::kDeadlineMissed);
  wire.attr("LIVELINESS") = static_cast<std::size_t>(StatusEvents::kLiveliness);
  wire.attr("INCOMPATIBLE_QOS") = static_cast<std::size_t>(StatusEvents::kIncompatibleQos);
  wire.attr("MATCHED") = static_cast<std::size_t>(StatusEvents::kMatched);
  wire.attr("SAMPLE_LOST") = static_cast<std::size_t>(StatusEvents::kSampleLost);
  wire.attr("PARTICIPANTS") = dds::kParticipantTopic;
  wire.attr("PUBLICATIONS") = dds::kPublicationTopic;
  wire.attr("SUBSCRIPTIONS") = dds::kSubscriptionTopic;
}

}  // namespace

void define_wire(nb::module_& wire) {
  nb::exception<dds::Error>(wire, "EndpointError", PyExc_RuntimeError);
  wire.def("load_dds", &dds::load, nb::arg("path"),
           "Load the DDS library and return its release, \"0.10\" or \"11\"; raise RuntimeError if it is not usable.");
  wire.def("create_unchecked_topic", &dds::create_unchecked_topic, nb::arg("participant"), nb::arg("name"),
           nb::arg("type_name"), ReleaseGil(),
           "Create a topic whose readers check the bytes themselves; return its handle.");
  wire.def(
      "is_tf_message",
      [](nb::bytes message) {
        const auto* data = reinterpret_cast<const std::uint8_t*>(message.c_str());
        return check_tf_message(data, message.size()).reason == nullptr;
      },
      nb::arg("message"), "Whether the bytes are a serialized TFMessage.");
  nb::class_<QosProfile>(wire, "QosProfile", "The policies that ROS programs set. Durations are in nanoseconds.")
      .def(
          "__init__",
          [](QosProfile* self, std::int32_t depth, bool reliable, bool transient_local, bool keep_all,
             bool manual_liveliness, std::int64_t deadline, std::int64_t lifespan, std::int64_t lease,
             std::vector<std::string> partitions) {
            new (self) QosProfile{.depth = depth,
                                  .reliable = reliable,
                                  .transient_local = transient_local,
                                  .keep_all = keep_all,
                                  .manual_liveliness = manual_liveliness,
                                  .deadline_ns = deadline,
                                  .lifespan_ns = lifespan,
                                  .lease_ns = lease,
                                  .partitions = std::move(partitions)};
          },
          nb::arg("depth"), nb::arg("reliable"), nb::arg("transient_local"), nb::arg("keep_all"),
          nb::arg("manual_liveliness") = false, nb::arg("deadline") = kInfinite, nb::arg("lifespan") = kInfinite,
          nb::arg("lease") = kInfinite, nb::arg("partitions") = std::vector<std::string>{});
  define_participant(wire);
  define_writer(wire);
  define_readers(wire);
}

}  // namespace coframe::bindings
