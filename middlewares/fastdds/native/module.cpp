// SPDX-License-Identifier: Apache-2.0
// The private module coframe_fastdds._fastdds: participants, writers and readers of Fast DDS for Python.
#include <dlfcn.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coframe/endpoint_values.hpp"
#include "participant.hpp"
#include "readers.hpp"
#include "writer.hpp"

namespace coframe::fastdds {
namespace {

namespace nb = nanobind;

class WithoutGil {
 public:
  WithoutGil() : thread_(core->leave_python()) {}
  ~WithoutGil() { core->enter_python(thread_); }
  WithoutGil(const WithoutGil&) = delete;
  WithoutGil& operator=(const WithoutGil&) = delete;

 private:
  void* thread_;
};
using ReleaseGil = nb::call_guard<WithoutGil>;

// Returns the native object of a Python object of the core; null for None.
void* native(void* (*of)(PyObject*), nb::handle object) {
  if (object.is_none()) return nullptr;
  void* found = of(object.ptr());
  if (found == nullptr) throw nb::python_error();
  return found;
}

nb::bytes to_bytes(const rtps::GUID_t& guid) {
  const Guid bytes = bytes_of(guid);
  return nb::bytes(bytes.data(), bytes.size());
}

rtps::GUID_t to_guid(const nb::bytes& bytes) {
  Guid guid;
  if (bytes.size() != guid.size()) throw nb::value_error("a GUID has 16 bytes");
  std::memcpy(guid.data(), bytes.c_str(), guid.size());
  return guid_of(guid);
}

rtps::SampleIdentity to_identity(const nb::bytes& guid, std::int64_t sequence) {
  rtps::SampleIdentity identity;
  identity.writer_guid(to_guid(guid));
  identity.sequence_number(rtps::SequenceNumber_t(static_cast<std::int32_t>(sequence >> 32),
                                                  static_cast<std::uint32_t>(sequence & 0xffffffff)));
  return identity;
}

nb::bytes to_bytes(Incoming message) { return values::message_bytes<WithoutGil>(message.data(), message.size()); }

// An object that is created and destroyed without the GIL.
template <class Object>
class OutsideGil {
 public:
  template <class... Arguments>
  explicit OutsideGil(Arguments&&... arguments) {
    WithoutGil release;
    object_.emplace(std::forward<Arguments>(arguments)...);
  }
  ~OutsideGil() {
    WithoutGil release;
    object_.reset();
  }
  OutsideGil(const OutsideGil&) = delete;
  OutsideGil& operator=(const OutsideGil&) = delete;
  Object* operator->() { return &*object_; }

 private:
  std::optional<Object> object_;
};

// The Python object of an endpoint: the native endpoint, and the objects of the core that its callbacks use. It is
// closed without the GIL, because closing waits for the threads of Fast DDS.
template <class Native>
struct Holder {
  nb::object event, store;
  std::unique_ptr<Native> native;

  void close() {
    WithoutGil release;
    native->close();
  }
  ~Holder() {
    if (!native) return;
    WithoutGil release;
    native.reset();
  }
};

struct PyParticipant {
  nb::object changed;
  std::shared_ptr<Participant> native;

