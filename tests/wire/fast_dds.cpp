// SPDX-License-Identifier: Apache-2.0
// A program on Fast DDS that tests control by lines on its standard input, because rmw_fastrtps cannot be installed
// with pip. Payloads are serialized by the tests. Usage: fast_dds DOMAIN
//
//   writer TOPIC TYPE volatile|transient   -> guid HEX
//   reader TOPIC TYPE volatile|transient   -> guid HEX; later: received TOPIC SIZE CHECKSUM FIRST_BYTES
//   write TOPIC HEX                        -> written
//   matched TOPIC                          -> matched N
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <string>
#include <vector>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>

using namespace eprosima::fastdds::dds;
using eprosima::fastrtps::rtps::GUID_t;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

using Bytes = std::vector<std::uint8_t>;

std::mutex output;

void say(const std::string& line) {
  const std::lock_guard lock(output);
  std::cout << line << std::endl;
}

std::string hex(const std::uint8_t* data, std::size_t size) {
  std::string text;
  char two[3];
  for (std::size_t i = 0; i < size; ++i) {
    std::snprintf(two, sizeof two, "%02x", data[i]);
    text += two;
  }
  return text;
}

// Messages as they are on the wire: 4 bytes of encapsulation, then CDR.
class Serialized : public TopicDataType {
 public:
  explicit Serialized(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 4096;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, InstanceHandle_t*, bool) override { return false; }
};

class Receiver : public DataReaderListener {
 public:
  void on_data_available(DataReader* reader) override {
    Bytes bytes;
    SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      std::uint64_t checksum = 0;
      for (const std::uint8_t byte : bytes) checksum += byte;
      say("received " + reader->get_topicdescription()->get_name() + " " + std::to_string(bytes.size()) + " " +
          std::to_string(checksum) + " " + hex(bytes.data(), std::min<std::size_t>(bytes.size(), 64)));
    }
  }
};

int main(int, char** arguments) {
  DomainParticipantQos participant_qos = PARTICIPANT_QOS_DEFAULT;
  const std::string enclave = "enclave=/;";
  participant_qos.user_data().assign(enclave.begin(), enclave.end());
  DomainParticipant* participant = DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(std::stoi(arguments[1])), participant_qos);
  Publisher* publisher = participant->create_publisher(PUBLISHER_QOS_DEFAULT);
  Subscriber* subscriber = participant->create_subscriber(SUBSCRIBER_QOS_DEFAULT);
  std::map<std::string, Topic*> topics;
  std::map<std::string, DataWriter*> writers;
  std::map<std::string, DataReader*> readers;
  Receiver receiver;
  const GUID_t own = participant->guid();
  say("guid " + hex(own.guidPrefix.value, 12) + hex(own.entityId.value, 4));

  const auto topic_of = [&](const std::string& name, const std::string& type) {
    if (topics.count(name) == 0) {
      participant->register_type(TypeSupport(new Serialized(type)));
      topics[name] = participant->create_topic(name, type, TOPIC_QOS_DEFAULT);
    }
    return topics[name];
  };
  const auto durability_of = [](const std::string& word) {
    return word == "transient" ? TRANSIENT_LOCAL_DURABILITY_QOS : VOLATILE_DURABILITY_QOS;
  };

  for (std::string line; std::getline(std::cin, line);) {
    std::istringstream words(line);
    std::string command, topic, type, durability;
    words >> command >> topic >> type >> durability;
    if (command == "writer") {
      DataWriterQos qos = DATAWRITER_QOS_DEFAULT;
      qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
      qos.durability().kind = durability_of(durability);
      qos.history().depth = 10;
      qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
      DataWriter* writer = writers[topic] = publisher->create_datawriter(topic_of(topic, type), qos);
      say("guid " + hex(writer->guid().guidPrefix.value, 12) + hex(writer->guid().entityId.value, 4));
    } else if (command == "reader") {
      DataReaderQos qos = DATAREADER_QOS_DEFAULT;
      qos.reliability().kind = RELIABLE_RELIABILITY_QOS;
      qos.durability().kind = durability_of(durability);
      qos.history().depth = 10;
      qos.endpoint().history_memory_policy = eprosima::fastrtps::rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
      DataReader* reader = readers[topic] = subscriber->create_datareader(topic_of(topic, type), qos, &receiver);
      say("guid " + hex(reader->guid().guidPrefix.value, 12) + hex(reader->guid().entityId.value, 4));
    } else if (command == "write") {
      Bytes bytes;
      for (std::size_t i = 0; i + 1 < type.size(); i += 2) {
        bytes.push_back(static_cast<std::uint8_t>(std::stoi(type.substr(i, 2), nullptr, 16)));
      }
      writers.at(topic)->write(&bytes);
      say("written");
    } else if (command == "matched") {
      int count = 0;
      if (writers.count(topic) != 0) {
        PublicationMatchedStatus status;
        writers[topic]->get_publication_matched_status(status);
        count = status.current_count;
      } else {
        SubscriptionMatchedStatus status;
        readers.at(topic)->get_subscription_matched_status(status);
        count = status.current_count;
      }
      say("matched " + std::to_string(count));
    }
  }
  std::_Exit(0);  // Taking Fast DDS down is not part of the test.
}
