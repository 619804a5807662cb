// SPDX-License-Identifier: Apache-2.0
// A transport that passes no message on before its participant is complete.
//
// Fast DDS announces a participant before it receives anything. Others answer at once, but only the first announcement:
// answers that arrive too early would be lost, and would be repeated after up to 3 s.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "fastdds.hpp"

namespace coframe::fastdds {

// Whether a participant is complete.
class Completion {
 public:
  void set() {
    {
      const std::lock_guard lock(mutex_);
      complete_ = true;
    }
    changed_.notify_all();
  }

  // Waits until the participant is complete, or for 1 s: one that could not be created closes its transports.
  void wait() {
    constexpr std::chrono::seconds kPatience(1);
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, kPatience, [this] { return complete_; });
    complete_ = true;
  }

 private:
  std::mutex mutex_;  // protects the member below
  std::condition_variable changed_;
  bool complete_ = false;
};

class CompleteTransport final : public transport::ChainingTransport {
 public:
  CompleteTransport(std::shared_ptr<transport::TransportDescriptorInterface> wrapped,
                    std::shared_ptr<Completion> participant)
      : ChainingTransport(Wrapped(std::move(wrapped))), participant_(std::move(participant)) {}

  transport::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }

  // What is sent does not pass through this object.
  bool OpenOutputChannel(transport::SendResourceList& senders, const rtps::Locator_t& address) override {
    return low_level_transport_->OpenOutputChannel(senders, address);
  }

  void receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& to, const rtps::Locator_t& from) override {
    if (!is_complete_) {
      participant_->wait();
      is_complete_ = true;
    }
    next->OnDataReceived(bytes, size, to, from);
  }

 private:
  struct Wrapped final : transport::ChainingTransportDescriptor {
    using ChainingTransportDescriptor::ChainingTransportDescriptor;
    transport::TransportInterface* create_transport() const override { return nullptr; }
  };

#if COFRAME_FASTDDS_3
  bool send(rtps::SenderResource*, const std::vector<transport::NetworkBuffer>&, std::uint32_t, rtps::LocatorsIterator*,
            rtps::LocatorsIterator*, const std::chrono::steady_clock::time_point&) override {
    return false;
  }
#else
  bool send(rtps::SenderResource*, const rtps::octet*, std::uint32_t, rtps::LocatorsIterator*, rtps::LocatorsIterator*,
            const std::chrono::steady_clock::time_point&) override {
    return false;
  }
#endif

  std::shared_ptr<Completion> participant_;
  std::atomic<bool> is_complete_ = false;
};

// The configuration of a transport. Fast DDS looks at its type.
template <class Descriptor>
class CompleteDescriptor final : public Descriptor {
 public:
  CompleteDescriptor(const Descriptor& descriptor, std::shared_ptr<Completion> participant)
      : Descriptor(descriptor), participant_(std::move(participant)) {}

  transport::TransportInterface* create_transport() const override {
    return new CompleteTransport(std::make_shared<Descriptor>(*this), participant_);
  }

 private:
  std::shared_ptr<Completion> participant_;
};

}  // namespace coframe::fastdds