  Participant& get() const {
    if (!native) throw Error("the participant is closed");
    return *native;
  }
  void close() {
    if (!native) return;
    native->stop();
    WithoutGil release;
    native.reset();
  }
  ~PyParticipant() { close(); }
};

template <class Native, class Class>
void define_endpoint(Class& cls) {
  using Self = Holder<Native>;
  cls.def_prop_ro("guid", [](const Self& self) { return to_bytes(self.native->guid()); })
      .def_prop_ro("matched", [](const Self& self) { return self.native->events().matched().size(); })
      .def("matched_handles", [](const Self& self) { return self.native->events().matched(); })
      .def_prop_ro("refused_policy", [](const Self& self) { return self.native->events().refused_policy(); })
      .def(
          "take_status",
          [](const Self& self, std::size_t kind) { return values::take_status(self.native->events(), kind); },
          nb::arg("kind"))
      .def("close", &Self::close);
}

void define_participant(nb::module_& module) {
  nb::class_<PyParticipant>(module, "Participant", "A participant of a DDS domain.")
      .def(
          "__init__",
          [](PyParticipant* self, std::uint32_t domain, std::string name, std::string user_data, std::string range,
             std::vector<std::string> peers, std::string profiles, bool qos_from_profiles, bool asynchronous,
             std::vector<std::pair<std::string, std::string>> properties, nb::object changed) {
            void* event = native(core->event, changed);
            const ParticipantOptions options{.domain = domain,
                                             .name = std::move(name),
                                             .user_data = std::move(user_data),
                                             .range = std::move(range),
                                             .peers = std::move(peers),
                                             .profiles = std::move(profiles),
                                             .qos_from_profiles = qos_from_profiles,
                                             .asynchronous = asynchronous,
                                             .properties = std::move(properties)};
            std::shared_ptr<Participant> result;
            {
              WithoutGil release;
              result = std::make_shared<Participant>(options, event);
            }
            new (self) PyParticipant{std::move(changed), std::move(result)};
          },
          nb::kw_only(), nb::arg("domain"), nb::arg("name"), nb::arg("user_data"), nb::arg("discovery_range"),
          nb::arg("peers"), nb::arg("profiles"), nb::arg("qos_from_profiles"), nb::arg("asynchronous"),
          nb::arg("properties"), nb::arg("changed"))
      .def_prop_ro("guid", [](const PyParticipant& self) { return to_bytes(self.get().guid()); })
      .def(
          "take_writers",
          [](const PyParticipant& self) { return values::take_changes<WithoutGil>(self.get().writers()); },
          "Return the changes of writers; see coframe._core.EndpointReader.take.")
      .def(
          "take_readers",
          [](const PyParticipant& self) { return values::take_changes<WithoutGil>(self.get().readers()); },
          "Return the changes of readers.")
      .def(
          "take_participants",
          [](const PyParticipant& self) { return values::take_changes<WithoutGil>(self.get().participants()); },
          "Return the changes of participants.")
      .def(
          "take_ignored", [](const PyParticipant& self) { return self.get().take_ignored(); },
          "Return the topics with received messages that could not be passed on, and their numbers since the last "
          "call.")
      .def("close", &PyParticipant::close);
}

using PyWriter = Holder<Writer>;

void check_accepted(const Writer& writer, std::span<const coframe_part> parts) {
  if (!writer.accepts(parts)) throw Error("could not write: the message is not valid");
}

std::int64_t write_bytes(PyWriter& self, const nb::bytes& message, bool checked,
                         const rtps::SampleIdentity* request_id) {
  const coframe_part part{message.c_str(), message.size()};
  WithoutGil release;
  if (checked) check_accepted(*self.native, {&part, 1});
  return self.native->write({&part, 1}, message.size(), request_id);
}

// Sends a serialized message and sets a Python exception if that fails.
struct Sending {
  Writer& writer;
  nb::object failure{};  // None: raise EndpointError; otherwise a function that returns the exception for a text

  static int send(void* context, const coframe_part* parts, std::size_t count, std::size_t size) {
    auto& self = *static_cast<Sending*>(context);
    const std::span<const coframe_part> message(parts, count);
    std::string problem;
    try {
      WithoutGil release;
      check_accepted(self.writer, message);
      self.writer.write(message, size);
      return 0;
    } catch (const std::exception& error) {
      problem = error.what();
    }
    self.raise(problem);
    return -1;
  }

  void raise(const std::string& problem) const {
    if (!failure.is_valid()) {
      PyErr_SetString(endpoint_error.ptr(), problem.c_str());
      return;
    }
    try {
      const nb::object exception = failure(problem);
      PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
    } catch (nb::python_error& error) {
      error.restore();
    }
  }

