// A kernel with one CAN interface, made of plain fields: what arrives, what it takes, how it fails.
#pragma once

#include <errno.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "link/can/can_system.h"

namespace nord_driver::link {

class FakeCanSystem final : public CanSystem {
 public:
  static constexpr int kSocket = 7;
  static constexpr int kMessages = 8;

  // The world.
  CanInterface interface;
  int open_error = 0;
  int read_interface_error = 0;
  int interface_messages_error = 0;
  int filter_error = 0;
  int bind_error = 0;
  int restart_error = 0;

  /// What one read brings; a negative error stands for the receipt.
  struct Arrival {
    int error = 0;
    CanReceipt receipt;
  };
  struct Message {
    int error = 0;
    CanInterface interface;
  };
  std::deque<Arrival> arrivals;
  std::deque<Message> messages;
  std::deque<int> send_errors;
  std::deque<int> poll_errors;
  bool has_room = true;
  std::uint32_t drop_count = 0;
  mutable Instant time{std::chrono::hours{1}};

  // What was done.
  int open_descriptors = 0;
  int restarts = 0;
  int polls = 0;
  int receive_buffer = -1;
  int send_buffer = -1;
  std::uint32_t error_classes = 0;
  std::vector<std::uint32_t> filters;
  std::vector<std::uint32_t> remote_filters;
  bool filters_set = false;
  bool filtered_before_bind = false;
  bool time_stamps = false;
  std::vector<CanFrame> sent;

  FakeCanSystem() {
    interface.index = 3;
    interface.name = "can0";
    interface.kind = "can";
    interface.queue = "pfifo_fast";
    interface.is_can = interface.up = interface.has_controller = true;
    interface.bit_rate = 500'000;
    interface.state = CanState::kActive;
  }

  int open() noexcept override {
    if (open_error != 0) return -open_error;
    ++open_descriptors;
    return kSocket;
  }
  void close(int) noexcept override { --open_descriptors; }

  int readInterface(const char* name, CanInterface& to) noexcept override {
    if (read_interface_error != 0) return -read_interface_error;
    if (interface.name.str() != name) return -ENODEV;
    to = interface;
    return 0;
  }
  int restart(int) noexcept override {
    ++restarts;
    return -restart_error;
  }
  int openInterfaceMessages() noexcept override {
    if (interface_messages_error != 0) return -interface_messages_error;
    ++open_descriptors;
    return kMessages;
  }
  int readInterfaceMessage(int, CanInterface& to) noexcept override {
    if (messages.empty()) return -EAGAIN;
    const Message first = messages.front();
    messages.pop_front();
    to = first.interface;
    return -first.error;
  }

  int setFilters(int, const std::vector<std::uint32_t>& ids,
                 const std::vector<std::uint32_t>& remote_ids) noexcept override {
    filters = ids;
    remote_filters = remote_ids;
    filters_set = true;
    return -filter_error;
  }
  int setErrorFilter(int, std::uint32_t classes) noexcept override {
    error_classes = classes;
    return 0;
  }
  int setBuffers(int, int receive, int send) noexcept override {
    receive_buffer = receive;
    send_buffer = send;
    return 0;
  }
  int enableTimeStamps(int) noexcept override {
    time_stamps = true;
    return 0;
  }
  int bind(int, int) noexcept override {
    filtered_before_bind = filters_set;
    return -bind_error;
  }

  int send(int, const CanFrame& frame) noexcept override {
    if (!send_errors.empty()) {
      const int error = send_errors.front();
      send_errors.pop_front();
      return -error;
    }
    sent.push_back(frame);
    return 0;
  }
  int receive(int, CanReceipt& receipt) noexcept override {
    if (arrivals.empty()) return -EAGAIN;
    const Arrival first = arrivals.front();
    arrivals.pop_front();
    receipt = first.receipt;
    return -first.error;
  }
  int readDropCount(int, std::uint32_t& count) noexcept override {
    count = drop_count;
    return 0;
  }
  /// Time passes only here and in sleepUntil(): to the deadline, when nothing is there.
  CanReady poll(int, int messages_descriptor, bool to_write, Duration timeout) noexcept override {
    ++polls;
    CanReady ready;
    if (!poll_errors.empty()) {
      ready.error = poll_errors.front();
      poll_errors.pop_front();
      return ready;
    }
    ready.socket = to_write ? has_room : !arrivals.empty();
    ready.messages = messages_descriptor == kMessages && !messages.empty();
    if (!ready.socket && !ready.messages) time += std::max(timeout, Duration::zero());
    return ready;
  }
  Instant now() const noexcept override { return time; }
  void sleepUntil(Instant when) noexcept override { time = std::max(time, when); }

  void arrive(const CanFrame& frame) {
    CanReceipt receipt;
    receipt.frame = frame;
    arrivals.push_back({0, receipt});
  }
  void arrive(const CanFrame& frame, Duration age) {
    arrive(frame);
    arrivals.back().receipt.has_age = true;
    arrivals.back().receipt.age = age;
  }
  void arriveError(std::uint32_t classes, std::array<std::uint8_t, 8> data = {}) {
    CanReceipt receipt;
    receipt.is_error = true;
    receipt.error.classes = classes;
    receipt.error.data = data;
    arrivals.push_back({0, receipt});
  }
  /// The state of the interface is sent as a message.
  void tell() { messages.push_back({0, interface}); }
};

}  // namespace nord_driver::link
