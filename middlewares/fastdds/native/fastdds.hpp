// SPDX-License-Identifier: Apache-2.0
// Fast DDS 2 and 3 behind the same names. In version 3, namespaces and a few signatures changed.
#pragma once

#if __has_include(<fastdds/config.hpp>)
#include <fastdds/config.hpp>
#define COFRAME_FASTDDS_VERSION FASTDDS_VERSION_STR
#define COFRAME_FASTDDS_3 1
#else
#include <fastrtps/config.h>
#define COFRAME_FASTDDS_VERSION FASTRTPS_VERSION_STR
#define COFRAME_FASTDDS_3 0
#endif

#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <limits>
#include <string>
#if COFRAME_FASTDDS_3
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/rtps/common/WriteParams.hpp>
#include <fastdds/rtps/transport/ChainingTransport.hpp>
#include <fastdds/rtps/transport/SenderResource.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/common/WriteParams.h>
#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/ChainingTransport.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/log/Log.hpp>
#endif

namespace coframe::fastdds {

namespace dds = eprosima::fastdds::dds;
namespace transport = eprosima::fastdds::rtps;
#if COFRAME_FASTDDS_3
namespace rtps = eprosima::fastdds::rtps;
using Duration = dds::Duration_t;
using Code = dds::ReturnCode_t;
using DeadlineMissedStatus = dds::DeadlineMissedStatus;
using LivelinessChangedStatus = dds::LivelinessChangedStatus;
using IPLocator = rtps::IPLocator;
inline bool is_ok(Code code) { return code == dds::RETCODE_OK; }
inline bool is_timeout(Code code) { return code == dds::RETCODE_TIMEOUT; }
#else
namespace rtps = eprosima::fastrtps::rtps;
using Duration = eprosima::fastrtps::Duration_t;
using Code = eprosima::fastrtps::types::ReturnCode_t;
using DeadlineMissedStatus = eprosima::fastrtps::DeadlineMissedStatus;
using LivelinessChangedStatus = eprosima::fastrtps::LivelinessChangedStatus;
using IPLocator = rtps::IPLocator;
inline bool is_ok(const Code& code) { return code == Code::RETCODE_OK; }
inline bool is_timeout(const Code& code) { return code == Code::RETCODE_TIMEOUT; }
#endif

inline constexpr std::int64_t kInfinite = std::numeric_limits<std::int64_t>::max();  // as in ROS

inline Duration to_duration(std::int64_t nanoseconds) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  constexpr std::int64_t kLongest = std::numeric_limits<std::int32_t>::max();
  if (nanoseconds / kSecond >= kLongest) return Duration(0x7fffffff, 0xffffffffU);
  return Duration(static_cast<std::int32_t>(nanoseconds / kSecond), static_cast<std::uint32_t>(nanoseconds % kSecond));
}

inline std::int64_t to_nanoseconds(const Duration& duration) {
  return duration.seconds >= 0x7fffffff ? kInfinite : duration.seconds * 1'000'000'000LL + duration.nanosec;
}

}  // namespace coframe::fastdds
