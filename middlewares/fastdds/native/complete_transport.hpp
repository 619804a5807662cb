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

class CompleteTransportDescriptor final : public transport::ChainingTransportDescriptor {
 public:
  CompleteTransportDescriptor(std::shared_ptr<transport::TransportDescriptorInterface> wrapped,
                              std::shared_ptr<Completion> participant)
      : ChainingTransportDescriptor(std::move(wrapped)), participant_(std::move(participant)) {}

  transport::TransportInterface* create_transport() const override;

 private:
  std::shared_ptr<Completion> participant_;
};

class CompleteTransport final : public transport::ChainingTransport {
 public:
  CompleteTransport(const CompleteTransportDescriptor& descriptor, std::shared_ptr<Completion> participant)
      : ChainingTransport(descriptor), descriptor_(descriptor), participant_(std::move(participant)) {}

  transport::TransportDescriptorInterface* get_configuration() override { return &descriptor_; }

  void receive(transport::TransportReceiverInterface* next, const rtps::octet* bytes, std::uint32_t size,
               const rtps::Locator_t& to, const rtps::Locator_t& from) override {
    if (!is_complete_) {
      participant_->wait();
      is_complete_ = true;
    }
    next->OnDataReceived(bytes, size, to, from);
  }

#if COFRAME_FASTDDS_3
  bool send(rtps::SenderResource* wrapped, const std::vector<transport::NetworkBuffer>& buffers, std::uint32_t size,
            rtps::LocatorsIterator* begin, rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& deadline) override {
    return wrapped->send(buffers, size, begin, end, deadline);
  }
#else
  bool send(rtps::SenderResource* wrapped, const rtps::octet* bytes, std::uint32_t size, rtps::LocatorsIterator* begin,
            rtps::LocatorsIterator* end, const std::chrono::steady_clock::time_point& deadline) override {
    return wrapped->send(bytes, size, begin, end, deadline);
  }
#endif

 private:
  CompleteTransportDescriptor descriptor_;
  std::shared_ptr<Completion> participant_;
  std::atomic<bool> is_complete_ = false;
};

inline transport::TransportInterface* CompleteTransportDescriptor::create_transport() const {
  return new CompleteTransport(*this, participant_);
}

}  // namespace coframe::fastdds
