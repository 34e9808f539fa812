// A CAN bus of two ends over AF_UNIX SEQPACKET, carrying the kernel's struct can_frame: no controller, no bit rate, and
// the same system calls as on a CAN_RAW socket.
#pragma once

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>
#include <vector>

#include "can_ends.h"

namespace nord_driver::bench {

/// Lets the driver's SocketCAN link work on the near end: everything that moves frames is Linux' own, only opening and
/// setting up an interface is not.
class PairSystem final : public link::CanSystem {
 public:
  /// `near` is read when the link is opened.
  explicit PairSystem(const int& near) : near_(near) {}

  int open() noexcept override {
    const int end = ::fcntl(near_, F_DUPFD_CLOEXEC, 0);
    ::fcntl(end, F_SETFL, O_NONBLOCK);
    return end;
  }
  void close(int descriptor) noexcept override { ::close(descriptor); }
  int readInterface(const char* name, link::CanInterface& interface) noexcept override {
    interface = link::CanInterface{};
    interface.index = 1;
    interface.name = name;
    interface.is_can = interface.up = true;
    return 0;
  }
  int restart(int /*index*/) noexcept override { return 0; }
  int openInterfaceMessages() noexcept override { return -1; }
  int readInterfaceMessage(int /*descriptor*/, link::CanInterface& /*interface*/) noexcept override { return -EAGAIN; }
  int setFilters(int /*descriptor*/, const std::vector<std::uint32_t>& /*ids*/,
                 const std::vector<std::uint32_t>& /*remote_ids*/) noexcept override {
    return 0;
  }
  int setErrorFilter(int /*descriptor*/, std::uint32_t /*classes*/) noexcept override { return 0; }
  int setBuffers(int /*descriptor*/, int /*receive*/, int /*send*/) noexcept override { return 0; }
  int enableTimeStamps(int /*descriptor*/) noexcept override { return 0; }
  int bind(int /*descriptor*/, int /*index*/) noexcept override { return 0; }
  int readDropCount(int /*descriptor*/, std::uint32_t& count) noexcept override {
    count = 0;
    return 0;
  }

  int send(int descriptor, const CanFrame& frame) noexcept override { return linux_.send(descriptor, frame); }
  int receive(int descriptor, link::CanReceipt& receipt) noexcept override {
    return linux_.receive(descriptor, receipt);
  }
  link::CanReady poll(int descriptor, int messages, bool to_write, Duration timeout) noexcept override {
    return linux_.poll(descriptor, messages, to_write, timeout);
  }
  Instant now() const noexcept override { return linux_.now(); }
  void sleepUntil(Instant when) noexcept override { linux_.sleepUntil(when); }

 private:
  const int& near_;
  link::CanSystem& linux_ = link::linuxCanSystem();
};

class CanPair final : public CanEnds {
 public:
  CanPair() {
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends_) != 0) throw std::runtime_error("no socketpair");
  }
  ~CanPair() override {
    for (const int end : ends_) ::close(end);
  }
  CanPair(const CanPair&) = delete;
  CanPair& operator=(const CanPair&) = delete;

  int near() override { return ends_[0]; }
  int far() const override { return ends_[1]; }
  const char* interface() const override { return "pair0"; }
  link::CanSystem& system() override { return system_; }

 private:
  int ends_[2] = {-1, -1};
  PairSystem system_{ends_[0]};
};

}  // namespace nord_driver::bench