  static nb::handle endpoint_error;
};
nb::handle Sending::endpoint_error;

bool publish(PyWriter& self, nb::handle codec, nb::handle message) {
  Sending sending{*self.native};
  const int sent = core->encode(native(core->codec, codec), message.ptr(), 0, &Sending::send, &sending);
  if (sent < 0) throw nb::python_error();
  return sent == 1;
}

struct DirectWriter {
  nb::object owner, codec_object, closed_object;
  Sending sending;
  void* codec;
  void* closed;
  bool of_items;
};

PyObject* publish_directly(PyObject* self, PyObject* message) {
  auto& direct = *static_cast<DirectWriter*>(PyCapsule_GetPointer(self, nullptr));
  if (core->is_event_set(direct.closed) || direct.sending.writer.closed()) Py_RETURN_FALSE;
  const int sent = core->encode(direct.codec, message, direct.of_items, &Sending::send, &direct.sending);
  if (sent >= 0) return PyBool_FromLong(sent);
  if (!direct.sending.writer.closed()) return nullptr;
  PyErr_Clear();  // closed by another thread in the meantime
  Py_RETURN_FALSE;
}

PyMethodDef direct_definition{"publish", &publish_directly, METH_O,
                              "Send a message; return False if Python code has to send it."};

nb::object direct_function(nb::handle self, nb::object codec, nb::object closed, nb::object failure, bool of_items) {
  Writer& writer = *nb::cast<PyWriter&>(self).native;
  void* native_codec = native(core->codec, codec);
  void* native_closed = native(core->event, closed);
  auto direct = std::make_unique<DirectWriter>(DirectWriter{nb::borrow(self), std::move(codec), std::move(closed),
                                                            Sending{writer, std::move(failure)}, native_codec,
                                                            native_closed, of_items});
  const nb::object capsule = nb::steal(PyCapsule_New(direct.get(), nullptr, [](PyObject* object) {
    delete static_cast<DirectWriter*>(PyCapsule_GetPointer(object, nullptr));
  }));
  if (!capsule.is_valid()) throw nb::python_error();
  direct.release();
  nb::object function = nb::steal(PyCFunction_New(&direct_definition, capsule.ptr()));
  if (!function.is_valid()) throw nb::python_error();
  return function;
}

// Reads the tuple that coframe_fastdds._session.native_qos returns.
Qos to_qos(const nb::tuple& values) {
  return {.depth = nb::cast<std::int32_t>(values[0]),
          .reliable = nb::cast<bool>(values[1]),
          .transient_local = nb::cast<bool>(values[2]),
          .keep_all = nb::cast<bool>(values[3]),
          .manual_liveliness = nb::cast<bool>(values[4]),
          .deadline_ns = nb::cast<std::int64_t>(values[5]),
          .lifespan_ns = nb::cast<std::int64_t>(values[6]),
          .lease_ns = nb::cast<std::int64_t>(values[7]),
          .partitions = nb::cast<std::vector<std::string>>(values[8]),
          .latency_budget_ns = nb::cast<std::int64_t>(values[9])};
}

template <class Native, class... Arguments>
void construct(Holder<Native>* self, const PyParticipant& participant, const std::string& topic,
               const std::string& type, const nb::tuple& qos, const std::string& user_data, nb::object event,
               nb::object store, Arguments&&... arguments) {
  const Qos native_qos = to_qos(qos);
  participant.get();
  const std::shared_ptr<Participant> native_participant = participant.native;
  std::unique_ptr<Native> result;
  {
    WithoutGil release;
    result = std::make_unique<Native>(native_participant, topic, type, native_qos, user_data,
                                      std::forward<Arguments>(arguments)...);
  }
  new (self) Holder<Native>{std::move(event), std::move(store), std::move(result)};
}

void define_writer(nb::module_& module) {
  auto writer = nb::class_<PyWriter>(module, "Writer", "A publisher of serialized messages.");
  writer
      .def(
          "__init__",
          [](PyWriter* self, const PyParticipant& participant, const std::string& topic, const std::string& type,
             const nb::tuple& qos, const std::string& user_data, bool checked, nb::object on_change) {
            void* event = native(core->event, on_change);
            construct(self, participant, topic, type, qos, user_data, std::move(on_change), nb::object(), checked,
                      event);
          },
          nb::arg("participant"), nb::arg("topic"), nb::arg("type_name"), nb::arg("qos"), nb::arg("user_data"),
          nb::arg("checked") = false, nb::arg("on_change") = nb::none())
      .def(
          "write", [](PyWriter& self, const nb::bytes& message) { write_bytes(self, message, true, nullptr); },
          nb::arg("message"), "Send a message.")
      .def(
          "forward", [](PyWriter& self, const nb::bytes& message) { write_bytes(self, message, false, nullptr); },
          nb::arg("message"), "Send a message without checking its bytes.")
      .def(
          "write_related",
          [](PyWriter& self, const nb::bytes& message, const nb::bytes& guid, std::int64_t sequence) {
            const rtps::SampleIdentity request_id = to_identity(guid, sequence);
            return write_bytes(self, message, false, &request_id);
          },
          nb::arg("message"), nb::arg("guid"), nb::arg("sequence"),
          "Send a message with a related sample identity; return its sequence number.")
      .def(
          "write_nothing", [](PyWriter& self) { self.native->write_nothing(); }, ReleaseGil(),
          "Send a message without a payload, which Cyclone DDS acknowledges and delivers to no reader.")
      .def("publish", &publish, nb::arg("codec"), nb::arg("message"),
           "Serialize and send a message; return False if Python code has to serialize it.")
      .def("direct", &direct_function, nb::arg("codec"), nb::arg("closed"), nb::arg("failure"), nb::arg("of_items"),
           "Return a function that does what `publish` does; see coframe._core.Writer.direct.")
      .def(
          "assert_liveliness", [](PyWriter& self) { self.native->assert_liveliness(); }, ReleaseGil())
      .def(
          "wait_for_acks",
          [](PyWriter& self, std::int64_t timeout_ns) { return self.native->wait_for_acks(timeout_ns); },
          nb::arg("timeout_ns"), ReleaseGil());
  define_endpoint<Writer>(writer);
}

// Calls `use` with up to `limit` messages, oldest first. Fast DDS provides fewer of them at once.
template <class Use>
void take_all(Holder<Reader>& self, std::uint32_t limit, Use&& use) {
  bool may_have_more = true;
  while (may_have_more && limit > 0) {
    OutsideGil<Reader::Taken> taken(*self.native, limit);
    taken->each([&](const Message& message) {
      --limit;
      use(message);
    });
    may_have_more = taken->full();
  }
}

nb::list take(Holder<Reader>& self, std::uint32_t limit, nb::handle codec) {
  void* native_codec = codec.is_none() ? nullptr : native(core->codec, codec);
  nb::list list;
  take_all(self, limit, [&](const Message& message) {
    nb::object decoded = nb::none();
    if (native_codec != nullptr) {
      decoded = nb::steal(core->decode(native_codec, message.bytes.data(), message.bytes.size()));
      if (!decoded.is_valid()) throw nb::python_error();
    }
    if (decoded.is_none()) decoded = to_bytes(message.bytes);
    list.append(nb::make_tuple(decoded, message.sent, message.writer));
  });
  return list;
}

std::int64_t sequence_of(const rtps::SampleIdentity& identity) {
  return static_cast<std::int64_t>(identity.sequence_number().to64long());
}

nb::list take_identified(Holder<Reader>& self, std::uint32_t limit) {
  nb::list list;
  take_all(self, limit, [&](const Message& message) {
    list.append(nb::make_tuple(to_bytes(message.bytes), message.sent, message.writer,
                               to_bytes(message.identity.writer_guid()), sequence_of(message.identity),
                               to_bytes(message.related.writer_guid()), sequence_of(message.related)));
  });
  return list;
}

nb::tuple take_tapped(Holder<Tap>& self) {
  Tap::Messages messages;
  {
    WithoutGil release;
    messages = self.native->take();
  }
  return nb::make_tuple(nb::bytes(messages.bytes.data(), messages.bytes.size()), values::array_bytes(messages.ends),
                        values::array_bytes(messages.arrived), values::array_bytes(messages.sent),
                        values::array_bytes(messages.writers));
}

void define_readers(nb::module_& module) {
  auto reader = nb::class_<Holder<Reader>>(module, "Reader", "A subscription that queues messages.");
  reader
      .def(
          "__init__",
          [](Holder<Reader>* self, const PyParticipant& participant, const std::string& topic, const std::string& type,
             const nb::tuple& qos, const std::string& user_data, nb::object on_data) {
            void* event = native(core->event, on_data);
            construct(self, participant, topic, type, qos, user_data, std::move(on_data), nb::object(), event);
          },
          nb::arg("participant"), nb::arg("topic"), nb::arg("type_name"), nb::arg("qos"), nb::arg("user_data"),
          nb::arg("on_data").none())
      .def(
          "take", [](Holder<Reader>& self, std::uint32_t limit) { return take(self, limit, nb::none()); },
          nb::arg("limit"), "Return up to `limit` tuples (bytes, source timestamp in ns, writer's handle).")
      .def("take_decoded", &take, nb::arg("limit"), nb::arg("codec"),
           "The same with messages instead of bytes, except for messages that Python code has to read.")
      .def("take_identified", &take_identified, nb::arg("limit"),
           "Return up to `limit` tuples (bytes, source timestamp in ns, writer's handle, writer's GUID and sequence "
           "number, related GUID and sequence number).")
      .def_prop_ro("pending", [](const Holder<Reader>& self) { return self.native->pending(); });
  define_endpoint<Reader>(reader);

  auto tap = nb::class_<Holder<Tap>>(module, "Tap", "Records messages with their arrival times.");
  tap.def(
         "__init__",
         [](Holder<Tap>* self, const PyParticipant& participant, const std::string& topic, const std::string& type,
            const nb::tuple& qos, const std::string& user_data, std::size_t head, std::size_t messages,
            std::size_t size) {
           construct(self, participant, topic, type, qos, user_data, nb::object(), nb::object(),
                     Tap::Limits{head, messages, size});
         },
         nb::arg("participant"), nb::arg("topic"), nb::arg("type_name"), nb::arg("qos"), nb::arg("user_data"),
         nb::arg("head"), nb::arg("messages"), nb::arg("size"))
      .def("take", &take_tapped, "Return the messages since the last call; see coframe._core.Tap.take.")
      .def_prop_ro("missed", [](const Holder<Tap>& self) { return self.native->missed(); });
  define_endpoint<Tap>(tap);

  auto tf_reader = nb::class_<Holder<TfReader>>(module, "TfReader", "Stores transforms without the GIL.");
  tf_reader.def(
      "__init__",
      [](Holder<TfReader>* self, const PyParticipant& participant, const std::string& topic, const std::string& type,
         const nb::tuple& qos, const std::string& user_data, nb::object store, nb::object on_change) {
        void* native_store = native(core->store, store);
        if (native_store == nullptr) throw nb::type_error("store must be a TransformStore");
        void* event = native(core->event, on_change);
        construct(self, participant, topic, type, qos, user_data, std::move(on_change), std::move(store), native_store,
                  event);
      },
      nb::arg("participant"), nb::arg("topic"), nb::arg("type_name"), nb::arg("qos"), nb::arg("user_data"),
      nb::arg("store"), nb::arg("on_change").none());
  define_endpoint<TfReader>(tf_reader);
}

std::string library() {
  Dl_info info{};
  dds::DomainParticipantFactory* (*function)() = &dds::DomainParticipantFactory::get_instance;
  if (dladdr(reinterpret_cast<const void*>(function), &info) == 0 || info.dli_fname == nullptr) return "unknown";
  return info.dli_fname;
}

void load_core(const nb::module_& native_core) {
  core = static_cast<const coframe_middleware*>(PyCapsule_Import(COFRAME_MIDDLEWARE_CAPSULE, 0));
  if (core == nullptr) throw nb::python_error();
  if (core->version != COFRAME_MIDDLEWARE_VERSION) {
    PyErr_Format(PyExc_ImportError,
                 "coframe provides version %u of its interface for middlewares, and this module needs "
                 "version %u. Install coframe-fastdds again.",
                 core->version, COFRAME_MIDDLEWARE_VERSION);
    throw nb::python_error();
  }
  Sending::endpoint_error = nb::object(native_core.attr("EndpointError")).release();
}

}  // namespace
}  // namespace coframe::fastdds

NB_MODULE(_fastdds, module) {
  using namespace coframe::fastdds;
  nb::set_leak_warnings(false);  // threads that are alive at exit keep their objects
  load_core(nb::module_::import_("coframe._core"));
  nb::register_exception_translator([](const std::exception_ptr& pointer, void*) {
    try {
      std::rethrow_exception(pointer);
    } catch (const Error& error) {
      PyErr_SetString(Sending::endpoint_error.ptr(), error.what());
    }
  });
  module.doc() = "The native part of coframe_fastdds. Private.";
  module.def(
      "handle_of", [](const nb::bytes& guid) { return handle_of(to_guid(guid)); }, nb::arg("guid"),
      "Return the handle of an endpoint in this process.");
  module.attr("SHARES_MEMORY") = kSharesMemory;
  module.attr("HAS_SECURITY") = HAVE_SECURITY != 0;
  module.def("library", &library, "Return the path of the library that is loaded.");
  module.attr("VERSION") = COFRAME_FASTDDS_VERSION;
  define_participant(module);
  define_writer(module);
  define_readers(module);
}
